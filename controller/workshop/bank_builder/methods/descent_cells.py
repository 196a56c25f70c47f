"""Points that `descent` optimises together: what their plain waveforms do, what each goal is worth, and edges of their bits."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from controller.arrays import Floats
from controller.workshop.bank_builder.methods.exact import rounded


@dataclass(eq=False)
class Cells:
    """Points that are optimised together; every array has them along its axis `cell`."""

    plain: Floats  # (sample, cell, 32): bits of the plain waveform
    shapes: Floats  # (cell, mode)
    places: list[Any]
    worth: Floats  # (cell,): of the amplitude; changes during the relaxation
    # amplitude, field, sound, edge: (cell,): worth 1 of amplitude, in the unit of `FieldForm`; cost of a unit of the mean
    # square field, of audible energy, of an edge
    amplitude: Floats
    field: Floats
    sound: Floats
    edge: Floats
    pull: Floats | None = None  # (sample, cell, 32): of the felt amplitude by levels, which then takes the place of `shapes`

    def least_edge_cost(self, idle: Floats) -> Floats:
        """Where edges cost nothing by the aim, a hundredth of what the amplitude is worth for all of them."""
        found: Floats = self.worth / 100 / np.maximum(edges(self.plain, idle).sum(axis=1), 1)
        return found


def edges(bits: Floats, idle: Floats) -> Floats:
    """Edges of each channel with those from and to the idle word, (cell, 32), of (sample, cell, 32) bits."""
    found: Floats = own_edges(bits) + np.abs(bits[0] - idle) + np.abs(bits[-1] - idle)
    return found


def own_edges(bits: Floats) -> Floats:
    """Edges of each channel within an emission, (cell, 32), of (sample, cell, 32) bits."""
    found: Floats = np.abs(np.diff(bits, axis=0)).sum(axis=0)
    return found


def amplitudes(shapes: Floats, modal: Floats) -> Floats:
    """Displacement at each cell, (cell,): the sum of its shapes times the modes' displacements, (cell, mode) both."""
    found: Floats = np.sum(shapes * rounded(modal, 28, 1), axis=1)
    return found
