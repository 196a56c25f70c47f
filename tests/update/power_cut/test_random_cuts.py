"""A running kernel killed at random moments of updates: as root (or with sudo), with Debian's user-mode-linux."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
AS_ROOT = [] if os.geteuid() == 0 else ["sudo"]


@pytest.mark.slow
def test_a_kernel_that_is_killed_comes_back_with_a_whole_release():
    packages = [HERE.parents[1] / "kernel/install_packages.sh", "user-mode-linux", "e2fsprogs"]
    subprocess.run(packages, check=True, capture_output=True)
    command = [*AS_ROOT, sys.executable, HERE / "random_cuts.py", "30"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == 0, done.stdout
