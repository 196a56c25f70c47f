"""Do the tests notice a fault of the Python? A sample of mutants, each run against the tests that reach it until one fails.

usage: python -m tests.mutants [--count N] [--seed N] [--under FOLDER ...] [--reached FILE] [--only FILE]

A mutant is one small change of a function: a comparison, an operator, a constant, a negated condition, a call left out. What may
kill it is what reaches its statement in one run of README's line: the quick tests first, then the others, each form for at most
`BUDGET_S` of processor time as that run took them, of each test file its first ones. --reached keeps that run in a file, --only
takes mutants again that a list of verdicts has as alive. A process of tests has a limit of processor time, so that one that loops
for ever is killed too. Mutants are made in a copy of the checkout; a test that fails without them decides nothing.
"""

import argparse
import ast
import copy
import importlib
import os
import random
import re
import resource
import select
import shutil
import signal
import sys
import tempfile
from collections import Counter
from functools import partial
from pathlib import Path

from tests.mutants_reached import inside_functions, read_reached, rewrite, run_whole
from tests.patience import processor_s

ROOT = Path(__file__).parent.parent
PURE = ["physics", "bank_builder", "calibration", "clips"]
UNDER = ["controller/device", *(f"controller/workshop/{room}" for room in PURE)]
CPU_S, BUDGET_S, HANGS_S = 60, 5, 100
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


def affordable(tests, path, took):
    """Those of `BUDGET_S`: files named after the module first, then its room's, and one test of each file before the next ones."""
    room = "/".join(["tests", *path.parent.parts[1:]])
    turns = Counter()
    ranked = []
    for test in sorted(tests, key=took.get):
        file = test.partition("::")[0]
        turns[file] += 1
        ranked.append((turns[file] - (5 if path.stem in file else 2 if file.startswith(f"{room}/") else 0), took[test], test))
    chosen, spent = [], 0.0
    for _, seconds, test in sorted(ranked):
        spent += seconds
        if not chosen or spent < BUDGET_S:
            chosen.append(test)
    return chosen


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


PASSES = set()  # tests that were tried without a mutant


def restored(checkout, path):
    rewrite(checkout / path, ast.parse((ROOT / path).read_text()), ast.NodeTransformer())


def verdict(checkout, tests, path, took, quick, restore):
    """What kills the mutant that stands there: `quick` tests, `slower` ones, or none."""
    for form, chosen in (("quick", tests & quick), ("slower", tests - quick)):
        failed = next(filter(None, (failing(checkout, some) for some in nearest_first(affordable(chosen, path, took)))), None)
        if failed:
            restore()
            known = failed.partition(": ")[0]
            if known not in PASSES and failing(checkout, [known]):
                return f"undecided: without it {known} fails too"
            PASSES.add(known)
            return f"{form}: {failed}"
    return "lives" if tests else "lives: nothing reaches it"


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--count", type=int, default=300)
    arguments.add_argument("--seed", type=int, default=2015)
    arguments.add_argument("--under", nargs="+", default=UNDER)
    arguments.add_argument("--reached", type=Path)
    arguments.add_argument("--only", type=Path)
    given = arguments.parse_args()
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False  # of tests, in the copy
    for name in IMPORTED:
        importlib.import_module(name)

    files = [path for under in given.under for path in sorted((ROOT / under).rglob("*.py"))]
    everything = [(path.relative_to(ROOT), *place) for path in files for place in places(path)]
    chosen = random.Random(given.seed).sample(everything, min(given.count, len(everything)))
    again = given.only and {int(line.split()[0]) for line in given.only.read_text().splitlines() if ": lives" in line}
    by_room = {}
    with tempfile.TemporaryDirectory() as folder:
        checkout, reached = Path(folder) / "checkout", given.reached or Path(folder) / "reached"
        Path(folder).chmod(0o755)  # some tests are run as nobody
        shutil.copytree(ROOT, checkout, ignore=shutil.ignore_patterns(".venv", ".git", "build", ".*_cache"), symlinks=True)
        if not reached.exists():
            run_whole(checkout, chosen, reached.absolute())
            for path in {path for path, *_ in chosen}:
                restored(checkout, path)
        tests, took, quick = read_reached(reached)
        for number, (path, line, index) in enumerate(chosen):
            if again is not None and number not in again:
                continue
            what = mutate(checkout / path, index)
            restore = partial(restored, checkout, path)
            found = verdict(checkout, set(tests.get(number, [])), path, took, quick, restore)
            restore()
            by_room.setdefault("/".join(path.parts[1:3]), Counter())[re.match(r"\w+", found)[0]] += 1
            print(f"{number} {path}:{line}  {what}: {found}", flush=True)
    for room, counts in sorted(by_room.items()):
        print(f"{room:30}", dict(counts))
    print(f"{'all':30}", dict(sum(by_room.values(), Counter())))


if __name__ == "__main__":
    main()
