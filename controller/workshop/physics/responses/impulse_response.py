"""Impulse responses h[point, sample, channel]: the responses of the modes summed at many points, as one GEMM.

Points of a grid go by rows (`row_responses`) if the shapes of the modes are products, any others by the sum over all modes.
Sample j is the displacement (j + 1) bit periods after the start of a pulse of one bit period (`modal_response`).
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from controller.arrays import Floats, Reals, blocks
from controller.device.bank.file_format import REST_SAMPLES
from controller.device.bank.provenance import Provenance
from controller.device.board.board import Board
from controller.workshop.physics.modes.modes import Modes, slowest_decay_s
from controller.workshop.physics.modes.plate_modes import in_words, modes_of
from controller.workshop.physics.responses.driver import DriverResponse
from controller.workshop.physics.responses.kept_rest import rest_rows, rest_taps
from controller.workshop.physics.responses.modal_response import band_limited_response, modes_at_once, pulse_response
from controller.workshop.physics.responses.response_source import room
from controller.workshop.physics.responses.row_responses import RowResponses, in_rows
from controller.workshop.physics.responses.step_response import StepResponse, channel_forces

POINTS_PER_GEMM = 16  # 512 columns: large enough for full speed, small enough to stay in the cache


class ResponseModel:
    """Responses of any point of a board's plate, from its modes: a `ResponseSource`.

    Modes above `highest_hz` are left out, `mode_cut_hz` by default; `modes` take the place of those of the board's plate.
    """

    def __init__(self, board: Board, highest_hz: float | None = None, modes: Modes | None = None) -> None:
        self.plate_modes = modes_of(board, highest_hz) if modes is None else modes
        self.step = StepResponse.of(self.plate_modes, DriverResponse.of(board.driver))
        self.forces = channel_forces(board, self.plate_modes)  # (mode, channel): N per V
        self._channels = board.channels
        self.provenance = Provenance("modelled", in_words(board, self.plate_modes))
        waveform = board.waveform
        self.bit_clock_hz = waveform.bit_clock_hz
        self.samples = waveform.samples
        self._bit_period_s = waveform.bit_period_s
        self._band_hz, self._slope = waveform.band_hz, waveform.slope
        self._rest_taps = rest_taps(waveform)
        self._decay_time_s = slowest_decay_s(self.plate_modes)
        self._kernels: dict[tuple[str, str], Reals] = {}
        self._rows: dict[int, RowResponses] = {}  # by id of their kernels, which are kept
        self._workspaces: dict[tuple[str, int], tuple[NDArray[Any], NDArray[Any], NDArray[Any]]] = {}

    def __getstate__(self) -> dict[str, Any]:
        """For another process: without what is kept, which is found again there."""
        kept: dict[str, Any] = {name: {} for name in ("_kernels", "_rows", "_workspaces")}
        return {name: value for name, value in self.__dict__.items() if name not in ("modal", "modal_band")} | kept

    @cached_property
    def modal(self) -> Floats:
        """Response of each mode to a pulse of one bit period, in m per N: (mode, sample)."""
        return self._modal(slice(0, self.modes), band_limited=False)

    @cached_property
    def modal_band(self) -> Floats:
        """The same, band-limited."""
        return np.concatenate([self._modal(some, band_limited=True) for some in self._blocks()])

    def _modal(self, some: slice, *, band_limited: bool) -> Floats:
        """Responses of some modes: (mode, sample)."""
        if not band_limited:
            return pulse_response(self.step.part(some), self._bit_period_s, self.samples)
        return band_limited_response(
            self.step.part(some), self._bit_period_s, self.samples, self._band_hz, self._decay_time_s, self._slope
        )

    def _blocks(self) -> list[slice]:
        """Modes in blocks whose responses are computed at once."""
        at_once = modes_at_once(self.step, self._bit_period_s, self.samples, self._band_hz, self._decay_time_s)
        return list(blocks(self.modes, at_once))

    @property
    def plate_m(self) -> tuple[float, float]:
        """Extent of the plate along x and y."""
        return self.plate_modes.length_m, self.plate_modes.width_m

    @property
    def modes(self) -> int:
        """Number of modes in every response."""
        return self.plate_modes.count

    def responses(
        self,
        points_m: ArrayLike,  # (point, 2): x and y in m
        *,
        band_limited: bool = False,  # the waveform's band only, zero phase
        dtype: DTypeLike = np.float64,
        out: Reals | None = None,  # (point, sample, channel): filled and returned
    ) -> Reals:
        """Responses in the order of time (point, sample, channel), m per V held for one bit period.

        Zero for channels without an actuator. Raises ValueError if `out` has another shape or type.
        """
        return self._responses(points_m, self._kernel(np.dtype(dtype), band_limited=band_limited), out)

    def drive_order_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """Band-limited responses reversed in time: sample n belongs to drive word n, and sum(v * response) is u at T.

        Parameters (`points_m`, `out`, `dtype`), result and errors as in `responses`.
        """
        return self._responses(points_m, self._kernel(np.dtype(dtype), band_limited=True, reverse=True), out)

    def entry_responses(self, points_m: ArrayLike, out: Reals | None = None, dtype: DTypeLike = np.float32) -> Reals:
        """`drive_order_responses`, followed by what they leave out, beside the band and by its slope, in rows (`kept_rest`).

        With the latter the displacement that bits give at a point is known to 1 %, not only in the band; with a slope of -1 to 2 %.

        Parameters (`points_m`, `out`, `dtype`), result and errors as in `responses`, with a further row for each 2 samples; what
        the last row has beyond the last sample is zero.
        """
        return self._responses(points_m, self._entry_kernel(np.dtype(dtype)), out)

    def _entry_kernel(self, kind: np.dtype[Any]) -> Reals:
        """What `entry_responses` multiplies with, (sample and row, mode), computed with the first call."""
        key = ("entry", kind.str)
        if key not in self._kernels:
            rows = -(-self.samples // REST_SAMPLES)
            kernel = np.empty((self.samples + rows, self.modes), kind)
            for some in self._blocks():
                in_band = self._modal(some, band_limited=True)
                outside = (self._modal(some, band_limited=False) - in_band)[:, ::-1]
                kernel[: self.samples, some] = in_band[:, ::-1].T
                kernel[self.samples :, some] = rest_rows(outside, self._rest_taps).T
            self._kernels[key] = kernel
        return self._kernels[key]

    def _kernel(self, dtype: np.dtype[Any], *, band_limited: bool, reverse: bool = False) -> Reals:
        """Modal responses as the (sample, mode) factor of the GEMM; kept."""
        entry = self._kernels.get(("entry", dtype.str))
        if entry is not None and band_limited and reverse:
            return entry[: self.samples]
        key = (f"{band_limited} {reverse}", dtype.str)
        if key not in self._kernels:
            kernel = np.empty((self.samples, self.modes), dtype)
            for some in self._blocks():
                modal = self._modal(some, band_limited=band_limited)
                kernel[:, some] = (modal[:, ::-1] if reverse else modal).T
            self._kernels[key] = kernel
        return self._kernels[key]

    def _responses(self, points_m: ArrayLike, kernel: Reals, out: Reals | None) -> Reals:
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        out = room(out, (len(points), len(kernel), self._channels), kernel.dtype)
        if (factors := self.plate_modes.factors) is not None and in_rows(points) and out.flags.c_contiguous:
            if id(kernel) not in self._rows:
                self._rows[id(kernel)] = RowResponses(factors, self.forces, kernel)
            self._rows[id(kernel)].fill(points, out)
        else:
            self._responses_anywhere(points, kernel, out)
        return out

    def _responses_anywhere(self, points: Floats, kernel: Reals, out: Reals) -> None:
        """Fill `out` with the sum over all modes at each point: one GEMM for 16 points."""
        forces, driven, product = self._workspace(kernel)
        for first in range(0, len(points), POINTS_PER_GEMM):
            some = points[first : first + POINTS_PER_GEMM]
            columns = len(some) * self._channels
            np.multiply(self.plate_modes.shapes(some, kernel.dtype)[:, None, :], forces, out=driven[: len(some)])
            result = product[: len(kernel) * columns].reshape(len(kernel), columns)
            np.matmul(kernel, driven[: len(some)].reshape(columns, -1).T, out=result)
            out[first : first + len(some)] = result.reshape(len(kernel), len(some), self._channels).swapaxes(0, 1)

    def _workspace(self, kernel: Reals) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Forces (channel, mode), modal forces at points (point, channel, mode) and room for a product; kept."""
        key = (kernel.dtype.str, len(kernel))
        if key not in self._workspaces:
            self._workspaces[key] = (
                np.ascontiguousarray(self.forces.T, kernel.dtype),
                np.empty((POINTS_PER_GEMM, self._channels, self.modes), kernel.dtype),
                np.empty(len(kernel) * POINTS_PER_GEMM * self._channels, kernel.dtype),
            )
        return self._workspaces[key]
