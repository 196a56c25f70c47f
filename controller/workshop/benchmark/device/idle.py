"""Figures under "Idle word and ramp": contrast with and without an idle word, and the sound of arming and disarming.

`haptic-panel focus --idle-figures` makes them. Audible energies (`audible.surface_energy`) are in dB relative to the median
single emission from the board's idle word. The ramp's bits are those of the gateware model; the two references, a step and
a first-order density, are made here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.device.board.board import Board
from controller.workshop.benchmark.focus.focus_figures import emit, idling_low, random_points, spread
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel

Bits = NDArray[np.bool_]
Words = NDArray[np.uint32]

RAMPS_MS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
NOTHING = np.zeros(0, np.uint32)


def idle_figures(board: Board, seed: int = 1, points: int = 20) -> dict[str, Any]:
    """Evaluate a board's idle word and ramp over random points at least 10 mm from the edges; none is left out.

    `contrast`, `amplitude_um`: with the idle word and with all channels idle low. `emission_m2_per_s`: audible energy of the median
    emission. `emission_db`: energy of each emission including its return to the idle word; `return_db`: of that return alone.
    `arming_db`, `disarming_db`: of the board's own ramp, of a step and of other ramps.
    """
    with threadpool_limits(1, "blas"):
        model = ResponseModel(board)
        twins = {"idle_word": PlateTwin(board), "all_low": PlateTwin(idling_low(board))}
        places = tqdm(random_points(board, seed, points).tolist(), desc="idle word", unit="point", disable=None, delay=2)
        rows = [_of_point(board, model, twins, x_m, y_m) for x_m, y_m in places]
        emission = float(np.median([row["emission.idle_word"] for row in rows]))

        def of_points(what: str, scale: Callable[[float], float] = float) -> dict[str, dict[str, float]]:
            return {name: spread([scale(row[f"{what}.{name}"]) for row in rows]) for name in twins}

        def decibels(energy: float) -> float:
            return 10 * float(np.log10(energy / emission))

        return {
            "board": board.name,
            "seed": seed,
            "points": points,
            "ramp_ms": board.limits.ramp_ms,
            "contrast": of_points("contrast"),
            "amplitude_um": of_points("amplitude_um"),
            "emission_m2_per_s": emission,
            "emission_db": of_points("emission", decibels),
            "return_db": of_points("return", decibels),
            **_of_ramps(board, decibels),
        }


def _of_point(board: Board, model: ResponseModel, twins: Mapping[str, PlateTwin], x_m: float, y_m: float) -> dict[str, float]:
    """Contrast, amplitude and audible energies of a focus at a point, for the idle word of each twin."""
    drive_order = model.drive_order_responses([(x_m, y_m)], dtype=np.float64)
    row: dict[str, float] = {}
    for name, twin in twins.items():
        idle = twin.board.idle_word
        words = focus(drive_order, [1.0], idle)
        evaluated = emit(twin, words).focus_metrics(x_m, y_m)
        row[f"contrast.{name}"] = evaluated.contrast
        row[f"amplitude_um.{name}"] = evaluated.amplitude_m * 1e6
        row[f"emission.{name}"] = surface_energy(board, words, idle)
        row[f"return.{name}"] = surface_energy(board, NOTHING, idle, before_word=int(words[-1]))
    return row


def _of_ramps(board: Board, decibels: Callable[[float], float]) -> dict[str, Any]:
    """Audible energy of arming and disarming, with the board's own ramp and with others."""

    def arming(bits: Bits) -> float:
        return decibels(surface_energy(board, ramp_words(board, bits), board.idle_word, before_word=0))

    own = ramp_samples(board, board.limits.ramp_ms)
    leaving = ramp_words(board, ramp_bits(own, up=False))
    return {
        "arming_db": {
            "own_ramp": arming(ramp_bits(own, up=True)),
            "instant": arming(np.zeros(0, np.bool_)),
            "second_order": {f"{ms:g}_ms": arming(ramp_bits(ramp_samples(board, ms), up=True)) for ms in RAMPS_MS},
            "first_order": {f"{ms:g}_ms": arming(first_order_bits(ramp_samples(board, ms))) for ms in RAMPS_MS},
        },
        "disarming_db": {
            "own_ramp": decibels(surface_energy(board, leaving, 0, before_word=board.idle_word)),
            "instant": decibels(surface_energy(board, NOTHING, 0, before_word=board.idle_word)),
        },
    }


def ramp_samples(board: Board, ramp_ms: float) -> int:
    """Length of a ramp of `ramp_ms` in samples, rounded as the session rounds it for the FPGA."""
    return max(1, round(ramp_ms * 1e-3 * board.waveform.bit_clock_hz))


def ramp_words(board: Board, bits: Bits) -> Words:
    """Drive words of a ramp, (sample,): the idle word where the ramp's bit is high, else 0."""
    return np.where(bits, np.uint32(board.idle_word), np.uint32(0))


def first_order_bits(samples: int) -> Bits:
    """First-order density of a linear ramp, (sample,) bits: high whenever the accumulated level passes a whole number."""
    return np.diff(np.cumsum(np.arange(1, samples + 1)) // samples, prepend=0) > 0
