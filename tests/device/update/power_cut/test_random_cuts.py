"""A running kernel killed at random moments of updates: as root (or with sudo), with Debian's user-mode-linux."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
AS_ROOT = [] if os.geteuid() == 0 else ["sudo"]


def random_cuts(*arguments):
    """Run random_cuts.py; its exit code and what it says."""
    packages = [HERE.parents[2] / "kernel/install_packages.sh", "user-mode-linux", "e2fsprogs"]
    subprocess.run(packages, check=True, capture_output=True)
    command = [*AS_ROOT, sys.executable, HERE / "random_cuts.py", *arguments]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


@pytest.mark.slow
def test_a_kernel_that_is_killed_comes_back_with_a_whole_release():
    code, said = random_cuts("40")
    print(said)
    assert code == 0, said


@pytest.mark.slow
def test_what_is_not_synced_is_missed():
    code, said = random_cuts("40", "--break", "sync")
    assert code == 1, said
    assert "after cut" in said
