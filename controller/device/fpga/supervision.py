"""The FPGA's outputs as the host controls them: bring-up, arming, heartbeats, disarming.

A message that was damaged is sent again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Final

from controller.device.board.board import Board
from controller.device.fpga import configuration, frames
from controller.device.fpga.bitstreams.loader import BitstreamLoader
from controller.device.fpga.emission_timing import EmissionTiming
from controller.device.fpga.exchange import DAMAGED, Exchange, FpgaReset, Refused
from controller.device.fpga.links.link import Link
from controller.device.fpga.registers import Control, Register, Result, State
from controller.device.fpga.status import Status
from controller.errors import ControllerError, FaultError, LinkError

HEARTBEATS_PER_TIMEOUT: Final = 3
CLOCK_TOLERANCE: Final = 0.005  # more than crystals and a slewed host clock can differ
FRESH_S: Final = 0.25  # after a heartbeat the settings are taken to be those of `bring_up` for so long


class StillOn(LinkError):
    """A status says that the outputs are on where they should be off: nothing is armed until one says that they are off."""


class Supervision:
    """Supervises one FPGA, from the check of its identity until its outputs are off.

    `build_hash` is that of the gateware that this host was made for. Without `bring_up` at once, call `bring_up` before anything
    else. Raises LinkError if the FPGA does not answer, or is not the one that board and gateware call for.
    """

    def __init__(self, link: Link, board: Board, build_hash: int, now_s: Callable[[], float], *, bring_up: bool = True) -> None:
        # Messages over the link, for reading and writing registers
        self.exchange = Exchange(link, now_s, board.limits.heartbeat_timeout_ms * 1e-3 / HEARTBEATS_PER_TIMEOUT)
        self._sent = self.exchange.sent
        self.link = link  # as given
        self._board = board
        self._build_hash = build_hash
        self._now_s = now_s
        # An ARM was sent since a status last said that the high voltage is off, or that a fault has switched it off
        self.may_be_on = False
        self._armed = False  # the FPGA accepted ARM, and no DISARM was sent since
        self._heartbeat_s = math.inf  # end of the last heartbeat
        self._heartbeat_ticks = 0  # FPGA time in its status
        self.timing = EmissionTiming(board)  # lengths of emissions and periods at the bit period in use
        self.ramp_end_s = -math.inf  # when the last ramp up or down ends, on the loop's clock
        self.loader: BitstreamLoader | None = None  # loads an FPGA that has another gateware; None: it is refused
        if bring_up:
            self.bring_up()

    def bring_up(self) -> None:
        """Clear faults, check the FPGA's identity and that its outputs are off, and write and read back all settings.

        Called at the start, and again whenever the FPGA may have been reset; its slots may be empty then. `arm` comes next.

        Raises IncompatibleFpga if its identity, gateware or limits are others and cannot be loaded, or it refuses a setting. Raises
        StillOn if it is armed. If this host armed it, a DISARM was sent: call again after its ramp. Raises LinkError if it does not
        answer, or is being loaded.
        """
        self._armed = False
        self._heartbeat_s = math.inf  # its clock may have restarted
        if self.loader is not None:
            self.loader.require_done()
        try:
            self.exchange.control(Control.CLEAR, raise_faults=False)  # with a fault every read would raise
            configuration.verify(self.exchange.read, self._board, self._build_hash)
        except LinkError as error:  # another gateware, or silence
            if self.loader is None:
                raise
            self.loader.begin(error)
        if self.loader is not None:
            self.loader.good()
        if State.HV_ENABLE in self.heartbeat().state:
            if self.may_be_on:
                self.exchange.control(Control.DISARM)
                raise StillOn("the FPGA was still armed and is commanded to disarm: try again when its ramp has passed")
            raise StillOn("the FPGA is armed already: another host drives it, or one has died; wait for its heartbeat timeout")
        configuration.write_settings(self.exchange, self._board, self.bit_period)

    @property
    def of_each(self) -> tuple[Supervision, ...]:
        """What supervises each FPGA."""
        return (self,)

    @property
    def exchanges(self) -> tuple[Exchange, ...]:
        """The exchange with each FPGA."""
        return tuple([one.exchange for one in self.of_each])

    @property
    def on_anywhere(self) -> bool:
        """As `may_be_on`; of several FPGAs, whether it is so of any."""
        return self.may_be_on

    @property
    def fresh(self) -> bool:
        """Whether a heartbeat succeeded within FRESH_S, so that the settings are still those of `bring_up`."""
        return self._heartbeat_s < math.inf and self._now_s() - self._heartbeat_s < FRESH_S

    @property
    def bit_period(self) -> int:
        """Time for which one drive word is held, in 65536ths of an FPGA clock."""
        return self.timing.bit_period

    @property
    def heartbeat_due_s(self) -> float:
        """When the next heartbeat is due, on the loop's clock."""
        return min([one.heartbeat_due_s for one in self.exchanges])

    @property
    def quiet_since_s(self) -> float:
        """No FPGA has received a frame after this time, on the loop's clock."""
        return max([one.heartbeat_due_s for one in self.exchanges])

    def cause_of(self, error: ControllerError) -> ControllerError:
        """What is behind an error that this session has raised; of several FPGAs another may have the cause."""
        return error

    def wire_free_s(self) -> float:
        """When everything sent so far has left the wire, on the loop's clock."""
        return self.link.wire_free_s()

    def earliest_trigger_s(self) -> float:
        """Earliest time at which a trigger requested now would rise, on the loop's clock."""
        now_s, free_s = self._now_s(), self.link.wire_free_s()
        return now_s if now_s > free_s else free_s

    def arm(self) -> float:
        """Arm the outputs: the high voltage settles, then all channels ramp to their idle levels.

        Returns when the ramp ends, on the loop's clock. Raises Refused if the FPGA refuses, for example without its run permit;
        FpgaReset if it was reset since the last heartbeat or bring-up: it would arm with other limits than the board's; LinkError
        if every attempt was damaged.
        """
        fresh = self.fresh
        self.heartbeat()
        if not fresh:  # a second reset soon after the first could have been missed
            self.bring_up()

        sent = False

        def send() -> Status:
            nonlocal sent
            if sent:  # perhaps the ARM arrived and only its answer was damaged
                status = self.exchange.send_short(frames.pack_nop(self._sent, 0, self.exchange.sequence))
                if State.HV_ENABLE in status.state:
                    return status
            sent = True
            sequence = self.exchange.sequence
            end = frames.pack_nop(self._sent, 0, sequence)  # a heartbeat, without which arming is refused
            end = frames.pack_unlock(self._sent, end, sequence + 1, self._build_hash)
            end = frames.pack_control(self._sent, end, sequence + 2, Control.ARM)
            return self.exchange.send_short(frames.pack_nop(self._sent, end, sequence + 3))

        self.may_be_on = True
        self.exchange.retry(send)
        self._armed = True
        self.ramp_end_s = self._after_s(configuration.arming_ticks(self._board, self.bit_period))
        return self.ramp_end_s

    def set_bit_period(self, scale: float) -> bool:
        """Scale the bit clock, for example for the plate's temperature; kept over `bring_up`.

        A `scale` above 1 plays faster than the board's bit clock. Returns False if something plays or is queued: try again later.
        Raises Refused if the FPGA does not allow this rate.
        """
        period = self.timing.scaled_bit_period(scale)
        if period == self.bit_period:
            return True
        try:
            self.exchange.retry(lambda: self.exchange.ask(frames.pack_write, Register.BIT_PERIOD, period))
        except Refused as refusal:
            if refusal.result is Result.BUSY:
                return False
            raise
        self.timing.bit_period = period
        return True

    def require_armed(self) -> None:
        """Check with a heartbeat that the FPGA is armed; raises LinkError if it is not, with the state it reports."""
        state = self.heartbeat().state
        if State.ARMED not in state:
            names = ", ".join(flag.name.lower().replace("_", " ") for flag in State if flag in state and flag.name)
            raise LinkError(f"the FPGA did not arm: its state is {names or 'idle'}")

    def disarm(self) -> float:
        """Ramp all outputs to 0 V. They are off when a heartbeat has said so (`may_be_on`).

        Returns when the ramp ends, on the loop's clock. Raises LinkError if every attempt was damaged.
        """
        self._armed = False
        self.exchange.control(Control.DISARM)
        self.ramp_end_s = self._after_s(configuration.ramp_ticks(self._board, self.bit_period))
        return self.ramp_end_s

    def off(self) -> None:
        """Try to disarm, whatever the state of the link; without heartbeats the FPGA switches off by itself."""
        self._armed = False
        if self.may_be_on:
            try:
                status = self.exchange.control(Control.DISARM)
            except FaultError:
                self.may_be_on = False
            except LinkError:
                return
            else:
                self.may_be_on = State.HV_ENABLE in status.state

    def heartbeat(self) -> Status:
        """Send a heartbeat; returns the FPGA's status.

        Raises HostSilent or FaultError if the FPGA has switched off; FpgaReset if it was reset: its outputs are off without a
        fault, or its clock has not advanced as the host's has; LinkError if every attempt was damaged.
        """
        before_s = self._now_s()
        try:
            status = self._nop()
            if status.result in DAMAGED:  # the heartbeat before; what became of this one is not known yet
                status = self._nop()
        except FaultError:
            self.may_be_on = False
            raise
        self.may_be_on = self.may_be_on and State.HV_ENABLE in status.state
        after_s = max(self._now_s(), self.link.wire_free_s())
        least_ticks = (before_s - self._heartbeat_s) * self._board.link.clock_hz * (1 - CLOCK_TOLERANCE)
        if (self._armed and State.HV_ENABLE not in status.state) or status.timestamp_ticks - self._heartbeat_ticks < least_ticks:
            raise FpgaReset
        self._heartbeat_s, self._heartbeat_ticks = after_s, status.timestamp_ticks
        return status

    def _nop(self) -> Status:
        """The answer to a NOP, which reports the result of the frame before it; an answer that is damaged is asked for again."""
        return self.exchange.retry(lambda: self.exchange.send_short(frames.pack_nop(self._sent, 0, self.exchange.sequence)))

    def _after_s(self, ticks: int) -> float:
        return self.earliest_trigger_s() + ticks / self._board.link.clock_hz
