"""The bank of one measured plate: read, check, interpolate, build; nothing is written if anything is refused."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from threadpoolctl import threadpool_limits

from controller.arrays import Bools
from controller.device.board.board import Board, of_one_fpga
from controller.device.scene.scene import load_scene
from controller.device.scene.scene_file import find_scene
from controller.errors import CalibrationError, ConfigError
from controller.workshop.bank_builder.build import BuildReport
from controller.workshop.bank_builder.compact.design import compact_pitch_m
from controller.workshop.bank_builder.interpolation_error import interpolation_warning, refuse_coarse
from controller.workshop.bank_builder.methods.aims import DescentAim
from controller.workshop.bank_builder.own_bank import SMALLEST_PITCH_MM, Order, chosen, pitch_of
from controller.workshop.bank_builder.plan import refuse_aim
from controller.workshop.calibration.banks.bank_figures import plate_figures, plate_notes
from controller.workshop.calibration.fits.decay_fit import Decay, fit_decays
from controller.workshop.calibration.fits.drift_fit import fit_drift
from controller.workshop.calibration.fits.stage_fit import stage_notes
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.interpolation.interpolated import InterpolatedResponses
from controller.workshop.calibration.interpolation.wave_fit import WaveFit
from controller.workshop.calibration.interpolation.whole_field import whole_field
from controller.workshop.calibration.learning.learning import Learned, learn
from controller.workshop.calibration.transfer_functions.point_cache import calibration_cache
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.workers.workers import ALONE, Workers

SAID_AMPLITUDE = 0.97  # of optimised entries over plain ones: less is said

Progress = Callable[[str, int, int], None]  # what is done, how much of it, and all of it


def _silent(_what: str, _done: int, _total: int) -> None:
    pass


@dataclass(frozen=True)
class PlateBank:
    """The bank that is wanted of a measured plate."""

    board: Board
    folder: Path  # with a measurement.toml
    out: Path | None = None  # None: where `run` looks for it
    pitch_mm: float | None = None  # None: the board's
    compact: bool = False  # else as `compose.method` says
    memory_mb: float | None = None  # that its build may take
    model: bool = False  # let the board's plate model fill gaps between scattered points
    also: Path | None = None  # the same plate at another temperature
    accept: tuple[str, ...] = ()  # kinds of what is wrong, and is accepted
    aim: DescentAim | None = None  # optimise every entry for this

    def __post_init__(self) -> None:
        if not pitch_of(self.board, self.pitch_mm) >= SMALLEST_PITCH_MM:  # NaN too
            raise ConfigError(f"--pitch-mm: pitch_mm = {self.pitch_mm:g} is not {SMALLEST_PITCH_MM:g} or more")
        if self.pitch_mm is not None:
            refuse_coarse(self.board, self.pitch_mm * 1e-3)
        if self.aim is not None:
            of_one_fpga(self.board)
            refuse_aim(self.board, self.aim, measured=True, compact=self.compact)


@dataclass(frozen=True)
class FittedPlate:
    """What its measurements say of a plate."""

    found: Learned
    source: InterpolatedResponses
    waves: WaveFit
    decays: list[Decay]
    figures: dict[str, Any]
    notes: list[str]


@dataclass(frozen=True)
class BuiltBank:
    """A bank that was written, and all that there is to say of it."""

    path: Path
    report: BuildReport
    notes: list[str]


def fit(wanted: PlateBank, progress: Progress = _silent) -> FittedPlate:
    """Read, check and interpolate; raises CalibrationError if anything is refused."""
    board = wanted.board
    with threadpool_limits(1, "blas"):  # many small matrices
        found, dead = _learned(wanted, wanted.folder, progress)
        learned = found.responses
        drift = fit_drift(board, learned, _learned(wanted, wanted.also, progress)[0].responses) if wanted.also else None
        source, waves = interpolate(board, learned, progress, dead, modes_of if wanted.model else None)
        decays = fit_decays(learned.responses, learned.known, learned.noise, board.waveform, learned.bit_clock_hz)
    if source.size is not None and found.frame is not None:
        source.size = source.size.in_frame(found.frame.offset_error_m)
    notes = [finding.message for finding in found.findings]
    notes += [*stage_notes(board, learned), *plate_notes(board, learned, waves, decays, drift)]
    figures = plate_figures(board, learned, source, waves, decays, drift)
    figures |= {"frame": found.frame and found.frame.in_words(), "sensor_mass": found.chain and found.chain.in_words()}
    return FittedPlate(found, source, waves, decays, figures, notes)


def build(wanted: PlateBank, fitted: FittedPlate, workers: Workers = ALONE, *, progress: bool = True) -> BuiltBank:
    """Build and write the bank of a plate; `workers` compute it.

    Raises CalibrationError if no cell is near enough to measured points, or they do not foresee the field by which entries would be
    optimised; WorkersError.
    """
    board, source = wanted.board, fitted.source
    pitch_mm, choice, compact = pitch_of(board, wanted.pitch_mm), None, wanted.compact
    notes = []
    if compact and wanted.pitch_mm is None:
        pitch_mm = 1e3 * compact_pitch_m(board)
    refuse_coarse(board, pitch_mm * 1e-3)
    if board.compose.method != "bank" and not compact and wanted.pitch_mm is None:
        scene_file = find_scene(board)
        choice = chosen(board, load_scene(scene_file, board), scene_file, source)
        pitch_mm, compact = choice["pitch_mm"], choice["compact"]
        notes.append(f"{scene_file.name}: {choice['why']}")
    order = Order(board, pitch_mm * 1e-3, choice=choice, compact=compact)
    cells = source.near_enough(order.grid.points())
    if not cells.any():
        raise CalibrationError(f"{wanted.folder}: no cell of the bank lies near the measured points")
    path = wanted.out or order.own_path
    with threadpool_limits(1, "blas"):
        how = {"aim": wanted.aim, "plate": whole_field(board, source)} if wanted.aim else {}
        how |= {"workers": workers, "memory_mb": wanted.memory_mb, "progress": progress}
        report = order.build(path, cells, source=source, **how)
    return BuiltBank(path, report, [*fitted.notes, *notes, *_notes(wanted, fitted, cells, report)])


def _learned(wanted: PlateBank, folder: Path, progress: Progress) -> tuple[Learned, list[int]]:
    """What a measurement folder gives, and channels accepted as dead; raises CalibrationError if anything is refused."""
    cache = calibration_cache(wanted.board, folder)
    found = learn(folder, wanted.board, cache=cache, progress=lambda *done: progress(f"points of {folder.name}", *done))
    found.require(wanted.accept)
    return found, [channel for finding in found.findings if finding.kind == "dead" for channel in finding.channels]


def _notes(wanted: PlateBank, fitted: FittedPlate, cells: Bools, built: BuildReport) -> list[str]:
    """What of the bank is less than was asked for."""
    notes, source = [], fitted.source
    if source.size is not None:
        notes.append(
            f"the glass is {source.size.in_words()} than board.toml says, if its edges are as that says: measure it, and set"
            " length_mm and width_mm in [plate]; a measured bank has it as it is"
        )
    elif wanted.model and source.provenance.kind == "measured":
        notes.append(
            "the board's model foresees points left out no better than waves do, and was not used: its edges are not the plate's"
        )
    if not cells.all():
        notes.append(f"{int((~cells).sum()):,} of {cells.size:,} cells are too far from the measured points, and not in the bank")
    if built.optimised and (share := built.optimised["amplitude_of_plain"]["median"]) < SAID_AMPLITUDE:
        notes.append(f"optimised entries have {share:g} of the amplitude of plain ones, as far as it was measured")
    if warning := interpolation_warning(built.interpolation_error):
        notes.append(warning)
    return notes
