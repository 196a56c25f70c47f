"""Mutants of the Python: the same verdicts whoever finds them, and nothing is found twice."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import wait_for

ROOT = Path(__file__).parent.parent
TESTS = "tests/device/touch/test_axes.py"
COUNT = 6


@pytest.fixture
def reached(tmp_path):
    """What one run of all tests would say of a module that one file of tests reaches."""
    names = [f"{TESTS}::{name}" for name in re.findall(r"^def (test_\w+)", (ROOT / TESTS).read_text(), re.MULTILINE)]
    lines = [f"took\t0.010\t{name} quick" for name in names]
    lines += [f"reached\t{number}\t{name} (call)" for number in range(COUNT) for name in names]
    (tmp_path / "reached").write_text("\n".join(lines))
    return tmp_path / "reached"


def mutants(reached, kept, workers):
    options = f"--count {COUNT} --under controller/device/touch/axes.py --reached {reached} --kept {kept} --workers {workers}"
    command = [sys.executable, "-m", "tests.mutants", *options.split()]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, cwd=ROOT, start_new_session=True, **pipes)


@pytest.mark.slow
def test_verdicts_of_one_process_killed_amid_them_and_of_two_are_the_same(reached, tmp_path):
    killed = mutants(reached, tmp_path / "alone", 1)
    assert killed.stderr.readline().startswith("controller/device/touch/axes.py ")
    assert wait_for("a verdict", lambda: any(file.stat().st_size for file in (tmp_path / "alone").glob("*.kept")), seconds=100)
    os.killpg(killed.pid, signal.SIGKILL)
    killed.communicate()
    verdicts, errors = mutants(reached, tmp_path / "alone", 1).communicate()
    assert len(errors.splitlines()) < COUNT
    assert "quick: tests/device/touch/test_axes.py::test_" in verdicts
    assert len(verdicts.splitlines()) == COUNT + 2
    by_two, errors = mutants(reached, tmp_path / "two", 2).communicate()
    assert by_two == verdicts
    assert len(errors.splitlines()) == COUNT
    assert mutants(reached, tmp_path / "two", 2).communicate() == (verdicts, "")
