"""Files that run elsewhere, each in a virtual machine or a container of its own: one test here for each test there.

A machine that does not boot fails them all; nothing is skipped.
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

RUNNERS = {  # by how a file's name begins
    "guest": ["run_guest.sh"],
    "system": ["run_guest.sh", "--systemd"],
    "container": ["run_container.sh"],
}

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
    """The exit code of a file, what each of its tests printed, and all that was printed."""
    runner, *options = RUNNERS[file.split("_")[0]]
    with subprocess.Popen(
        ["setpriv", "--pdeathsig", "TERM", HERE / runner, *options, sys.executable, HERE / file],  # it ends when these tests do
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"PYTHONPATH": ""},
    ) as machine:
        try:
            output, _ = machine.communicate()
        except BaseException:
            machine.terminate()
            raise
    return machine.returncode, results_of(output), output


FILES = sorted(path.name for kind in RUNNERS for path in HERE.glob(f"{kind}_*.py"))
CASES = [(file, name) for file in FILES for name in names_of(HERE / file)]


@pytest.mark.parametrize(("file", "name"), CASES)
def test_elsewhere(file, name):
    _, results, output = run(file)
    passed, printed = results.get(name, (False, f"{name} did not end; printed was:\n{output[-6000:]}"))
    assert passed, printed


@pytest.mark.parametrize("file", FILES)
def test_every_machine_ends_as_its_tests_did(file):
    code, results, output = run(file)
    assert code == (0 if all(passed for passed, _ in results.values()) else 1), output[-6000:]
    assert set(results) == set(names_of(HERE / file)), output[-6000:]
