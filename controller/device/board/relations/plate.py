"""Relations of the plate to the waves in it: thickness, size and damping beside the band and the length of an emission."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.relations.bending_waves import (
    bending_wavelength_m,
    kirchhoff_wavelength_m,
    mindlin_shift,
    mindlin_wavelength_m,
)
from controller.device.board.relations.relation import refuses, warns

if TYPE_CHECKING:
    from controller.device.board.board import Board

THICKEST = 0.3  # of the shortest wave: beyond it not even Mindlin's theory holds
MOST_SHIFT = 0.05  # of the frequency, by the shear and inertia that Kirchhoff's theory leaves out; layers of 4 to 5 % are refused
FEWEST_WAVES = 2.0  # along the plate's shorter side
FEWEST_MODES = 50.0  # in the band
LONGEST_DECAYS = 3.0  # what is emitted earlier has decayed
LONGEST_WORDS = 1000  # of an emission
LEAST_WIDTH = 0.4  # of a band, over one over the longest emission: its filter rings for as long as that of the lowest band
FEWEST_PERIODS = 10.0  # of the band's width within an emission
WIDEST_FOCUS_MM = 15.0  # a fingertip
FOCUS = 0.54  # of a wave in the middle of the band: 5.7 mm of 10.54 mm on the paper's plate


@refuses("`plate.thickness_mm`, material, `waveform.band_high_hz`")
def _thickness(board: Board) -> Iterator[str]:
    """The plate is below 0.3 of its shortest wave."""
    high_hz = board.waveform.band_high_hz
    wave_mm = mindlin_wavelength_m(board.plate, high_hz) * 1e3
    if board.plate.thickness_mm > THICKEST * wave_mm:
        yield (
            f"plate.thickness_mm = {board.plate.thickness_mm:g} is {board.plate.thickness_mm / wave_mm:.2g} of the wave of"
            f" {wave_mm:.3g} mm at waveform.band_high_hz = {high_hz:g}: above {THICKEST:g} no theory of plates holds; is it in"
            " mm? Else take a lower band"
        )


@warns("`plate.theory`, `thickness_mm`, `waveform.band_high_hz`")
def _theory(board: Board) -> Iterator[str]:
    """Kirchhoff's theory errs by 5 % at most."""
    high_hz = board.waveform.band_high_hz
    shift = mindlin_shift(board.plate, high_hz)
    if board.plate.theory == "kirchhoff" and shift > MOST_SHIFT:
        yield (
            f'plate.theory = "kirchhoff" leaves out {100 * shift:.2g} % of the frequency at waveform.band_high_hz ='
            f" {high_hz:g} with"
            f' plate.thickness_mm = {board.plate.thickness_mm:g}: set theory = "mindlin"'
        )


@warns("`plate.length_mm`, `width_mm`, `waveform`")
def _plate_in_waves(board: Board) -> Iterator[str]:
    """The plate is two waves wide or more."""
    wave_mm = bending_wavelength_m(board.plate, board.waveform.middle_hz) * 1e3
    short_mm = min(board.plate.length_mm, board.plate.width_mm)
    if short_mm < FEWEST_WAVES * wave_mm:
        yield (
            f"plate.length_mm = {board.plate.length_mm:g} and width_mm = {board.plate.width_mm:g}: the plate is only"
            f" {short_mm / wave_mm:.2g} waves of {wave_mm:.3g} mm wide: there is no place outside a focus; take a higher band or"
            " thinner glass"
        )


@warns("`plate.thickness_mm`, material, `waveform`")
def _focus_width(board: Board) -> Iterator[str]:
    """A focus is no wider than a fingertip."""
    focus_mm = FOCUS * bending_wavelength_m(board.plate, board.waveform.middle_hz) * 1e3
    if focus_mm > WIDEST_FOCUS_MM:
        yield (
            f"plate.thickness_mm = {board.plate.thickness_mm:g} with waveform.band_low_hz = {board.waveform.band_low_hz:g} and"
            f" band_high_hz = {board.waveform.band_high_hz:g}: a focus is {focus_mm:.3g} mm wide, more than a fingertip; take"
            " thinner glass or a higher band"
        )


@warns("`plate`, `waveform.band_low_hz`, `band_high_hz`")
def _modes(board: Board) -> Iterator[str]:
    """There are 50 modes in the band or more."""
    waveform, plate = board.waveform, board.plate
    per_hz = math.pi * plate.length_m * plate.width_m / kirchhoff_wavelength_m(plate, 1.0) ** 2  # eq. (2)
    modes = per_hz * (waveform.band_high_hz - waveform.band_low_hz)
    if modes < FEWEST_MODES:
        yield (
            f"waveform.band_low_hz = {waveform.band_low_hz:g} to band_high_hz = {waveform.band_high_hz:g}: the plate has only"
            f" {modes:.2g} modes in the band, and waves of fewer than {FEWEST_MODES:g} do not focus everywhere; take a wider band"
        )


@warns("`waveform.duration_ms`, `plate.decay_time_ms`")
def _decay(board: Board) -> Iterator[str]:
    """An emission lasts three decay times at most."""
    waveform, damping = board.waveform, board.plate.damping
    decays = [decay.decay_time_ms for decay in damping.decay_times] if damping else []
    decay_ms = max(decays, default=board.plate.decay_time_ms)
    if waveform.duration_ms > LONGEST_DECAYS * decay_ms:
        yield (
            f"waveform.duration_ms = {waveform.duration_ms:g} is {waveform.duration_ms / decay_ms:.3g} times plate.decay_time_ms"
            f" = {decay_ms:g}: what is emitted more than {LONGEST_DECAYS:g} times before the end has decayed; shorten it"
        )


@refuses("`waveform.band_low_hz`, `band_high_hz`, `bit_clock_hz`")
def _resolved(board: Board) -> Iterator[str]:
    """1,000 words, the longest emission, last a period of the band's lower edge, and 0.4 of one of its width."""
    waveform = board.waveform
    least_hz, width_hz = waveform.bit_clock_hz / LONGEST_WORDS, waveform.band_high_hz - waveform.band_low_hz
    if waveform.band_low_hz < least_hz or width_hz < LEAST_WIDTH * least_hz:
        yield (
            f"waveform.band_low_hz = {waveform.band_low_hz:g} and band_high_hz = {waveform.band_high_hz:g}: {LONGEST_WORDS} words"
            f" of bit_clock_hz = {waveform.bit_clock_hz:g} tell no less than {least_hz:g} Hz from rest, and make no band narrower"
            f" than {LEAST_WIDTH * least_hz:g} Hz: take a higher and wider band, or a slower bit clock"
        )


@warns("`waveform.duration_ms`, `band_low_hz`, `band_high_hz`")
def _periods(board: Board) -> Iterator[str]:
    """An emission is long enough for its band."""
    waveform = board.waveform
    width_hz = waveform.band_high_hz - waveform.band_low_hz
    if waveform.duration_s * width_hz < FEWEST_PERIODS:
        yield (
            f"waveform.duration_ms = {waveform.duration_ms:g} in a band of {width_hz:g} Hz gathers only"
            f" {waveform.duration_s * width_hz:.2g} independent waves: nothing stands out of them; play longer, or in a wider"
            " band"
        )
