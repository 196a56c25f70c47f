"""Picture for `haptic-panel focus --amplitude-figures --plot FILE`: requested against reached amplitude, contrast, edges."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from controller.workshop.physics.pictures.figure_file import save_figure


def plot_amplitude(path: Path, figures: dict[str, Any]) -> None:
    """Draw the figures of `amplitude_figures` to a .png, .svg or .pdf file; raises ConfigError if the file cannot be written."""
    figure = Figure(figsize=(11, 4.5), layout="constrained")
    against, errors, single = figure.subplots(1, 3)
    ends = np.array([0.2, 1.05])
    against.fill_between(ends, 0.95 * ends, 1.05 * ends, color="0.9", label="within 5 %")
    errors.axhspan(-5, 5, color="0.9")
    for (fingers, found), marker in zip(figures["fingers"].items(), "os^.", strict=True):
        asked, got = np.array(found["asked"]), np.array(found["got"])
        label = f"{fingers} finger{'s' * (fingers != '1')}"
        against.plot(asked, got, marker, ms=4, label=label)
        errors.plot(asked, 100 * (got / asked - 1), marker, ms=4, label=label)
    against.set(xlabel="amplitude asked for", ylabel="of what exact composition gives at full", aspect="equal", title="got")
    against.legend(fontsize=8)
    errors.set(xlabel="amplitude asked for", ylabel="error (%)", ylim=(-15, 15), title="error")
    amplitudes = [float(amplitude) for amplitude in figures["single"]]
    for name, label in (
        ("contrast_of_full", "contrast"),
        ("spot_of_full", "spot"),
        ("edges_busiest_channel", "edges, busiest channel"),
        ("edges_all", "edges, all"),
    ):
        rows = np.array([[row[name][kind] for kind in ("min", "median", "max")] for row in figures["single"].values()])
        rows /= rows[-1, 1]
        reach = np.abs(rows[:, [0, 2]] - rows[:, [1]]).T
        single.errorbar(amplitudes, rows[:, 1], reach, fmt="o-", ms=4, capsize=3, label=label)
    single.set(xlabel="amplitude", ylabel="over the median at full amplitude", ylim=(0, None), title="one finger")
    single.legend(fontsize=8)
    save_figure(figure, path, 110)
