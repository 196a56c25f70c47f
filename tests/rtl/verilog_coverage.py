"""Coverage of the Verilog, read from the coverage.dat that each Verilated bench writes, all benches together.

The file is text, one point a line: `C '\\x01key\\x02value...' count`. A point of page v_line is a run of statements or one
case, of v_branch one side of an if or of a ternary (key S: the lines it stands for; an `else` that is not written has
none), of v_toggle one bit of a signal going one way. A line is covered when everything that stands on it was performed:
both sides of `a ? b : c`. What happens at one place is added up over benches, instances and parameters of the module.

    .venv/bin/python tests/rtl/verilog_coverage.py [--lcov FILE] coverage.dat...
"""

import argparse
import re
import tomllib
from collections import Counter
from pathlib import Path
from typing import NamedTuple

RTL = Path(__file__).parent.parent.parent / "fpga_rtl"
MODULES = sorted(path.stem for path in RTL.glob("*.v"))
LEAST = 0.95  # of the lines of every module, and of all


class Point(NamedTuple):
    """Something that can happen; `kind` is line, branch or toggle."""

    file: str
    line: int
    column: int
    kind: str
    what: str
    lines: tuple[int, ...]


def read(*paths):
    """Counter: how often each point happened, over all files."""
    hits = Counter()
    for path in paths:
        for record in path.read_text().splitlines():
            if record.startswith("C '"):
                keys, count = record[3:].rsplit("' ", 1)
                value = dict(pair.split("\x02", 1) for pair in keys.split("\x01")[1:])
                kind = value["page"].partition("/")[0].removeprefix("v_")
                stands_for = tuple(line for part in value.get("S", "").split(",") if part for line in _span(part))
                hits[Point(Path(value["f"]).name, int(value["l"]), int(value["n"]), kind, value["o"], stands_for)] += int(count)
    return hits


def together(runs):
    """Several runs as one; Counter's own sum would forget what never happened."""
    hits = Counter()
    for run in runs:
        hits.update(run)
    return hits


def _span(part):
    first, _, last = part.partition("-")
    return range(int(first), int(last or first) + 1)


def line_counts(hits):
    """{file: {line: how often the rarest of what stands on it was performed}}."""
    rarest = {}
    for point, count in hits.items():
        of_file = rarest.setdefault(point.file, {})
        for line in point.lines:
            of_file[line] = min(count, of_file.get(line, count))
    return rarest


def load_waivers(path=RTL / "coverage_waivers.toml"):
    return tomllib.loads(path.read_text()).get("waiver", [])


def waive(counts, waivers, folder=RTL):
    """The counts of lines without those waived; and one sentence for everything that is wrong with a waiver.

    A waiver has `file`, `reason`, and `line` or a `pattern` found in the text of the line; it must be needed.
    """
    counts, wrong = {name: dict(of_file) for name, of_file in counts.items()}, []
    for waiver in waivers:
        name, place = waiver["file"], waiver.get("pattern", waiver.get("line"))
        of_file = counts.get(name, {})
        text = (folder / name).read_text().splitlines() if of_file else []
        meant = [line for line in of_file if line == place or (isinstance(place, str) and re.search(place, text[line - 1]))]
        needed = [line for line in meant if not of_file[line]]
        for line in needed:
            del of_file[line]
        if not needed:
            wrong.append(f"the waiver for {name}, {place}, waives nothing: no line without cover is meant")
        if not waiver.get("reason"):
            wrong.append(f"the waiver for {name}, {place}, has no reason")
    return counts, wrong


def table(hits, counts, modules):
    """Rows (module, happened and all of: lines, branches, toggles); the last row is over all."""
    rows = []
    for module in modules:
        lines = list(counts.get(f"{module}.v", {}).values())
        row = [module, sum(map(bool, lines)), len(lines)]
        for kind in ("branch", "toggle"):
            counted = [count for point, count in hits.items() if point.kind == kind and point.file == f"{module}.v"]
            row += [sum(map(bool, counted)), len(counted)]
        rows.append(tuple(row))
    return [*rows, ("all", *(sum(column) for column in zip(*(row[1:] for row in rows), strict=True)))]


def too_little(rows):
    """Modules that do not reach `LEAST`, or of which nothing at all was in any bench; one may be wires without a line."""
    return [module for module, covered, lines, *others in rows if not (lines or any(others)) or covered < LEAST * lines]


def readable(rows):
    """Lines of text: the table."""
    text = [f"{'module':<20}{'lines':>17}{'branches':>17}{'toggles':>19}"]
    for module, *numbers in rows:
        line = f"{module:<20}"
        for happened, of, width in zip(numbers[::2], numbers[1::2], (9, 9, 11), strict=True):
            line += f"{f'{happened}/{of}':>{width}} {100 * happened / of if of else 0:5.1f} %"
        text.append(line)
    return text


def lcov(counts, folder=RTL):
    """The counts of lines as genhtml and editors read them."""
    records = []
    for name, of_file in sorted(counts.items()):
        records += [f"SF:{folder / name}", *(f"DA:{line},{count}" for line, count in sorted(of_file.items())), "end_of_record"]
    return "\n".join(records) + "\n"


def uncovered(counts, folder=RTL):
    """Lines of text: `file:line: source` of every line without cover."""
    return [
        f"{name}:{line}: {(folder / name).read_text().splitlines()[line - 1].strip()}"
        for name, of_file in sorted(counts.items())
        for line in sorted(line for line, count in of_file.items() if not count)
    ]


def main():
    parser = argparse.ArgumentParser(description="Coverage of fpga_rtl/ by benches that were run with Verilator.")
    parser.add_argument("files", nargs="+", type=Path, metavar="coverage.dat")
    parser.add_argument("--lcov", type=Path, metavar="FILE")
    arguments = parser.parse_args()
    hits = read(*arguments.files)
    counts, wrong = waive(line_counts(hits), load_waivers())
    print("\n".join([*readable(table(hits, counts, MODULES)), *uncovered(counts), *wrong]))
    if arguments.lcov:
        arguments.lcov.write_text(lcov(counts))


if __name__ == "__main__":
    main()
