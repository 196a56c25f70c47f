"""Waves: the pins of the compiled Verilog, and frames decoded beside them (simulation/frame_view.sv), in an FST file."""

import math
from collections.abc import Callable
from pathlib import Path

from controller.errors import ConfigError
from controller.workshop.gateware.input_script import InputScript, Simulated
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.rtl_build import traced_design
from controller.workshop.gateware.rtl_gateware import RtlGateware

LEAD_MS, TAIL_MS = 3.5, 0.5  # shown before and behind the end of an emission
FILE_BYTES, PINS_BYTES, INSIDE_BYTES = 10_000, 1.0, 60.0  # of a file, and for a tick, at most; measured: 0.1 to 0.6, 30
TRACED_BYTES_MAX = 2e9
BIT, HEX, NAMED = "@28", "@22", "@100000028"  # how GTKWave shows what follows; by the names of an enumeration
FRAMES = "TOP.haptic_core.frames"
VIEW = [  # what it shows at first
    *(BIT, "TOP.spi_cs_n_i", "TOP.spi_sck_i"),
    *(NAMED, f"{FRAMES}.spi_kind[7:0]", f"{FRAMES}.done_kind[7:0]", f"{FRAMES}.done_result[7:0]", f"{FRAMES}.gate[5:0]"),
    *(BIT, "TOP.trigger_i", "TOP.waiting_o", "TOP.focus_o", "TOP.hv_enable_o", "TOP.fault_o"),
    *(HEX, "TOP.channel_o[31:0]"),
]
WHOLE = 2.45  # of GTKWave's zoom, by which all of the file is seen in a window of 1,400 pixels
TICKS_PER_S, TRACED_TICKS_PER_S, INSIDE_TICKS_PER_S = 1.5e6, 4e5, 5e4  # simulated before the traced ones; and of those


def foci(script: InputScript) -> list[int]:
    """Ticks at which emissions end, by the model; raises ConfigError for what the pins do not allow."""
    model = GatewareModel(script.parameters)
    _perform(script, model, script.end_tick)
    return [int(tick) for tick in model.take_capture().focus_ticks]


def window_of_emission(script: InputScript, number: int) -> range:
    """Ticks around the end of an emission, counted from 1; raises ConfigError if there are fewer."""
    found = foci(script)
    if not 1 <= number <= len(found):
        raise ConfigError(f"--emission {number}: {len(found)} emissions end in what is simulated: give --from-ms and --to-ms")
    per_ms = script.parameters.clock_hz / 1e3
    focus = found[number - 1]
    return range(max(0, round(focus - LEAD_MS * per_ms)), min(script.end_tick, round(focus + TAIL_MS * per_ms)))


def most_bytes(ticks: range, *, inside: bool) -> float:
    """What a trace of these ticks takes at most."""
    return FILE_BYTES + len(ticks) * (INSIDE_BYTES if inside else PINS_BYTES)


def seconds(ticks: range, *, inside: bool) -> float:
    """About what it takes here, without compiling."""
    return ticks.start / TICKS_PER_S + len(ticks) / (INSIDE_TICKS_PER_S if inside else TRACED_TICKS_PER_S)


def trace(script: InputScript, ticks: range, path: Path, compiling: Callable[[], None], *, inside: bool) -> None:
    """Perform a script up to the last of these ticks, and write them to an FST file; with `inside` every signal.

    Raises ConfigError for what the pins do not allow, LinkError if the Verilog cannot be compiled, OSError if the file cannot be
    written.
    """
    gateware = RtlGateware(script.parameters, compiling, traced_design())
    gateware.trace(path, 1e12 / script.parameters.clock_hz, ticks, inside=inside)
    try:
        _perform(script, gateware, ticks.stop)
    finally:
        gateware.close_trace()


def write_view(path: Path, ticks: range, tick_ps: float) -> Path:
    """Write a GTKWave save file beside a trace of these ticks, with the pins and frames that one looks at first; its path.

    Raises OSError if it cannot be written.
    """
    view = path.with_suffix(".gtkw")
    begin_ps, zoom = ticks.start * tick_ps, math.log2(len(ticks) * tick_ps) - WHOLE
    head = f'[dumpfile] "{path.resolve()}"\n[timestart] {begin_ps:.0f}\n[size] 1400 420\n*-{zoom:.2f} {begin_ps:.0f}\n'
    head += "[sst_expanded] 0\n[signals_width] 180\n"
    view.write_text(head + "\n".join([*VIEW, ""]), encoding="utf-8")
    return view


def _perform(script: InputScript, gateware: Simulated, end_tick: int) -> None:
    try:
        script.perform(gateware, end_tick)
    except ValueError as error:
        raise ConfigError(f"the script does what the pins do not allow: {error}") from error
