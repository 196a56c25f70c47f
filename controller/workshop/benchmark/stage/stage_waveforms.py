"""What ngspice computes of the reference stage and its supply, as a picture: boards/stage/waveforms.svg.

`controller.generate` draws it. It contains the hash of the netlists, so that a picture of other netlists is found.
"""

import io
from pathlib import Path
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Picture

from controller.arrays import Floats
from controller.workshop.benchmark.stage.stage_benches import FAULT_PULSE_S
from controller.workshop.benchmark.stage.stage_circuit import (
    ALIVE_HZ,
    CORNERS,
    SOURCES,
    SUPPLY,
    digest,
    levels,
    netlist,
    stage,
    through_both,
)
from controller.workshop.simulation.ngspice import Traces, transient

COLOURS: Final = ("#1f4e79", "#7a1f1f", "#2e7d32", "#b45309")
POINTS: Final = 400  # of a trace, at most


def waveforms() -> str:
    """Draw what ngspice computes of the typical stage and supply."""
    corner = CORNERS["typical"]
    edge = stage(corner, {}, levels([(5e-6, 1), (45e-6, 0)]), 85e-6)
    end_s = 61e-6  # of the pulse, which a fault follows: low, high, low
    changes = [(1e-6, 1), (1e-6 + FAULT_PULSE_S, 0), (21e-6, 1)]
    changes += [(end_s, 0), (end_s + FAULT_PULSE_S, 1), (end_s + 2 * FAULT_PULSE_S, 0)]
    pulse = stage(corner, {}, levels(changes), 64e-6)
    no_delay = stage(corner, {"low_gate_ohm": 100}, levels([(5e-6, 1), (45e-6, 0)]), 48e-6)
    rails = _supply_traces(corner)
    with mpl.rc_context({"svg.hashsalt": "stage", "font.size": 8.5, "font.family": "DejaVu Sans", "svg.fonttype": "none"}):
        picture = Picture(figsize=(10, 6.2), layout="constrained")
        plots = picture.subplots(2, 2)
        _plot(plots[0, 0], "One pulse of 40 µs", edge, (0, 85e-6), "µs", {"v(xs.out)": "stage, V", "v(patch)": "patch, V"})
        title = "The end of a fault: low for 16 ns, high for 16 ns, low"
        names = {"v(drive)": "pin of the FPGA, V", "v(xs.low_gate)": "gate of the low side, V", "v(xs.out)": "stage, V"}
        _plot(plots[0, 1], title, pulse, (60.9e-6, 62.4e-6), "µs", names)
        _plot_currents(plots[1, 0], pulse, end_s, no_delay)
        title = "The supply: hv_enable at 0, hv_alive lost at 3 ms"
        names = {"v(enable)": "hv_enable, V", "v(xsupply.store)": "charge pump, V", "v(v60)": "60 V to the stages, V"}
        _plot(plots[1, 1], title, rails, (0, 8e-3), "ms", names)
        for each in plots.flat:
            each.grid(color="0.9", lw=0.6)
            each.spines[["top", "right"]].set_visible(False)
        drawn = io.StringIO()
        picture.savefig(drawn, format="svg", metadata={"Description": f"netlists {digest()}", "Date": None, "Creator": None})
    return drawn.getvalue()


def _plot_currents(plot: Any, fault: Traces, fault_s: float, no_delay: Traces) -> None:
    """Current through both switches at a fault, and at an edge with a wrong part."""
    times_s = np.linspace(-0.1e-6, 0.7e-6, POINTS)
    found = {"at the fault above": (fault, fault_s), "falling edge with R2 of 100 Ω: a wrong part": (no_delay, 45e-6)}
    for (label, (traces, begin_s)), colour in zip(found.items(), COLOURS, strict=False):
        both_ma = np.interp(times_s, traces.time_s - begin_s, 1e3 * through_both(traces))
        plot.plot(times_s * 1e6, both_ma, color=colour, lw=1.2, label=label)
    plot.set(title="Current through both switches", xlabel="µs", ylabel="mA")
    plot.legend(frameon=False)


def _supply_traces(corner: Any) -> Traces:
    half_s = 0.5 / ALIVE_HZ
    beats = [(half_s * n, n % 2) for n in range(1, int(3e-3 / half_s))]
    lines = (*SOURCES, f"Venable enable 0 {levels([(1e-9, 1)])}", f"Valive alive 0 {levels(beats)}", SUPPLY)
    return transient(netlist(corner, {}, *lines), ("v(enable)", "v(v60)", "v(xsupply.store)"), 2e-6, 8e-3)


def _plot(plot: Any, title: str, traces: Traces, span_s: tuple[float, float], unit: str, names: dict[str, str]) -> None:
    times: Floats = np.linspace(*span_s, POINTS)
    scale = {"µs": 1e6, "ms": 1e3}[unit]
    for (name, label), colour in zip(names.items(), COLOURS, strict=False):
        plot.plot((times - span_s[0]) * scale, np.interp(times, traces.time_s, traces[name]), color=colour, lw=1.2, label=label)
    plot.set(title=title, xlabel=unit)
    plot.legend(frameon=False)


def pictures(folder: Path) -> dict[Path, str]:
    """The picture in a folder; of these netlists it is kept, and nothing is drawn."""
    path = folder / "waveforms.svg"
    kept = path.read_text(encoding="utf-8") if path.exists() else ""
    return {path: kept if f"netlists {digest()}" in kept else waveforms()}
