"""On aarch64 the bytes are those of x86-64: a bank built there, and words composed there, by the compiled kernel and by NumPy."""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

HERE = Path(__file__).parent
CHECKOUT = HERE.parents[2]
pytestmark = pytest.mark.slow


def output_of(*command, **environment):
    done = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout, done.stderr.split()[-1:]


@cache
def machine():
    """Folder of the emulated machine's parts."""
    return Path(output_of(HERE / "build_machine.sh", sys.executable)[0].strip())


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """The wheel for aarch64, unpacked."""
    folder = tmp_path_factory.mktemp("package")
    foreign = {"CC": "aarch64-linux-gnu-gcc", "_PYTHON_HOST_PLATFORM": "linux-aarch64"}
    machine()  # which installs the compiler
    output_of("env", "-C", CHECKOUT, sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder / "wheel", **foreign)
    (wheel,) = (folder / "wheel").glob("*_aarch64.whl")
    output_of(sys.executable, "-m", "zipfile", "-e", wheel, folder / "package")
    for room in ("boards", "fpga_rtl"):  # as in a checkout, which has a pyproject.toml
        (folder / "package" / room).symlink_to(CHECKOUT / room)
    (folder / "package" / "pyproject.toml").symlink_to(CHECKOUT / "pyproject.toml")
    return folder / "package"


@pytest.fixture(scope="module")
def ours(tmp_path_factory):
    """What x86-64 prints."""
    here = {"HAPTIC_PANEL_KERNEL": "compiled", "PYTHONPATH": str(CHECKOUT), "OPENBLAS_NUM_THREADS": "1"}
    said, kernel = output_of(sys.executable, HERE / "same_bytes.py", tmp_path_factory.mktemp("ours"), **here)
    assert kernel == ["compiled"]
    return said


@pytest.mark.parametrize("kernel", ["compiled", "numpy"])
def test_bank_and_composed_words_are_those_of_x86_64(package, ours, tmp_path, kernel):
    root = machine() / "arm64"
    libraries = ":".join(f"{root}/{folder}/aarch64-linux-gnu" for folder in ("usr/lib", "lib"))
    path = ":".join(map(str, (package, root / "usr/lib/device", root / "usr/lib/offline", root / "usr/lib/python3/dist-packages")))
    variables = {
        "PYTHONPATH": path,
        "HAPTIC_PANEL_KERNEL": kernel,
        "LD_LIBRARY_PATH": libraries,
        "OPENBLAS_NUM_THREADS": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    given = [word for name, value in variables.items() for word in ("-E", f"{name}={value}")]
    emulator = [machine() / "qemu/usr/bin/qemu-aarch64-static", "-cpu", "cortex-a72", "-L", root]
    said, used = output_of(*emulator, *given, root / "usr/bin/python3.11", HERE / "same_bytes.py", tmp_path)
    assert used == [kernel]
    assert said == ours
