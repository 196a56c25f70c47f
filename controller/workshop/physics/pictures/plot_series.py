"""Panels of an emission over time, beside the picture of its focus; in black and greys, to be printed."""

from __future__ import annotations

from typing import Any

import numpy as np

from controller.device.board.board import Board
from controller.workshop.physics.audible import AUDIBLE_HZ
from controller.workshop.physics.pictures.focus_series import FocusSeries

PERIODS = 6  # of the band's middle, before T
LEAST_DB = -80.0


def draw_series(figure: Any, board: Board, series: FocusSeries) -> None:
    """Draw voltages, displacement and spectrum of a focus."""
    waveform = board.waveform
    near_s = PERIODS * 2 / (waveform.band_low_hz + waveform.band_high_hz)
    time_us, time_ms, u_um = series.time_s * 1e6, series.time_s * 1e3, series.displacement_m * 1e6
    volts, whole, near, spectrum = figure.subplots(4, 1, height_ratios=[1.5, 1, 1, 1.2])

    shown = (series.time_s >= -near_s) & (series.time_s <= near_s / 3)
    tall = 1.5 * board.driver.supply_v
    for row, channel in enumerate(series.channels):
        volts.step(time_us[shown], series.stage_v[shown, row] - row * tall, where="pre", color="0.6", lw=0.8)
        volts.plot(time_us[shown], series.piezo_v[shown, row] - row * tall, color="black", lw=1)
        volts.text(time_us[shown][0], -row * tall, f"{channel} ", ha="right", va="bottom", fontsize=8)
    volts.axvline(0, color="black", lw=0.6, ls=":")
    volts.set(yticks=[], ylabel="channels", title=f"bits of 0 and {board.driver.supply_v:g} V (grey), voltage behind the driver")
    volts.set_xlabel("time from T (µs)")

    whole.plot(time_ms, u_um, color="black", lw=0.5)
    whole.set(xlabel="time from T (ms)", ylabel="µm", title="displacement of the focus", xlim=(time_ms[0], time_ms[-1]))

    shown = np.abs(series.time_s) <= near_s / 2
    near.plot(time_us[shown], u_um[shown], color="black", lw=1)
    near.axhline(0, color="0.7", lw=0.6)
    top = float(u_um[np.argmin(np.abs(series.time_s))])
    near.axhline(top / 2, color="0.4", lw=0.8, ls="--")
    near.set(xlabel="time from T (µs)", ylabel="µm", title="around T; dashed: half height")

    frequency_hz, size = series.spectrum()
    highest_hz = 1.5 * waveform.band_high_hz
    drawn = (frequency_hz > 0) & (frequency_hz <= highest_hz)
    largest = float(size[drawn].max()) or 1.0
    level_db = np.maximum(20 * np.log10(np.maximum(size[drawn] / largest, 1e-12)), LEAST_DB)
    spectrum.plot(frequency_hz[drawn] * 1e-3, level_db, color="black", lw=0.5)
    for edge_hz in (waveform.band_low_hz, waveform.band_high_hz):
        spectrum.axvline(edge_hz * 1e-3, color="black", lw=0.9, ls="--")
    spectrum.axvspan(0, min(AUDIBLE_HZ, highest_hz) * 1e-3, color="0.88", lw=0)
    spectrum.set(xlabel="frequency (kHz)", ylabel="dB", xlim=(0, highest_hz * 1e-3), ylim=(LEAST_DB, 5))
    spectrum.set_title("its spectrum; dashed: band, grey: audible")
    for panel in (volts, whole, near, spectrum):
        panel.title.set_fontsize(9)
