"""A program that makes mutants of the Python in a copy of its checkout: written, run against tests until one fails, taken back.

It has imported what tests import, and forks a process for each run of some of them.
"""

import ast
import contextlib
import copy
import importlib
import os
import resource
import select
import shutil
import signal
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from tests.asked import ROOT, serve
from tests.mutants_reached import inside_functions, rewrite
from tests.patience import processor_s

LEFT_OUT = (".venv", ".git", "build", ".*_cache")
CPU_S, HANGS_S = 60, 100
IMPORTED = ["pytest", "hypothesis", "numpy.testing", "scipy.linalg", "matplotlib.figure", "jsonschema", "msgspec"]  # once, for all
SWAPPED = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot,
    ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div,
    ast.Div: ast.Mult, ast.FloorDiv: ast.Mult, ast.And: ast.Or, ast.Or: ast.And, ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd,
}  # fmt: skip


def changed(node):
    """A node with one small change, or None if it has none."""
    other = copy.copy(node)
    if isinstance(node, ast.Compare) and type(node.ops[0]) in SWAPPED:
        other.ops = [SWAPPED[type(node.ops[0])](), *node.ops[1:]]
    elif isinstance(node, ast.BinOp | ast.BoolOp) and type(node.op) in SWAPPED:
        other.op = SWAPPED[type(node.op)]()
    elif isinstance(node, ast.Constant) and type(node.value) in {int, float}:
        other.value = node.value + 1
    elif isinstance(node, ast.If | ast.IfExp):
        other.test = ast.UnaryOp(ast.Not(), node.test)
    elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        other = ast.Pass()
    else:
        return None
    return ast.copy_location(other, node)


class Replace(ast.NodeTransformer):
    """Puts others in place of some nodes."""

    def __init__(self, others):
        self.others = others

    def visit(self, node):
        return self.others[node] if node in self.others else self.generic_visit(node)


def places(path):
    """Line and index of whatever can be changed inside the functions of a file."""
    nodes = inside_functions(ast.parse(path.read_text()))
    return [(node.lineno, index) for index, node in enumerate(nodes) if changed(node)]


def mutate(path, index):
    """Write the mutant in place of the file; its line before and after."""
    tree = ast.parse(path.read_text())
    node = inside_functions(tree)[index]
    other = changed(node)
    before, after = ast.unparse(node).splitlines()[0], ast.unparse(other).splitlines()[0]
    rewrite(path, tree, Replace({node: other}))
    return f"{before}  ->  {after}"


def nearest_first(tests):
    """Those of the first files, since to import many lasts longer than to run them; then the others."""
    files = list(dict.fromkeys(test.partition("::")[0] for test in tests))[:3]
    near = [test for test in tests if test.partition("::")[0] in files]
    return [some for some in (near, [test for test in tests if test not in near]) if some]


class First:
    """A plugin of pytest: which test failed first."""

    failed = ""

    def pytest_runtest_logreport(self, report):
        self.failed = self.failed or (report.nodeid if report.failed else "")


def end_if_it_hangs(child, reading):
    """Kill a process of tests, and what it started, that computes nothing for `HANGS_S`."""
    used_s = -1.0
    while not select.select([reading], [], [], HANGS_S)[0]:
        before_s, used_s = used_s, processor_s(child)
        if used_s - before_s < 0.1:
            os.killpg(child, signal.SIGKILL)


def failing(checkout, tests):
    """Name of the first test that fails, in a process of its own, which has its imports from this one; None if none does."""
    reading, writing = os.pipe()
    child = os.fork()
    if child:
        os.close(writing)
        end_if_it_hangs(child, reading)
        with os.fdopen(reading) as reported:
            failed = reported.read()
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return failed if code == 1 else None if code in {0, 5} else f"{tests[0]}: it does not end, or cannot be imported"
    code = 2
    try:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_S, CPU_S))
        os.chdir(checkout)
        sys.path.insert(0, str(checkout))
        os.environ["PYTHONPATH"] = str(checkout)
        silent = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silent, 1)
        os.dup2(silent, 2)
        first = First()
        code = importlib.import_module("pytest").main(["-n0", "-x", "-q", "-W", "ignore:Module already imported", *tests], [first])
        os.write(writing, first.failed.encode())
    finally:
        os._exit(code)


class Mutant(NamedTuple):
    """A change that can be made, and the tests that may notice it."""

    path: str  # in the checkout
    index: int  # of the node, as in `places`
    quick: Sequence[str]
    slower: Sequence[str]


class Judge:
    """Finds what kills mutants in a copy of the checkout."""

    def __init__(self, checkout):
        self._checkout = checkout
        self._passes = set()  # tests that were tried without a mutant

    def judge(self, mutant):
        """What is changed, and what kills it: quick tests, slower ones, or none."""
        what = mutate(self._checkout / mutant.path, mutant.index)
        try:
            verdict = self._verdict(mutant)
        finally:
            self._restore(mutant)
        print(f"{mutant.path}  {what}: {verdict}", file=sys.stderr, flush=True)
        return what, verdict

    def _verdict(self, mutant):
        for form, chosen in (("quick", mutant.quick), ("slower", mutant.slower)):
            failed = next(filter(None, map(self._failing, nearest_first(chosen))), None)
            if failed:
                self._restore(mutant)
                known = failed.partition(": ")[0]
                if known not in self._passes and self._failing([known]):
                    return f"undecided: without it {known} fails too"
                self._passes.add(known)
                return f"{form}: {failed}"
        return "lives" if mutant.quick or mutant.slower else "lives: nothing reaches it"

    def _restore(self, mutant):
        restored(self._checkout, mutant.path)

    def _failing(self, tests):
        return failing(self._checkout, tests)


@contextlib.contextmanager
def copy_of_root():
    """A copy of the checkout in which files may be changed."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)  # some tests are run as nobody
        checkout = Path(folder) / "checkout"
        shutil.copytree(ROOT, checkout, ignore=shutil.ignore_patterns(*LEFT_OUT), symlinks=True)
        yield checkout


def restored(checkout, path):
    """Write a file of the checkout as it is, as `rewrite` does."""
    rewrite(checkout / path, ast.parse((ROOT / path).read_text()), ast.NodeTransformer())


def main():
    """Answer each line, a `Mutant`, with what is changed and what kills it."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False  # of tests, in the copy
    for name in IMPORTED:
        importlib.import_module(name)
    with copy_of_root() as checkout:
        judge = Judge(checkout)
        serve(lambda line: judge.judge(Mutant(*line)))


if __name__ == "__main__":
    main()
