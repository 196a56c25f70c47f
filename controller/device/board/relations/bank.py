"""Relations of the bank's cells: their pitch and the plate's waves, their number and size."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.board.relations.relation import refuses, warns

if TYPE_CHECKING:
    from controller.device.board.board import Board

BANK_BYTES = 52.1  # of a cell, for each sample: drive words as frames, and responses
LARGEST_BANK_BYTES = 4e9


def coarse(board: Board, pitch_mm: float) -> Iterator[str]:
    """Why a pitch is too coarse: above half the wavelength of the band's highest frequency, unless `bank.coarse` accepts it."""
    half_m = bending_wavelength_m(board.plate, board.waveform.band_high_hz) / 2
    if pitch_mm * 1e-3 > half_m and not board.bank.coarse:
        yield (
            f"pitch_mm = {pitch_mm:g} is above {math.floor(half_m * 1e5) / 100:g} mm, half a wavelength of the plate at"
            f" waveform.band_high_hz = {board.waveform.band_high_hz:g}: fingers between cells would lose part of their amplitude"
            " or all of it; choose a smaller pitch (bank.coarse = true builds it all the same)"
        )


@refuses("`bank.pitch_mm`, `plate`, `waveform.band_high_hz`")
def _pitch(board: Board) -> Iterator[str]:
    """Cells are at most half a wave apart, unless `bank.coarse`."""
    if board.compose.method == "bank":
        yield from (f"bank.{why}" for why in coarse(board, board.bank.pitch_mm))


@refuses("`bank.pitch_mm`, `plate.length_mm`, `width_mm`")
def _cells(board: Board) -> Iterator[str]:
    """There is a cell."""
    half_mm = min(board.plate.length_mm, board.plate.width_mm) / 2
    if board.compose.method == "bank" and board.bank.pitch_mm > half_mm:
        yield (
            f"bank.pitch_mm = {board.bank.pitch_mm:g} leaves no cell: it is above half of the plate's shorter side, {half_mm:g} mm"
        )


@warns("`bank.snap_mm`, `pitch_mm`")
def _snap(board: Board) -> Iterator[str]:
    """Some places between cells are interpolated."""
    bank = board.bank
    if board.compose.method == "bank" and bank.snap_mm > bank.pitch_mm * 0.5**0.5:
        yield (
            f"bank.snap_mm = {bank.snap_mm:g} reaches every place between cells of bank.pitch_mm = {bank.pitch_mm:g}: no lone"
            f" finger is ever interpolated, and it loses most half a pitch away; set it below {bank.pitch_mm / 2:g}"
        )


@warns("`bank.pitch_mm`, `plate`, `waveform.duration_ms`")
def _bank_size(board: Board) -> Iterator[str]:
    """A bank of the whole plate has at most 4 GB."""
    pitch_mm = board.bank.pitch_mm
    cells = board.plate.length_mm * board.plate.width_mm / pitch_mm**2
    size_bytes = cells * board.waveform.samples * BANK_BYTES
    if board.compose.method == "bank" and size_bytes > LARGEST_BANK_BYTES:
        least_mm = pitch_mm * (size_bytes / LARGEST_BANK_BYTES) ** 0.5
        yield (
            f"bank.pitch_mm = {pitch_mm:g} on plate.length_mm = {board.plate.length_mm:g} and width_mm = {board.plate.width_mm:g}"
            f" is a bank of {size_bytes / 1e9:.3g} GB, more than a device maps with ease: take a pitch of {least_mm:.2g} mm, or"
            " build it for a scene (bank build --scene)"
        )
