"""The processes of an update killed at moments of their work; a C compiler is needed, and no rights."""

import re
import subprocess
import sys
from pathlib import Path

import pytest


def kills(moments):
    """Run kills.py; all must be well."""
    command = [sys.executable, Path(__file__).with_name("kills.py"), str(moments)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stdout
    assert int(re.search(r"^(\d+) kills", done.stdout, re.MULTILINE)[1]) == moments, done.stdout


@pytest.mark.kernel
def test_an_update_that_was_killed_is_done_again():
    kills(12)


@pytest.mark.slow
def test_an_update_that_was_killed_at_200_moments_is_done_again():
    kills(200)
