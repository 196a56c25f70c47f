"""Do the tests notice a fault of the Python? A sample of mutants, each run against the tests that reach it until one fails.

usage: python -m tests.mutants [--count N] [--seed N] [--under PATH ...] [--reached FILE] [--only FILE] [--budget-s S]
       [--kept FOLDER] [--workers N | --dask ADDRESS | --scheduler-file FILE]

A mutant is one small change of a function: a comparison, an operator, a constant, a negated condition, a call left out. What may
kill it is what reaches its statement in one run of README's line: the quick tests first, then the others, each form for at most
--budget-s of processor time as that run took them, of each test file its first ones. --reached keeps that run in a file. --only
takes mutants again that a list of verdicts has as alive: with a larger budget by more tests. A process of tests has a limit of
processor time, so that one that loops for ever is killed too. Each worker makes mutants in a copy of its checkout; a test that
fails without them decides nothing.

The run and each verdict are kept in build/, or --kept: the same command goes on from them, on the same files. Verdicts come on
stderr as they are found, all in their order on stdout in the end. Workers of --dask are started in a checkout of the same files,
with PYTHONPATH=.
"""

import argparse
import hashlib
import json
import random
import re
import sys
from collections import Counter
from pathlib import Path

from controller.commands.common.worker_options import add_worker_options, workers_of
from controller.console import program
from controller.workshop.workers.map_kept import map_kept
from tests.asked import ROOT, Asked, source
from tests.mutants_decided import Mutant, copy_of_root, places
from tests.mutants_reached import read_reached, run_whole

PURE = ["physics", "bank_builder", "calibration", "clips"]
UNDER = ["controller/device", *(f"controller/workshop/{room}" for room in PURE)]


def affordable(tests, path, took, budget_s):
    """Those of `budget_s`: files named after the module first, then its room's, and one test of each file before the next ones."""
    room = "/".join(["tests", *path.parent.parts[1:]])
    turns = Counter()
    ranked = []
    for test in sorted(tests, key=lambda test: (took[test], test)):
        file = test.partition("::")[0]
        turns[file] += 1
        ranked.append((turns[file] - (5 if path.stem in file else 2 if file.startswith(f"{room}/") else 0), took[test], test))
    chosen, spent = [], 0.0
    for _, seconds, test in sorted(ranked):
        spent += seconds
        if not chosen or spent < budget_s:
            chosen.append(test)
    return chosen


def traced(chosen, reached):
    """Write what reaches the mutants into a file, whole."""
    part = reached.with_suffix(".part")
    part.unlink(missing_ok=True)  # of a run that was killed
    with copy_of_root() as checkout:
        run_whole(checkout, chosen, part.absolute())
    part.replace(reached)


@program
def main():
    """Decide mutants, and print verdicts and their numbers by room."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--count", type=int, default=300)
    arguments.add_argument("--seed", type=int, default=2015)
    arguments.add_argument("--under", nargs="+", default=UNDER)
    arguments.add_argument("--reached", type=Path)
    arguments.add_argument("--only", type=Path)
    arguments.add_argument("--budget-s", type=float, default=5)
    arguments.add_argument("--kept", type=Path, default=ROOT / "build")
    add_worker_options(arguments)
    given = arguments.parse_args()
    workers = workers_of(given)

    files = [path for under in given.under for path in sorted((ROOT / under).rglob("*.py")) or [ROOT / under]]
    everything = [(path.relative_to(ROOT), *place) for path in files for place in places(path)]
    chosen = random.Random(given.seed).sample(everything, min(given.count, len(everything)))
    digest = hashlib.sha256(f"{source()} {chosen}".encode())
    given.kept.mkdir(parents=True, exist_ok=True)
    reached = given.reached or given.kept / f"mutants-{digest.hexdigest()[:16]}.reached"
    if not reached.exists():
        traced(chosen, reached)
    digest.update(reached.read_bytes() + str(given.budget_s).encode())
    tests, took, quick = read_reached(reached)
    again = given.only and {int(line.split()[0]) for line in given.only.read_text().splitlines() if ": lives" in line}
    items = {}
    for number, (path, _, index) in enumerate(chosen):
        if again is None or number in again:
            near = set(tests.get(number, []))
            forms = [affordable(some, path, took, given.budget_s) for some in (near & quick, near - quick)]
            items[number] = Mutant(str(path), index, *forms)
    kept = given.kept / f"mutants-{digest.hexdigest()[:16]}.kept"
    found = map_kept(Asked(("tests.mutants_decided",)), items, kept, workers, what="mutants", unit="mutant").results
    by_room = {}
    for number in items:
        path, line, _ = chosen[number]
        what, verdict = json.loads(found[number])
        by_room.setdefault("/".join(path.parts[1:3]), Counter())[re.match(r"\w+", verdict)[0]] += 1
        print(f"{number} {path}:{line}  {what}: {verdict}")
    for room, counts in sorted(by_room.items()):
        print(f"{room:30}", dict(counts))
    print(f"{'all':30}", dict(sum(by_room.values(), Counter())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
