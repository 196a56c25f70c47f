"""Impulse responses learned at the measured points of a plate: what deconvolution gives and interpolation takes."""

from dataclasses import dataclass

from controller.arrays import Bools, Floats, Reals
from controller.workshop.physics.responses.response_source import Provenance


@dataclass(frozen=True, eq=False)
class LearnedResponses:
    """Responses at measured points."""

    points_m: Floats  # (point, 2): in the plate's coordinates
    # (point, sample, 32): in m per V held for one bit period; sample j is the displacement (j + 1) bit periods after the start
    # of the pulse. Zero where not `known`. May be longer than an emission, for sharper spectra
    responses: Reals
    known: Bools  # (point, 32): what was measured well enough to use
    # (point, 32): mean coherence between drive and record in the waveform's band, 0 to 1; NaN where it was not measured
    coherence: Floats
    noise: Floats  # (point, 32): standard deviation of a sample's error, in m per V; NaN where it cannot be determined
    bit_clock_hz: float  # rate of the samples
    provenance: Provenance
