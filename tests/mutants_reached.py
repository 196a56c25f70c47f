"""What reaches a mutant: README's line is run once on a copy whose statements report that they are reached, and by which test."""

import ast
import os
import re
import subprocess
import sys
import threading
from collections import Counter
from pathlib import Path

import pytest

USED_S: pytest.StashKey[float] = pytest.StashKey()  # by a process of tests, at the end of the phase before
OF_TEXT = r"tests/test_(project|generate|wings|decisions)\.py"  # they would notice that a file was written by `ast.unparse`


def inside_functions(tree):
    functions = (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))
    return list(dict.fromkeys(node for function in functions for statement in function.body for node in ast.walk(statement)))


def rewrite(path, tree, transformer):
    for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*"):
        compiled.unlink()
    path.write_text(ast.unparse(ast.fix_missing_locations(transformer.visit(tree))))


class Count(ast.NodeTransformer):
    """Has some statements report first that they are reached."""

    def __init__(self, numbers):
        self.numbers = numbers

    def visit(self, node):
        reports = [ast.parse(f"__import__('controller.reached').reached.reach({n})").body[0] for n in self.numbers.get(node, [])]
        return [*reports, self.generic_visit(node)] if reports else self.generic_visit(node)


REACH = """
import os
SEEN = set()
def reach(number):
    test = os.environ.get("PYTEST_CURRENT_TEST")
    if (number, test) not in SEEN:
        SEEN.add((number, test))
        pipe = os.open({pipe!r}, os.O_WRONLY)  # no file: a service's helpers may write none
        os.write(pipe, f"reached\\t{{number}}\\t{{test}}\\n".encode())  # whole: shorter than PIPE_BUF
        os.close(pipe)
"""


def report_reached(checkout, chosen, pipe):
    """Have the statements of chosen mutants report what reaches them."""
    (checkout / "controller" / "reached.py").write_text(REACH.format(pipe=str(pipe)))
    for path in {path for path, *_ in chosen}:
        tree = ast.parse((checkout / path).read_text())
        nodes, numbers = inside_functions(tree), {}
        for number, (where, _, index) in enumerate(chosen):
            if where == path:
                around = [node for node in ast.walk(tree) if isinstance(node, ast.stmt) and nodes[index] in ast.walk(node)]
                numbers.setdefault(around[-1], []).append(number)  # the innermost comes last
        rewrite(checkout / path, tree, Count(numbers))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """What a phase took is processor time, that of children included, which does not depend on what else the machine does."""
    report = yield
    now_s = sum(os.times()[:4])
    report.duration, item.config.stash[USED_S] = now_s - item.config.stash.get(USED_S, now_s), now_s
    return report


def pytest_runtest_logreport(report):
    """As a plugin of the run that finds what reaches the mutants: how long each test took, and whether it is a quick one."""
    if "PYTEST_XDIST_WORKER" in os.environ:  # reported once more where all reports arrive
        return
    with Path(os.environ["HAPTIC_PANEL_REACHED"]).open("a") as file:
        file.write(f"took\t{report.duration:.3f}\t{report.nodeid} {'quick' if 'quick' in report.keywords else 'slower'}\n")


def run_whole(checkout, chosen, file, *tests):
    """One run of README's line, or of some tests, over the instrumented copy, which writes what reaches what."""
    pipe = checkout.parent / "reached"
    os.mkfifo(pipe)
    report_reached(checkout, chosen, pipe)
    environment = os.environ | {"PYTHONPATH": str(checkout), "HAPTIC_PANEL_REACHED": str(file)}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "tests.mutants_reached", *tests]
    lines = os.open(pipe, os.O_RDWR)  # there is always a reader and a writer, so that no one waits for the other
    with subprocess.Popen(command, cwd=checkout, env=environment, stdout=subprocess.DEVNULL) as run:
        copying = threading.Thread(target=copy_until_empty_line, args=(lines, file))
        copying.start()
        run.wait()
        os.write(lines, b"\n")
        copying.join()
    os.close(lines)
    (checkout / "controller" / "reached.py").unlink()


def copy_until_empty_line(lines, file):
    with open(lines, closefd=False) as reported:
        for line in reported:
            if line == "\n":
                return
            with file.open("a") as whole:
                whole.write(line)


def read_reached(file):
    """({number: tests that reach it}, {test: seconds}, quick tests)."""
    reached, took, quick = {}, Counter(), set()
    for line in file.read_text().splitlines():
        kind, what, test = line.split("\t")
        name, _, how = test.rpartition(" ")
        if kind == "reached":
            reached.setdefault(int(what), set()).add((name, how))
        elif not re.match(OF_TEXT, name):
            took[name] += float(what)
            quick |= {name} if how == "quick" else set()
    by_file = {}
    for name in took:
        by_file.setdefault(name.partition("::")[0], []).append(name)
    tests = {}
    for number, hits in reached.items():  # what a fixture reaches is for all tests of the file
        names = [one for name, how in hits for one in (by_file.get(name.partition("::")[0], []) if how == "(setup)" else [name])]
        tests[number] = [name for name in dict.fromkeys(names) if name in took]
    return tests, took, quick
