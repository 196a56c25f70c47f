"""Files that run elsewhere, in a virtual machine or in containers: one test here for each test there.

All files of the virtual machine share one boot; each container's file has a container of its own, and a process of these tests.
A machine that does not boot fails all its tests; nothing is skipped.
"""

import ast
import os
import re
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ENDED = re.compile(r"^(PASSED|FAILED) (\S+?)(?:::(\w+))?(?: [\d.]+ s)?$", re.MULTILINE)
GUEST = ("guest", "system")  # how the names of files of the virtual machine begin


def names_of(path, slow):
    """The tests of a file, without importing it here; those of the slow form or the others."""
    return [
        node.name
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.FunctionDef)
        and node.name.startswith("test_")
        and any(isinstance(mark, ast.Name) and mark.id == "slow" for mark in node.decorator_list) == slow
    ]


def results_of(output):
    """What was printed for each test, by file and name: whether it passed, and all that came before."""
    results, start = {}, 0
    for line in ENDED.finditer(output):
        results[line[2], line[3]] = (line[1] == "PASSED", output[start : line.end()])
        start = line.end()
    return results


@cache
def run(files, slow=False):
    """The exit code of a machine, what each test of these files printed there, and all that was printed."""
    runner = "run_guest.sh" if files[0].startswith(GUEST) else "run_container.sh"
    command = [HERE / runner, *(["--slow"] if slow else []), sys.executable, *(HERE / file for file in files)]
    with subprocess.Popen(
        ["setpriv", "--pdeathsig", "TERM", *command],  # it ends when these tests do
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


def machine_of(file):
    """What files that share a boot have in common."""
    return "guest" if file.startswith(GUEST) else file


FILES = {path.name: names_of(path, slow=False) for kind in (*GUEST, "container") for path in sorted(HERE.glob(f"{kind}_*.py"))}
SLOW = {file: names for file in FILES if (names := names_of(HERE / file, slow=True))}


def longest_first(files):
    """Files, those of the machine with most tests first, but for the one that builds a bitstream, for minutes, by one process."""
    tests = Counter()
    for file in files:
        tests[machine_of(file)] += len(FILES[file])
    return sorted(files, key=lambda file: (file != "container_commissioning.py", -tests[machine_of(file)]))


def cases(files):
    """(file, name) of each test."""
    return [(file, name) for file in longest_first(files) for name in files[file]]


@pytest.fixture(scope="session")
def chosen(request):
    """Files of which any test runs in this session."""
    return {item.callspec.params["file"] for item in request.session.items if item.path == Path(__file__)}


def run_with_others(file, chosen):
    """`run`, together with those of its machine that are chosen too."""
    return run(tuple(other for other in FILES if other in chosen and machine_of(other) == machine_of(file)))


def require_passed(name, file, ended):
    """Fail as the test did."""
    _, results, output = ended
    passed, printed = results.get((file, name), (False, f"{name} did not end; printed was:\n{output[-6000:]}"))
    assert passed, printed


@pytest.mark.kernel
@pytest.mark.parametrize(("file", "name"), cases(FILES))
def test_elsewhere(file, name, chosen):
    require_passed(name, file, run_with_others(file, chosen))


@pytest.mark.kernel
@pytest.mark.parametrize("file", longest_first(FILES))
def test_every_machine_ends_as_its_tests_did(file, chosen):
    code, results, output = run_with_others(file, chosen)
    assert code == (0 if all(passed for passed, _ in results.values()) else 1), output[-6000:]
    assert {name for of, name in results if of == file} == set(FILES[file]), output[-6000:]


@pytest.mark.slow
@pytest.mark.parametrize(("file", "name"), cases(SLOW))
def test_elsewhere_in_the_slow_form(file, name):
    require_passed(name, file, run((file,), slow=True))
