"""The wheels as `make_wheels.sh` makes them; the one for 64-bit ARM passes the tests of this folder in an emulated Python."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

HERE = Path(__file__).parent


def output_of(*command, **environment):
    done = subprocess.run(command, cwd=HERE.parents[1], env=os.environ | environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    return done.stdout


@pytest.mark.slow
def test_the_wheel_for_arm_plays_as_the_twin(tmp_path):
    """Both wheels are made; every test of the kernel passes with the one for ARM."""
    made = output_of("sh", HERE.parents[2] / "controller" / "device" / "kernel" / "make_wheels.sh", tmp_path / "wheels").split()
    for machine in ("x86_64", "aarch64"):
        assert [wheel for wheel in made if "-cp311-abi3-manylinux" in wheel and wheel.endswith(f"_{machine}.whl")], made
    output_of("bash", HERE / "aarch64_python.sh", sys.executable, tmp_path / "arm")
    packages = tmp_path / "arm" / "packages"
    zipfile.ZipFile(next(wheel for wheel in made if wheel.endswith("aarch64.whl"))).extractall(packages)
    root = tmp_path / "arm" / "root"
    emulated = ["qemu-aarch64-static", "-L", root, root / "usr" / "bin" / "python3", "-P", "-m", "pytest"]
    alone = [
        "-c",
        "/dev/null",
        "--rootdir",
        HERE,
        "--noconftest",
        "-p",
        "no:cacheprovider",
        "--import-mode=importlib",
        "-q",
        "-m",
        "not slow",
    ]
    paths = os.pathsep.join(map(str, (packages, HERE.parents[1], HERE.parents[2])))  # the wheel before the clone
    said = output_of(
        *emulated, *alone, "--ignore", HERE / Path(__file__).name, HERE, PYTHONPATH=paths, HAPTIC_PANEL_KERNEL="compiled"
    )
    assert " passed" in said
    assert "skipped" not in said
