"""The guest files, each run in a virtual machine of its own: one test here for each test there.

A guest that does not boot fails them all; nothing is skipped.
"""

import ast
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ENDED = re.compile(r"^(PASSED|FAILED) \S+?(?:::(\w+))?(?: [\d.]+ s)?$", re.MULTILINE)

pytestmark = pytest.mark.kernel


def names_of(path):
    """The tests of a file, without importing it here."""
    return [
        node.name
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    ]


def results_of(output):
    """What was printed for each test: whether it passed, and all that came before."""
    results, start = {}, 0
    for line in ENDED.finditer(output):
        results[line[2]] = (line[1] == "PASSED", output[start : line.end()])
        start = line.end()
    return results


@cache
def run(file):
    """Whether the guest came to its end, what each test printed, and all that was printed."""
    done = subprocess.run(
        [HERE / "run_guest.sh", sys.executable, HERE / file],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": ""},
    )
    return done.returncode, results_of(done.stdout), done.stdout


CASES = [(path.name, name) for path in sorted(HERE.glob("guest_*.py")) for name in names_of(path)]


@pytest.mark.parametrize(("file", "name"), CASES)
def test_in_the_guest(file, name):
    _, results, output = run(file)
    passed, printed = results.get(name, (False, f"{name} did not end; the guest printed:\n{output[-6000:]}"))
    assert passed, printed


@pytest.mark.parametrize("file", sorted({file for file, _ in CASES}))
def test_every_guest_ends_as_its_tests_did(file):
    code, results, output = run(file)
    assert code == (0 if all(passed for passed, _ in results.values()) else 1), output[-6000:]
    assert set(results) == set(names_of(HERE / file)), output[-6000:]
