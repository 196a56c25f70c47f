"""The modes of a board's plate: the one place where they are built."""

import math
from functools import lru_cache

import msgspec
import numpy as np

from controller.device.board.board import Board
from controller.device.board.plate.patches import Patch, Patches
from controller.device.board.plate.plate import Plate
from controller.device.board.relations.bending_waves import MindlinPlate
from controller.errors import ConfigError
from controller.workshop.physics.damping import damped
from controller.workshop.physics.modes.closed_form import SimplySupported
from controller.workshop.physics.modes.modes import Modes
from controller.workshop.physics.modes.retuned import retuned
from controller.workshop.physics.modes.ritz_modes import RitzModes
from controller.workshop.physics.patches import BASIS, CombinedModes, with_patches
from controller.workshop.physics.plate import mode_cut_hz

KEPT = 4  # plates whose modes are remembered


def modes_of(board: Board, highest_hz: float | None = None) -> Modes:
    """Modes of a board's plate, kept for the next call.

    Modes above `highest_hz` are left out; `mode_cut_hz` by default. Raises ConfigError if there is none, or more than can be
    computed with.
    """
    places = () if board.patches is None else board.patches.on(board.plate, board.actuators)
    return _modes(board.plate, board.patches, places, mode_cut_hz(board) if highest_hz is None else highest_hz)


@lru_cache(maxsize=KEPT)
def _modes(plate: Plate, patches: Patches | None, places: tuple[Patch, ...], highest_hz: float) -> Modes:
    """Modes from all that they depend on, which must be hashable records: edges, theory, patches, damping."""
    if patches is None:
        return damped(_bare(plate, highest_hz), plate)
    return damped(with_patches(_bare(plate, BASIS * highest_hz), plate, patches, places, highest_hz), plate)


def _bare(plate: Plate, highest_hz: float) -> Modes:
    """Modes without patches."""
    if plate.theory == "kirchhoff":
        return _of_edges(plate, highest_hz)
    theory = MindlinPlate.of(plate)
    without_hz = theory.without_correction_hz(highest_hz)
    try:
        return _corrected(theory, _of_edges(plate, without_hz))
    except ConfigError as error:
        raise ConfigError(f"{error} ({without_hz:g} Hz by Kirchhoff's theory are {highest_hz:g} Hz by Mindlin's)") from error


def _corrected(theory: MindlinPlate, modes: Modes) -> Modes:
    """Modes by Mindlin's theory: each of Kirchhoff's keeps its shape and its wavenumber, and gets a free wave's frequency.

    This is exact for simply supported edges; with two clamped or free ones, trial runs found it within 0.07 %.
    """
    wavenumber = np.sqrt(modes.angular_frequency / theory.kirchhoff)
    return retuned(modes, angular_frequency=theory.angular_frequency(wavenumber))


def _of_edges(plate: Plate, highest_hz: float) -> Modes:
    """Modes by Kirchhoff's theory."""
    if set(msgspec.structs.astuple(plate.sides)) == {"simply_supported"}:
        return SimplySupported.of(plate, highest_hz)
    return RitzModes.of(plate, highest_hz)


def in_words(board: Board, modes: Modes) -> str:
    """The plate model that `modes` of a board come from, for the header of a bank."""
    plate = board.plate
    sides = plate.sides
    supports = (sides.x0, sides.x1, sides.y0, sides.y1)
    each = supports[:1] if len(set(supports)) == 1 else supports
    edges = " / ".join(support.replace("_", " ") for support in each)
    if plate.foam is not None and "foam" in supports:
        edges += f" ({plate.foam.stiffness_n_m3:.3g} N/m³, {plate.foam.width_mm:g} mm)"
    highest_hz = float(modes.angular_frequency[-1]) / (2 * math.pi)
    shortest_ms, longest_ms = 1e3 / float(modes.decay_rate.max()), 1e3 / float(modes.decay_rate.min())
    decay = f"{shortest_ms:.3g}" if math.isclose(shortest_ms, longest_ms) else f"{shortest_ms:.3g} to {longest_ms:.3g}"
    layers = f" of {len(plate.layers)} layers" if plate.layers else ""
    patches = ""
    if board.patches is not None and isinstance(modes, CombinedModes):
        shift, alone = (100 * part for part in modes.shift(board.waveform.band_low_hz, board.waveform.band_high_hz))
        count = len(board.patches.on(plate, board.actuators))
        patches = f", {count} patches ({shift:+.2f} % in frequency, {alone:+.2f} % to first order)"
    return (
        f"{plate.theory.capitalize()} plate{layers}, edges {edges}{patches}, decay {decay} ms,"
        f" {modes.count} modes to {highest_hz * 1e-3:.1f} kHz"
    )
