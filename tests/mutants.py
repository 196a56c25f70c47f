"""Do the tests notice a fault of the Python? A sample of mutants, each run against the tests of its module until one fails.

usage: python -m tests.mutants [--count N] [--seed N] [--under FOLDER] [--mark EXPRESSION]

A mutant is one small change of a function: a comparison, an operator, a constant, a negated condition, a call left out. What may
kill it are the test files that import its module, those of its name first; its own process has a limit of processor time, so that
one that loops for ever is killed too. Mutants are made in a copy of the checkout; a test that fails without them decides nothing.
"""

import argparse
import ast
import copy
import importlib
import os
import random
import re
import resource
import shutil
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
CPU_S = 120
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
    """Puts another node in place of one."""

    def __init__(self, node, other):
        self.node, self.other = node, other

    def visit(self, node):
        return self.other if node is self.node else self.generic_visit(node)


def places(path):
    """Line and index of whatever can be changed inside the functions of a file."""
    functions = (node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.FunctionDef))
    inside = {id(node): node for function in functions for statement in function.body for node in ast.walk(statement)}
    return [(node.lineno, index) for index, node in enumerate(inside.values()) if changed(node)]


def mutate(path, index):
    """Write the mutant in place of the file; its line before and after."""
    tree = ast.parse(path.read_text())
    functions = (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))
    inside = {id(node): node for function in functions for statement in function.body for node in ast.walk(statement)}
    node = list(inside.values())[index]
    other = changed(node)
    before, after = ast.unparse(node).splitlines()[0], ast.unparse(other).splitlines()[0]
    path.write_text(ast.unparse(ast.fix_missing_locations(Replace(node, other).visit(tree))))
    return f"{before}  ->  {after}"


def killers(module, files):
    """Test files that name a module, those named after it first; where there are none, those of its room."""
    name, room = module.rpartition(".")[2], "/".join(["tests", *module.split(".")[1:-1]])
    naming = [file for file, text in files.items() if re.search(rf"\b{re.escape(module)}\b|\bimport .*\b{name}\b", text)]
    near = [file for file in files if file.as_posix().startswith(f"{room}/")]
    return sorted(naming or near, key=lambda file: (name not in file.stem, file not in near))


class First:
    """A plugin of pytest: which test failed first."""

    failed = ""

    def pytest_runtest_logreport(self, report):
        self.failed = self.failed or (report.nodeid if report.failed else "")


def failing(checkout, tests, mark):
    """Name of the first test that fails, in a process of its own, which has its imports from this one; None if none does."""
    reading, writing = os.pipe()
    child = os.fork()
    if child:
        os.close(writing)
        with os.fdopen(reading) as reported:
            failed = reported.read()
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return failed if code == 1 else None if code in {0, 4, 5} else "it does not end, or cannot be imported"
    code = 2
    try:
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_S, CPU_S))
        os.chdir(checkout)
        sys.path.insert(0, str(checkout))
        os.environ["PYTHONPATH"] = str(checkout)
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        first = First()
        code = importlib.import_module("pytest").main(["-n0", "-x", "-q", "-m", mark, *map(str, tests)], [first])
        os.write(writing, first.failed.encode())
    finally:
        os._exit(code)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--count", type=int, default=100)
    arguments.add_argument("--seed", type=int, default=2015)
    arguments.add_argument("--under", default="controller")
    arguments.add_argument("--mark", default="not slow and not stress and not kernel")
    given = arguments.parse_args()
    for name in ("matplotlib.figure", "scipy.linalg"):  # what most tests import, once
        importlib.import_module(name)

    everything = [(path, *place) for path in sorted((ROOT / given.under).rglob("*.py")) for place in places(path)]
    chosen = random.Random(given.seed).sample(everything, min(given.count, len(everything)))
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        checkout = Path(folder) / "checkout"
        Path(folder).chmod(0o755)  # some tests are run as nobody
        shutil.copytree(ROOT, checkout, ignore=shutil.ignore_patterns(".venv", ".git", "build", ".*_cache"), symlinks=True)
        files = {file.relative_to(checkout): file.read_text() for file in sorted((checkout / "tests").rglob("test_*.py"))}
        for number, (path, line, index) in enumerate(chosen, 1):
            mutated = checkout / path.relative_to(ROOT)
            what = mutate(mutated, index)
            tests = killers(".".join(path.relative_to(ROOT).with_suffix("").parts), files)
            failed = failing(checkout, tests, given.mark) if tests else None
            shutil.copy(path, mutated)
            verdict = f"killed by {failed}" if failed else "lives"
            if failed and "::" in failed and failing(checkout, [failed], given.mark):
                verdict = f"undecided: without it {failed} fails too"
            verdicts.append(verdict.split()[0].rstrip(":"))
            print(f"{number} {path.relative_to(ROOT)}:{line}  {what}: {verdict}", flush=True)
    print({verdict: verdicts.count(verdict) for verdict in set(verdicts)})


if __name__ == "__main__":
    main()
