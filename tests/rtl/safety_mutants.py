"""For each protection of the safety table (fpga_rtl/README.md) a change that takes it away: a test of its row must fail then."""

import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from benches import make_variables

HERE = Path(__file__).parent
RTL = HERE.parent.parent / "fpga_rtl"


class Change(NamedTuple):
    """Text of a module that is replaced, once, and by what."""

    module: str
    old: str
    new: str


MUTANTS = {
    "silence is not counted": Change("output_gate", "silence_q <= silence_q - 32'd1;", "silence_q <= silence_q;"),
    "any link feeds": Change("safety_island", "heard_i && !off_o && link_i == link_q", "heard_i && !off_o"),
    "permit ignored": Change("output_gate", "= !run_permit_i;", "= 1'b0;"),
    "heat ignored": Change("output_gate", "= !temperature_good_i;", "= 1'b0;"),
    "the pipeline is not flushed": Change(
        "output_gate", "on_later_q    <= {on_later_q[1:0], on} & {3{stays}};", "on_later_q    <= {on_later_q[1:0], on};"
    ),
    "every CRC is right": Change(
        "frame_decoder", "accept_q <= sync_good_q && whole && crc == `CRC_RESIDUE;", "accept_q <= sync_good_q && whole;"
    ),
    "every key opens": Change("register_file", "write_i && unlock_q && key_good_q;", "write_i && unlock_q;"),
    "every slot is intact": Change("waveform_buffer", "if (crc == expected_q) intact_q", "intact_q"),
    "a buffer in use is loaded": Change("waveform_buffer", "= chunk_good_q && !load_busy_i &&", "= chunk_good_q &&"),
    "pulses are not watched": Change("safety_island", ".pulse_ticks_i(pulse_ticks_q)", ".pulse_ticks_i(16'd0)"),
    "one clock is a trigger": Change("trigger_input", "high = trigger_q[3:1] == 3'b111;", "high = trigger_q[1];"),
    "underrun ignored": Change("output_gate", "= underrun_i;\n    assign", "= 1'b0;\n    assign"),
    "limits ignored": Change("output_gate", "= limits_i;", "= 5'd0;"),
    "edges found out once off are lost": Change(
        "output_gate", "{live_q}} | OF_EDGES", "{live_q}} | ~OF_EDGES[`FAULT_CAUSES-1:0] & OF_EDGES"
    ),
    "the host sets the limit": Change("safety_island", "most_edges ? CHANNEL_EDGES_MAX[EDGE_BITS-1:0] :", ""),
    "every channel has a stage": Change("safety_island", "channel_mask_i & CHANNEL_MASK_MAX", "channel_mask_i"),
    "the supply does not settle": Change("output_gate", "settle_left_q == {SETTLE_BITS{1'b0}}", "1'b1"),
    "the lost clock is waited for": Change("output_gate", "@(posedge clk_i or posedge clock_lost_i)", "@(posedge clk_i)"),
    "the beat never stops": Change("output_gate", "hv_alive_q  <= open && !rst_i && (", "hv_alive_q  <= !rst_i && ("),
    "a permit waits for the clock": Change(
        "permit_latch", "always @(posedge clk_i or negedge run_permit_i)", "always @(posedge clk_i)"
    ),
    "any code is a state": Change("output_gate", "exists      = on || state_q == OFF;", "exists      = 1'b1;"),
    "reset a clock late": Change("output_gate", "hv_enable_q <= open && !rst_i;", "hv_enable_q <= open;"),
    "no ramp down": Change(
        "output_gate", "ON:        if (disarm_i) state_q <= STOPPING;", "ON:        if (disarm_i) state_q <= OFF;"
    ),
}


def rows():
    """(hazard, protection, proofs, tests, mutants) of the safety table, as text."""
    text = (RTL / "README.md").read_text().partition("## Safety\n")[2].partition("\n## ")[0]
    (table,) = re.findall(r"^\| hazard \|.*\n\|[-|]+\n((?:\|.*\n)+)", text, re.MULTILINE)
    return [tuple(cell.strip() for cell in line.strip().strip("|").split(" | ")) for line in table.splitlines()]


def tests_named(cell):
    """(bench, beginning of a test's name) of each test named in a cell."""
    named, bench = [], ""
    for bench_name, test in re.findall(r"\b(tb_\w+)\b|`(\w+)…`", cell):
        bench = bench_name or bench
        if test:
            named.append((bench, test))
    return named


def failed(name, tests, simulator, folder):
    """Names of the tests that fail with a mutant, of those that a row names in one bench: the module's own, or the core's."""
    change = MUTANTS[name]
    benches = {bench for bench, _ in tests}
    bench = f"tb_{change.module}" if f"tb_{change.module}" in benches else "tb_haptic_core"
    source = shutil.copytree(RTL, folder / "fpga_rtl") / f"{change.module}.v"
    source.write_text(source.read_text().replace(change.old, change.new))
    chosen = "|".join(test for own, test in tests if own == bench)
    program = f"""
        import sys
        from pathlib import Path
        import benches
        benches.TRACED = False
        benches.RTL = Path({str(folder / "fpga_rtl")!r})
        benches.RUNS[{bench.removeprefix("tb_")!r}](simulator={simulator!r}, folder=Path({str(folder)!r}), test_filter={chosen!r})
    """
    variables = {"PYTHONPATH": os.pathsep.join(sys.path), "MAKEFLAGS": make_variables(bench.removeprefix("tb_"))}
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)],
        env=os.environ | variables,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    results = folder / "results.xml"
    assert results.exists(), f"{name} was not built:\n{done.stdout[-3000:]}"
    cases = ElementTree.parse(results).getroot().iter("testcase")
    return [case.get("name") for case in cases if case.find("failure") is not None or case.find("error") is not None]
