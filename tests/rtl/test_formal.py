"""The proofs of fpga_rtl/formal, and that each fails on its seeded bugs: proofs.py has them.

Any exit code but 0 is red. A broken design must fail at the promise it breaks; what shows it is often a step of the induction
that fails, from a state the proof allows, and not a run from reset. With Yosys they are the slow form. In the normal run z3
proves the gate, and the island from pin to pin, by itself, from the problems that Yosys made of exactly these files.
"""

import re

import pytest
import z3
from proofs import FORMAL, PROOFS, RTL, WITHOUT_YOSYS, failed_promises, inputs_hash, keep_traces, problem_path, run

BUGS = [pytest.param(name, what, id=f"{name}: {what}") for name, proof in PROOFS.items() for what in proof.bugs]
TASKS = [(name, task) for name, tasks in WITHOUT_YOSYS.items() for task in tasks]


def test_each_proof_has_its_bugs_and_each_bug_its_place():
    tasks = {path.stem for path in FORMAL.glob("*.sby")}
    assert tasks == set(PROOFS)
    for name, proof in PROOFS.items():
        assert proof.bugs, name
        for what, bug in proof.bugs.items():
            assert (RTL / (bug.file or proof.file)).read_text().count(bug.old) == 1, f"{name}: {what}"


def assumed(text):
    """Names of a properties file's assumptions; None for one without, but a reset in the first clock is none."""
    found = re.findall(r"(?:(\w+): )?assume \((.{0,5})", re.sub(r"//.*", "", text))
    return [name or None for name, what in found if name or not what.startswith("rst_i")]


def assumptions():
    """(proofs, names, because) of each row of the README's table."""
    (rows,) = re.findall(r"^\| proof \| assumes .*\n\|[-|]+\n((?:\|.*\n)+)", (FORMAL / "README.md").read_text(), re.MULTILINE)
    for row in rows.splitlines():
        proofs, _, names, because = row.strip("| ").split(" | ")
        yield re.findall(r"`(\w+)`", proofs), re.findall(r"`(\w+)`", names), because


def test_each_assumption_of_a_proof_has_its_row_and_each_row_the_other_side():
    files = {path.name.removesuffix("_properties.vh"): path.read_text() for path in FORMAL.glob("*_properties.vh")}
    made = {name: set(assumed(text)) for name, text in files.items()}
    listed = {name: set() for name in files}
    for proofs, names, because in assumptions():
        assert names, because
        for proof in proofs:
            listed[proof] |= made[proof] & set(names)
        assert set(names) <= set().union(*(made[proof] for proof in proofs)), names
        sides = re.findall(r"\w+_\w+(?:\.vh?)?|top\.v|tests/\w+", because)
        promises = set(re.findall(r"(\w+): +assert", "".join(path.read_text() for path in FORMAL.glob("*.vh"))))
        places = {path.name for place in (RTL, RTL / "board", FORMAL) for path in place.iterdir()}
        benches = {path.stem for path in (RTL.parent / "tests" / "rtl").glob("tb_*.py")} | {"tests/conformance"}
        assert set(sides) & (promises | places | benches), because
    assert listed == made


def test_an_assumption_without_a_name_is_noticed():
    assert assumed("initial assume (rst_i);\n// assume (so)\nif (!x) assume (rst_i); low: assume (!a); assume (b);") == [
        "low",
        None,
    ]


NAMED_BEFORE = re.compile(r"\b(?:reg|wire|localparam|integer)\b[^;=]*")
WORDS = {
    "always",
    "posedge",
    "begin",
    "end",
    "else",
    "assume",
    "assert",
    "cover",
    "initial",
    "anyconst",
    "anyseq",
    "signed",
    "clog2",
}


def test_what_is_promised_from_pin_to_pin_names_no_register_of_the_inside():
    text = re.sub(r"//.*", "", (FORMAL / "safety_island_end_to_end_properties.vh").read_text())
    island = re.sub(r"//.*", "", (RTL / "safety_island.v").read_text()).partition(");\n")[0]
    ports = {name for pair in re.findall(r"\b([a-z]\w*_[io])\b|\b([A-Z][A-Z_]+)\b", island) for name in pair}
    own = {name for line in NAMED_BEFORE.findall(text) for name in re.findall(r"[A-Za-z]\w*", line)}
    own |= set(re.findall(r"^wire +(?:signed +)?(?:\[[^]]*\] +)?(\w+) *=", text, re.MULTILINE)) | set(
        re.findall(r"(\w+): +(?:assert|assume|cover)", text)
    )
    used = set(re.findall(r"(?<![`'\w])[A-Za-z]\w*", re.sub(r"'s?[bdh][\dA-F_]+", "", text)))
    assert used - own - ports - WORDS - {"if"} == set()
    inside = {
        name
        for line in NAMED_BEFORE.findall(re.sub(r"//.*", "", (RTL / "safety_island.v").read_text()))
        for name in re.findall(r"\w+_q\b", line)
    }
    assert len(inside) > 8
    assert not used & inside


@pytest.mark.slow
@pytest.mark.parametrize("name", PROOFS)
def test_is_proven(tmp_path, name):
    code, log = run(name, tmp_path)
    assert code == 0, log


@pytest.mark.slow
@pytest.mark.parametrize(("name", "what"), BUGS)
def test_the_proof_fails_with(tmp_path, name, what):
    bug = PROOFS[name].bugs[what]
    code, log = run(name, tmp_path, bug)
    assert code != 0
    assert any(re.fullmatch(bug.promise, promise) for promise in failed_promises(log)), log


def holds(problem, module, depth):
    """Whether z3 proves a problem of Yosys: by induction over `depth` clocks, or, if None, in two clocks from any contents."""

    def never(clocks, from_reset, *more):
        """No clocks in a row, all as assumed, are like this."""
        text = [problem, *(f"(declare-fun s{n} () |{module}_s|)" for n in range(clocks))]
        text += [f"(assert (and (|{module}_h| s{n}) (|{module}_u| s{n})))" for n in range(clocks)]
        text += [f"(assert (|{module}_t| s{n} s{n + 1}))" for n in range(clocks - 1)]
        text += [f"(assert (= (|{module}_is| s{n}) {'true' if from_reset and n == 0 else 'false'}))" for n in range(clocks)]
        text += [f"(assert (|{module}_i| s0))"] if from_reset else []
        solver = z3.Solver()
        solver.from_string("\n".join([*text, *more]))
        return solver.check() == z3.unsat

    def good(n):
        return f"(assert (|{module}_a| s{n}))"

    def bad(n):
        return f"(assert (not (|{module}_a| s{n})))"

    begins_well = all(never(n + 1, True, bad(n)) for n in range(depth or 2))
    return begins_well and (depth is None or never(depth + 1, False, *map(good, range(depth)), bad(depth)))


def module_of(name):
    return PROOFS[name].file.removesuffix(".v")


@pytest.mark.parametrize(("name", "task"), TASKS)
def test_is_proven_without_yosys(name, task):
    stamp, _, problem = problem_path(name, task).read_text().partition("\n")
    assert inputs_hash(name) in stamp, f"{name} has changed: with the extra `gateware`, run python -m tests.rtl.proofs {name}"
    assert holds(problem, module_of(name), WITHOUT_YOSYS[name][task])


@pytest.mark.parametrize(("name", "task"), TASKS)
def test_is_not_proven_without_yosys_where_registers_do_anything(name, task):
    problem, module = problem_path(name, task).read_text(), module_of(name)
    following = re.search(rf"\(define-fun \|{module}_t\|.* Bool \(and", problem)
    assert following
    loose = problem.replace(following[0], following[0].removesuffix("(and") + "(or true")
    assert not holds(loose, module, WITHOUT_YOSYS[name][task])


def test_the_trace_of_a_proof_that_fails_is_kept_and_named(tmp_path):
    made = tmp_path / "formal" / "crc32_long" / "engine_0" / "trace_induct.vcd"
    made.parent.mkdir(parents=True)
    made.write_text("$var")
    kept = tmp_path / "traces" / "crc32_long-trace_induct.vcd"
    assert keep_traces("crc32", tmp_path / "formal", tmp_path / "traces") == f"trace: {kept}: open it with gtkwave or surfer\n"
    assert kept.read_text() == "$var"
    assert keep_traces("play_queue", tmp_path / "formal", tmp_path / "traces") == ""
