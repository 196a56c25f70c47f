"""A copy of the checkout in which the loop is compiled by mypyc: the modules lie beside their sources, and Python takes them.

usage: python -m tests.compiled_copy FOLDER     makes it, in a minute; what then runs there runs on the compiled loop, such as
       `PYTHONPATH=. PYTHON -m tests.workshop.benchmark.host_latency`
"""

import os
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
KERNELS = [f"controller/device/kernel/{name}.abi3.so" for name in ("_kernel", *["_kernel_avx2"] * (platform.machine() == "x86_64"))]


def build_wheel(folder, **environment):
    """A wheel as pip would build it: the finished command, and the file or None."""
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    done = subprocess.run(command, cwd=ROOT, env=os.environ | environment, capture_output=True, text=True, check=False)
    return done, next(Path(folder).glob("*.whl"), None)


def compiled_copy(folder):
    """Copy the checkout into a new folder and compile its loop there.

    Raises
    ------
    RuntimeError
        If it does not compile.
    """
    with tempfile.TemporaryDirectory() as packed:
        done, wheel = build_wheel(packed, CFLAGS="", HAPTIC_PANEL_MYPYC="1")
        if wheel is None:
            raise RuntimeError(done.stdout + done.stderr)
        copy_with(wheel, folder)


def copy_with(wheel, folder):
    """Copy the checkout into a new folder, with what is compiled in a wheel of it."""
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(".*", "__pycache__", "build", "dist"))
    with zipfile.ZipFile(wheel) as files:
        files.extractall(folder, [name for name in files.namelist() if name.endswith(".so")])
    for kernel in KERNELS:
        (Path(folder) / kernel).touch()  # newer than its source


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    compiled_copy(sys.argv[1])
