"""The software bill of materials of a release, in CycloneDX, by cyclonedx-py, which also checks it against the format's schema."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path

from packaging.utils import parse_wheel_filename

from controller.errors import UpdateError
from controller.update.release_folder import digest_of


def sbom(wheels: Iterable[Path], project: Path | None, time_s: int) -> bytes:
    """The bill of wheels: the same bytes for the same wheels.

    Parameters
    ----------
    wheels : iterable of Path
        Without this project's own.
    project : Path, optional
        Its pyproject.toml.
    time_s : int
        Told as its time, in s since 1970.

    Raises
    ------
    UpdateError
        If the generator fails, or finds its own output wrong.
    ModuleNotFoundError
        If it is not installed.
    """
    if find_spec("cyclonedx_py") is None:
        raise ModuleNotFoundError("No module named 'cyclonedx'", name="cyclonedx")
    lines = []
    for wheel in sorted(wheels):
        name, version, *_ = parse_wheel_filename(wheel.name)
        lines.append(f"{name}=={version} --hash=sha256:{digest_of(wheel)[0]}\n")
    options = ["--output-reproducible", "--validate", "--short-PURLs", "--spec-version", "1.6", "--output-format", "JSON"]
    options += ["--pyproject", str(project), "--mc-type", "firmware"] if project else []
    done = subprocess.run(
        [sys.executable, "-I", "-m", "cyclonedx_py", "requirements", *options, "-"],
        input="".join(lines).encode(), env=os.environ | {"SOURCE_DATE_EPOCH": str(time_s)}, capture_output=True, check=False,
    )  # fmt: skip
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip().splitlines() or [f"exit code {done.returncode}"]
        raise UpdateError(f"no bill of materials (cyclonedx-py): {said[-1]}")
    return done.stdout
