"""Figures under "Focus": amplitude, contrast, spot, peak time and sound of foci on the plate, one and four at a time.

`haptic-panel focus --figures` makes them at random points, of which none is left out; `haptic-panel focus --at X Y` at
given points. All functions return plain numbers, ready for `--json`.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits
from tqdm import tqdm

from controller.arrays import Floats
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.board.board import Board
from controller.workshop.physics.audible import surface_energy
from controller.workshop.physics.field import Field
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.plate import mode_cut_hz, wave_scale
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.sound import PlateSound, decibels
from controller.workshop.physics.word_capture import capture_of_words

Figures = dict[str, Any]

# On the paper's plate; on others they go with the length of its waves
MARGIN_M = 10e-3
INNER_M = 20e-3  # nearer to an edge, its mirror image correlates neighbouring responses: a share of up to 0.57 instead of 0.53
SQUARE_M = 10e-3
SETTLED = 40  # time constants of the slowest pole (6 ms: mode (1, 1) is overdamped) from the step to the idle word on


def figures(board: Board, seed: int = 1, points: int = 20, *, progress: bool = False) -> Figures:
    """Evaluate foci of a board at random points at least 0.95 wavelengths from the edges: min, median and max of each figure.

    Four foci are evaluated twice: all at least 1.9 wavelengths from the edges, and all at least 0.95. Those are 20 and 10 mm on the
    paper's plate.
    """
    low = idling_low(board)
    with (
        threadpool_limits(1, "blas"),  # products this small lose more to a second thread than it gives
        tqdm(total=5 * points, unit="point", desc="figures", disable=None if progress else True) as bar,
    ):

        def counted(places: Floats) -> Iterator[Floats]:
            for place in places:
                yield place
                bar.update()

        model = ResponseModel(board)
        scale = wave_scale(board)
        places = random_points(board, seed, points)
        inner = random_points(board, seed, points, (INNER_M + SQUARE_M / 2) * scale)
        outer = random_points(board, seed, points, (MARGIN_M + SQUARE_M / 2) * scale)
        return {
            "seed": seed,
            "points": points,
            "modes": model.modes,
            "moment_n_per_v": board.driver.moment_n_per_v,
            "single": single_foci(board, model, counted(places)),
            "single_all_idle_low": single_foci(low, model, counted(places)),
            "four_foci": four_foci(board, model, counted(inner)),
            "four_foci_near_edges": four_foci(board, model, counted(outer)),
            "float32": float32_against_float64(board, model, counted(places)),
        }


def random_points(board: Board, seed: int, count: int, margin_m: float | None = None) -> Floats:
    """Draw `count` points at least `margin_m` from the plate's edges, or two fifths of a side: (point, 2) array in m."""
    sides = np.array([board.plate.length_m, board.plate.width_m])
    margin = np.minimum(MARGIN_M * wave_scale(board) if margin_m is None else margin_m, 0.4 * sides)
    return np.random.default_rng(seed).uniform(margin, sides - margin, (count, 2))


def idling_low(board: Board) -> Board:
    """Return the same board with an idle word of 0: all channels rest at 0 V."""
    return msgspec.structs.replace(board, actuators=tuple(msgspec.structs.replace(a, idle=0) for a in board.actuators))


def emit(twin: PlateTwin, words: NDArray[np.uint32]) -> Field:
    """Play drive words, (sample,), on a plate at rest at the idle word; the field at T."""
    board = twin.board
    settled = round(SETTLED / float(np.min(-twin.step.poles.real)) * board.link.clock_hz)
    return next(
        twin.fields(
            capture_of_words(words, board.bit_ticks, board.idle_word, settled), board.bit_ticks * board.waveform.bit_clock_hz
        )
    )


def single_foci(board: Board, model: ResponseModel, points_m: Iterable[Floats]) -> Figures:
    """Evaluate foci one at a time: amplitude, contrast, spot, time of the peak, and sound; min, median and max of each.

    `model` is of a board with the same plate and driver; each point is (2,). `audible_m2_per_s` is `surface_energy` below 16 kHz,
    `audible_fraction_db` its share of all energy up to `mode_cut_hz`, `sound_exposure_db` what is heard of it (`physics.sound`).
    """
    twin = PlateTwin(board)
    sound = PlateSound(board, model.plate_modes)
    rows = []
    for point in points_m:
        x_m, y_m = map(float, point)
        words = focus(model.drive_order_responses([(x_m, y_m)], dtype=np.float64), [1.0], board.idle_word)
        evaluated = emit(twin, words).focus_metrics(x_m, y_m)
        audible = surface_energy(board, words, board.idle_word)
        inaudible = surface_energy(board, words, board.idle_word, low_hz=16e3, high_hz=mode_cut_hz(board))
        rows.append(
            {
                "amplitude_um": evaluated.amplitude_m * 1e6,
                "contrast": evaluated.contrast,
                "contrast_all": evaluated.contrast_all,
                "spot_mm": evaluated.spot_m * 1e3,
                "spot_wavelengths": evaluated.spot_wavelengths,
                "peak_offset_us": evaluated.peak_offset_s * 1e6,
                "relative_amplitude": evaluated.amplitude_m / twin.reference_amplitude(x_m, y_m),
                "audible_m2_per_s": audible,
                "audible_fraction_db": 10 * float(np.log10(audible / (audible + inaudible))),
                "sound_exposure_db": decibels(sound.exposure_pa2_s(words, board.idle_word)),
            }
        )
    return {key: spread([row[key] for row in rows]) for key in rows[0]}


def four_foci(board: Board, model: ResponseModel, centres_m: Iterable[Floats]) -> Figures:
    """Evaluate four foci at the corners of squares of 0.95 wavelengths: the sign of the sum of their responses.

    Each centre is (2,). Min, median and max of `contrast`, `spot_mm` and `share`: a corner's amplitude relative to a single focus
    there.
    """
    twin = PlateTwin(board)
    share, contrast, spot = [], [], []
    for centre in centres_m:
        corners = centre + SQUARE_M * wave_scale(board) / 2 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        words = focus(model.drive_order_responses(corners, dtype=np.float64), [1.0] * 4, board.idle_word)
        field = emit(twin, words)
        foci = [(float(x), float(y)) for x, y in corners]
        for x_m, y_m in foci:
            evaluated = field.focus_metrics(x_m, y_m, foci)
            share.append(evaluated.amplitude_m / twin.reference_amplitude(x_m, y_m))
            contrast.append(evaluated.contrast)
            spot.append(evaluated.spot_m * 1e3)
    return {"share": spread(share), "contrast": spread(contrast), "spot_mm": spread(spot)}


def float32_against_float64(board: Board, model: ResponseModel, points_m: Iterable[Floats]) -> Figures:
    """Share of bits that differ between responses in float32 and in float64 at (2,) points, and the ratio of the amplitudes."""
    differing, ratio = [], []
    for point in points_m:
        exact = model.drive_order_responses(point, dtype=np.float64)[0]
        words = drive_words(exact, board.idle_word)
        rounded = drive_words(model.drive_order_responses(point, dtype=np.float32)[0], board.idle_word)
        differing.append(float((channel_bits(words) != channel_bits(rounded)).mean()))
        ratio.append(float(np.vdot(2.0 * channel_bits(rounded) - 1, exact) / np.vdot(2.0 * channel_bits(words) - 1, exact)))
    return {"bits_differing": spread(differing), "amplitude_ratio": spread(ratio)}


def spread(values: Sequence[float]) -> dict[str, float]:
    """Return the smallest, median and largest value."""
    return {"min": float(np.min(values)), "median": float(np.median(values)), "max": float(np.max(values))}
