"""Records to spectra and back: interpolation works frequency by frequency.

Records need not be longer than an emission, though longer ones have sharper spectra. Each is followed by silence, into which falls
what the transform would else wrap round, and by which bins are nearer to each other.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft

from controller.arrays import Floats, Indices, Reals
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.board.panel import Waveform
from controller.workshop.calibration.cores import cores
from controller.workshop.calibration.records.drives import transform
from controller.workshop.physics.responses.kept_rest import rest_rows, rest_taps
from controller.workshop.physics.responses.modal_response import band_gain, edge_width_hz

Spectra = NDArray[np.complex64]

SILENCE = 0.25  # of an emission


@dataclass(frozen=True, eq=False)
class Bins:
    """Frequencies from 0 to where the band's filter ends."""

    length: int  # samples of a transform
    samples: int  # of an emission
    frequency_hz: Floats  # (bin,)
    gain: Floats  # (bin,): of the band's filter
    rest_taps: Floats  # of what it leaves out (`kept_rest`)

    @classmethod
    def of(cls, waveform: Waveform, record_samples: int) -> Self:
        """For records of this many samples at a waveform's bit clock."""
        length = int(next_fast_len(record_samples + int(np.ceil(SILENCE * waveform.samples)), real=True))
        band_hz = waveform.band_hz
        frequency_hz = np.arange(length // 2 + 1, dtype=np.float64) * (waveform.bit_clock_hz / length)
        frequency_hz = frequency_hz[frequency_hz < waveform.band_high_hz + edge_width_hz(band_hz) / 2]
        gain = band_gain(frequency_hz, band_hz, waveform.slope)
        return cls(length, waveform.samples, frequency_hz, gain, rest_taps(waveform))

    @property
    def in_band(self) -> Indices:
        """Bins that the filter passes at all."""
        return np.flatnonzero(self.gain)

    @property
    def rest_rows(self) -> int:
        """Rows of rest that follow an entry's samples."""
        return -(-self.samples // REST_SAMPLES)

    def part(self, chosen: Indices) -> Self:
        """Some of the bins."""
        return replace(self, frequency_hz=self.frequency_hz[chosen], gain=self.gain[chosen])

    def of_records(
        self,
        responses: Reals,
        points: Indices,
        higher: Floats | None = None,  # of each point: by which all frequencies of the plate were higher; corrected
    ) -> Spectra:
        """Spectra of the records, (point, sample, channel), of some points, by bins: (bin, point, channel)."""
        spectra = np.empty((self.frequency_hz.size, len(points), responses.shape[2]), np.complex64)
        for index, point in enumerate(points.tolist()):
            if higher is None or higher[index] == 0:
                spectra[:, index] = rfft(responses[point], self.length, axis=0)[: self.frequency_hz.size]
                continue
            step, turn = (
                (1 + higher[index]) / self.length,
                np.exp(-2j * np.pi * higher[index] * np.arange(self.frequency_hz.size) / self.length),
            )
            spectra[:, index] = (transform(responses[point].T, 1.0, 0.0, step, self.frequency_hz.size) * turn).T
        return spectra

    def band_limited(self, spectra: Spectra) -> NDArray[np.float32]:
        """Responses of an emission's samples, in the band only, zero phase: (bin, point, channel) to (point, sample, channel)."""
        return self.whole(spectra * self.gain[:, None, None].astype(np.float32))

    def whole(self, spectra: Spectra) -> NDArray[np.float32]:
        """The same with all that lies below the band."""
        return irfft(spectra, self.length, axis=0, workers=cores())[: self.samples].swapaxes(0, 1)

    def rest(self, spectra: Spectra) -> NDArray[np.float32]:
        """What the band leaves out, reversed in time, in rows as a bank keeps it (`kept_rest`): (point, row, channel)."""
        outside = self.whole(spectra * (1 - self.gain[:, None, None]).astype(np.float32))
        return rest_rows(outside[:, ::-1], self.rest_taps)
