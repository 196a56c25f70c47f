"""Wheels of the lock file, fetched or built once for a platform, and this project's own: the same bytes wherever they are built
by the same compiler and headers.
"""

import hashlib
import os
import platform
import shutil
import sys
import tempfile
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from controller.errors import UpdateError
from controller.programs import ProgramError, run_program
from controller.workshop.publish.lock_file import BUILT, Locked, Target

LONG_AGO_S: Final = 315_532_800  # 1980: time of files in wheels of others' sources, which do not change with ours
LIMIT_S: Final = 3600.0  # of a program: a Raspberry Pi compiles the loop for half an hour
WORKSHOP: Final = "controller/workshop/"
PIP: Final = ("-m", "pip", "--disable-pip-version-check", "--no-input", "--quiet")


def fetched(packages: Iterable[Locked], target: Target, tools: Path, cache: Path) -> Path:
    """Folder with a wheel of each package: of the registry, or built of its sources; made once.

    `tools` is the lock file of what wheels are built with. Raises UpdateError if a package cannot be fetched or built, or must be
    built for another platform than this computer's.
    """
    packages = list(packages)
    built = [one for one in packages if one.name in BUILT]
    if built:
        must_be_here(target, ", ".join(one.name for one in built))
    lines = "".join(one.line for one in packages)
    key = _key(lines, tools.read_text(encoding="utf-8"), *target.platforms(), target.minor, _compiler() if built else "")
    with _made_once(cache / "release_wheels" / key) as folder:
        if folder:
            options = [word for name in target.platforms() for word in ("--platform", name)]
            options += ["--python-version", f"3.{target.minor}", "--implementation", "cp"]
            options += [word for abi in (f"cp3{target.minor}", "abi3", "none") for word in ("--abi", abi)]
            options += ["--only-binary", ":all:", "--no-deps", "--require-hashes", "--dest", str(folder)]
            with _written("".join(one.line for one in packages if one.name not in BUILT)) as listed:
                _run([sys.executable, *PIP, "download", *options, "-r", listed], "wheels cannot be fetched")
            if built:
                with _written("".join(one.line for one in built)) as listed:
                    options = ["--no-build-isolation", "--no-deps", "--no-binary", ":all:", "--no-cache-dir", "--require-hashes"]
                    command = [tools_in(tools, cache), *PIP, "wheel", *options, "--wheel-dir", folder, "-r", listed]
                    _run(command, "wheels cannot be built", _building(LONG_AGO_S))
    return cache / "release_wheels" / key


def built_here(source: Path, time_s: int, tools: Path, cache: Path, folder: Path, *, mypyc: bool, workshop: bool) -> Path:
    """This project's wheel, built from its source.

    `source` is the folder of pyproject.toml; its files get the time `time_s`, in s since 1970; `tools` is the lock file of what
    wheels are built with; the wheel goes into `folder`. With `mypyc` the loop is compiled too; no device needs the `workshop`.
    Raises UpdateError if it does not build.
    """
    wanted = {"HAPTIC_PANEL_MYPYC": str(int(mypyc)), "HAPTIC_PANEL_WING": "" if workshop else "device"}
    _run(
        [tools_in(tools, cache), "-m", "hatchling", "build", "-t", "wheel", "-d", folder],
        "the wheel cannot be built",
        _building(time_s) | wanted,
        source,
    )
    (wheel,) = folder.glob("*.whl")
    return wheel


def check_wing(wheel: Path, *, workshop: bool) -> None:
    """Check that a wheel of this project has the workshop, or has it not: no device gets code that signs.

    Raises UpdateError if it is otherwise.
    """
    try:
        with zipfile.ZipFile(wheel) as files:
            has = any(name.startswith(WORKSHOP) for name in files.namelist())
    except (OSError, zipfile.BadZipFile) as error:
        raise UpdateError(f"{wheel}: is no wheel that can be read ({error})") from error
    if has and not workshop:
        raise UpdateError(f"{wheel}: has the workshop, which no device gets: build it with HAPTIC_PANEL_WING=device")
    if workshop and not has:
        raise UpdateError(f"{wheel}: lacks the workshop, which simulates the FPGA of a board: build it without HAPTIC_PANEL_WING")


def must_be_here(target: Target, what: str) -> None:
    """Check that wheels for a target can be built on this computer; raises UpdateError if not."""
    if target != Target(platform.machine(), sys.version_info[1]):
        here = f"{platform.machine()}-cp3{sys.version_info[1]}"
        raise UpdateError(
            f"{what}: must be built on {target.architecture} by Python 3.{target.minor}, and this is {here}: run make-release "
            "there, or give the wheels built there with --wheels"
        )


def tools_in(lock: Path, cache: Path) -> Path:
    """Python of an environment with what wheels are built with; made once."""
    place = cache / "release_tools" / _key(lock.read_text(encoding="utf-8"), sys.version)
    if not (place / ".complete").exists():  # at its final path: scripts have paths in them
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(place, ignore_errors=True)
        _run([sys.executable, "-m", "venv", place], "an environment to build wheels in cannot be made")
        command = [place / "bin/python", *PIP, "install", "--require-hashes", "--no-deps", "--only-binary", ":all:", "-r", lock]
        _run(command, "what wheels are built with cannot be fetched")
        (place / ".complete").touch()
    return place / "bin/python"


def _building(time_s: int) -> dict[str, str]:
    """Environment in which two builds of the same source are the same."""
    return {"SOURCE_DATE_EPOCH": str(time_s), "CFLAGS": "-g0", "LDFLAGS": "-Wl,--strip-all", "LC_ALL": "C", "PYTHONHASHSEED": "0"}


def _compiler() -> str:
    """What the compiler calls itself: another one makes other wheels."""
    name = os.environ.get("CC", "cc")
    try:
        return run_program([*name.split(), "--version"], LIMIT_S).out
    except ProgramError as error:
        raise UpdateError(
            f"{name}: there is no C compiler: install one (Debian package build-essential), or give --wheels"
        ) from error


def _key(*parts: object) -> str:
    return hashlib.sha256("\0".join(map(str, (*parts, sys.version))).encode()).hexdigest()[:16]


@contextmanager
def _made_once(place: Path) -> Iterator[Path | None]:
    """A folder to fill, which then is `place`, whole; None if that is there already."""
    if place.exists():
        yield None
        return
    place.parent.mkdir(parents=True, exist_ok=True)
    making = Path(tempfile.mkdtemp(prefix="making-", dir=place.parent))
    try:
        yield making
        making.rename(place)
    except OSError:
        if not place.exists():  # another process was faster
            raise
    finally:
        shutil.rmtree(making, ignore_errors=True)


@contextmanager
def _written(text: str) -> Iterator[Path]:
    """A file of this text, for as long as it is needed."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write(text)
        file.flush()
        yield Path(file.name)


def _run(command: Sequence[object], what: str, environment: Mapping[str, str] | None = None, folder: Path | None = None) -> None:
    before = os.umask(0o022)  # modes of files are part of a wheel
    try:
        run_program(list(map(str, command)), LIMIT_S, cwd=folder, environment=os.environ | (environment or {}))
    except ProgramError as error:
        errors = [line.strip() for line in error.said.splitlines() if "error" in line.lower()]
        raise UpdateError(f"{what}: {errors[-1] if errors else error}") from error
    finally:
        os.umask(before)
