"""The paper's panel on the plate model with seeded foci: responses, words and fields that several figures need, computed once."""

from functools import cached_property

import msgspec
import numpy as np
from numpy.typing import ArrayLike

from controller.arrays import Floats, Words
from controller.device.board.board import Board
from controller.errors import ConfigError
from controller.workshop.benchmark.focus.focus_emission import FocusEmission
from controller.workshop.benchmark.focus.focus_figures import emit, random_points
from controller.workshop.physics.field import Field
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.modal_response import band_limited_response
from controller.workshop.physics.responses.step_response import StepResponse
from controller.workshop.physics.word_capture import volts_above_idle

MARGIN_M = 20e-3  # of the foci from the edges, where their mirror images weaken them
DIRECTIONS = 8


class PaperPanel:
    """A board's plate with the paper's own drive words, and `count` foci on it; `random` is for what else is drawn.

    Raises ConfigError if the plate is too small for foci `MARGIN_M` from its edges.
    """

    def __init__(self, board: Board, seed: int, count: int) -> None:
        if min(board.plate.length_m, board.plate.width_m) <= 2 * MARGIN_M:
            size = f"{board.plate.length_mm:g} × {board.plate.width_mm:g} mm"
            raise ConfigError(
                f"board {board.name!r}: a plate of {size} has no point {MARGIN_M * 1e3:g} mm from its edges: too small"
            )
        waveform = msgspec.structs.replace(board.waveform, slope=0.0, drift_percent=0.0)
        self.board = board = msgspec.structs.replace(board, waveform=waveform, finger=None)
        self.seed = seed
        self.points_m = random_points(board, seed, count, MARGIN_M)  # (point, 2)
        self.twin = PlateTwin(board)

    @property
    def modes(self) -> Modes:
        """Modes of the plate."""
        return self.twin.modes

    @property
    def half_supply_v(self) -> float:
        """What a bit is above or below the middle."""
        return self.board.driver.supply_v / 2

    @cached_property
    def in_band(self) -> Floats:
        """Band-limited responses at the foci in drive order, m per V: (point, sample, 32)."""
        return np.asarray(self.twin.responses.drive_order_responses(self.points_m, dtype=np.float64), np.float64)

    @cached_property
    def words(self) -> list[Words]:
        """Drive words of each focus alone."""
        return [focus(response[None], [1.0], self.board.idle_word) for response in self.in_band]

    @cached_property
    def fields(self) -> list[Field]:
        """The plate at T of each focus."""
        return [emit(self.twin, words) for words in self.words]

    @cached_property
    def emissions(self) -> list[FocusEmission]:
        """The same with all that was played."""
        foci = zip(self.words, self.fields, self.points_m.tolist(), strict=True)
        return [FocusEmission(self.twin, words, field, [(x_m, y_m)]) for words, field, (x_m, y_m) in foci]

    @cached_property
    def amplitudes_m(self) -> Floats:
        """Displacement at each focus at T: (point,)."""
        return np.array([field.at(point)[0] for field, point in zip(self.fields, self.points_m, strict=True)])

    def volts(self, words: Words, after: int = 0, parts: int = 1) -> Floats:
        """Levels of the stages above their idle levels, (bit, 32), and `after` more bits at rest; each bit `parts` times."""
        played = volts_above_idle(self.board, words)
        return np.repeat(np.concatenate([played, np.zeros((after, played.shape[1]))]), parts, axis=0)

    def band_responses(self, points_m: ArrayLike, bit_period_s: float, samples: int, step: StepResponse | None = None) -> Floats:
        """Band-limited responses at any bit clock in the order of time, m per V: (point, sample, 32).

        `points_m` are (point, 2); `samples` may be more than those of the board's emission; `step` is of another driver, or of the
        same modes drifted, the board's by default.
        """
        waveform = self.board.waveform
        band_hz = waveform.band_low_hz, waveform.band_high_hz
        step = self.twin.step if step is None else step
        modal = band_limited_response(step, bit_period_s, samples, band_hz, float(1 / self.modes.decay_rate.min()))
        shapes = self.modes.shapes(points_m)
        return np.stack([modal.T @ (shape[:, None] * self.twin.forces) for shape in np.asarray(shapes, np.float64)])

    def ring(self, point_m: Floats, radius_m: float) -> Floats:
        """Places at a distance from a point, in all directions: (direction, 2)."""
        angle = np.arange(DIRECTIONS) * (2 * np.pi / DIRECTIONS)
        return point_m + radius_m * np.column_stack([np.cos(angle), np.sin(angle)])


def kept(estimated: Floats, true: Floats) -> float:
    """Share of the amplitude that bits from `estimated` responses, (sample, 32), give where `true` ones hold."""
    return float(np.vdot(np.sign(estimated), true) / np.abs(true).sum())
