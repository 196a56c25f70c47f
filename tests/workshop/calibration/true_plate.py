"""Plates whose true responses are known everywhere, and measurements of them: what interpolation is evaluated by."""

import msgspec
import numpy as np

from controller.device.bank.provenance import Provenance
from controller.workshop.calibration.interpolation.spectra import Bins
from controller.workshop.calibration.learned import LearnedResponses
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.responses.impulse_response import ResponseModel

NOISE = 0.01  # rms of each record's: 40 dB


class TruePlate:
    """The plate of a board, in another state than its own if `plate` says so, with records of any length."""

    def __init__(self, board, record_ms, **plate):
        self.board = board
        there = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, **plate))
        self.model = ResponseModel(there, modes=modes_of(there))
        self.samples = round(record_ms * 1e-3 * board.waveform.bit_clock_hz)
        self.recorder = ResponseModel(there, modes=self.model.plate_modes)
        self.recorder.samples = self.samples  # longer than an emission may be

    def learned(self, points_m, noise=NOISE, missing=0.0, seed=1):
        """Measured at points, with noise, and without a share of the records."""
        random = np.random.default_rng(seed)
        records = self.recorder.responses(points_m, dtype=np.float32)
        used = [a.channel for a in self.board.actuators]
        rms = np.zeros((len(points_m), records.shape[2]))
        rms[:, used] = noise * records[:, :, used].std(axis=(1, 2), keepdims=True)[:, 0]
        records += random.standard_normal(records.shape, np.float32) * rms[:, None].astype(np.float32)
        known = np.zeros(rms.shape, bool)
        known[:, used] = random.random((len(points_m), 1)) >= missing
        records *= known[:, None]
        clock_hz, made = self.board.waveform.bit_clock_hz, Provenance("measured", "")
        return LearnedResponses(np.asarray(points_m), records, known, np.where(known, 1.0, 0.0), rms, clock_hz, made)

    def kept(self, source, points_m):
        """Share of the amplitude at points that one bit a sample from a source keeps on this plate."""
        true = self.model.responses(points_m, band_limited=True)
        signs = np.sign(source.responses(points_m, band_limited=True))
        return (signs * true).sum(axis=(1, 2)) / np.abs(true).sum(axis=(1, 2))

    def bins(self):
        return Bins.of(self.board.waveform, self.samples)


def random_places(board, count, near_m, far_m=np.inf, seed=7):
    """Random points of a plate, at such distances from its edges."""
    random = np.random.default_rng(seed)
    places = random.uniform(0, 1, (200 * count, 2)) * (board.plate.length_m, board.plate.width_m)
    from_edge = np.minimum(places, (board.plate.length_m, board.plate.width_m) - places).min(axis=1)
    return places[(from_edge >= near_m) & (from_edge <= far_m)][:count]
