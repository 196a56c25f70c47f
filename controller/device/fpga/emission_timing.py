"""Bit period in use and the lengths that follow from it, in FPGA clocks."""

from __future__ import annotations

from controller.device.board.board import Board


class EmissionTiming:
    """Lengths of emissions and of their periods at the bit period in use."""

    def __init__(self, board: Board) -> None:
        # Time for which one drive word is held, in 65536ths of an FPGA clock; the board's at first
        self.bit_period = board.bit_period
        self._board = board
        self._period_s, self._period_of, self._period = 0.0, 0, 0  # the last period asked for, its bit period, its clocks

    def scaled_bit_period(self, scale: float) -> int:
        """Bit period of `scale` times the board's bit clock, in 65536ths of an FPGA clock."""
        return round(self._board.bit_period / scale)

    @property
    def emission_ticks(self) -> int:
        """FPGA clocks from the first word of an emission to the end of its last."""
        return self._board.waveform.samples * self.bit_period >> 16

    def period_ticks(self, period_s: float) -> int:
        """FPGA clocks from emission to emission.

        A period as long as an emission at the board's bit clock means without a pause, also at any other bit clock.
        """
        if period_s != self._period_s or self._period_of != self.bit_period:
            self._period_s, self._period_of, self._period = period_s, self.bit_period, self._rounded(period_s)
        return self._period

    def actual_period_s(self, period_s: float) -> float:
        """Period in s that the FPGA plays when `period_s` is asked for: whole clocks."""
        return self.period_ticks(period_s) / self._board.link.clock_hz

    def _rounded(self, period_s: float) -> int:
        ticks = self._board.period_ticks(period_s)
        shortest = self.emission_ticks
        if ticks == self._board.emission_ticks or abs(ticks - shortest) <= 1:
            return shortest
        return ticks
