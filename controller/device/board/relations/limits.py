"""Relations of clocks and times: the bit clock and lengths that the FPGA takes, heartbeats, ramps and duty."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.relations.relation import refuses, warns

if TYPE_CHECKING:
    from controller.device.board.board import Board

MAX_FRAME_BYTES = 512  # frames.LOAD_FRAME_BYTES
FRAME_SAMPLES = 125  # of an upload, in one frame
MIN_BIT_TICKS = 4  # registers.BIT_TICKS_MIN
BIT_CLOCK_HZ = (100_000, 2_000_000)  # registers.BIT_CLOCK_HZ_MIN and _MAX
GLASS_PER_K = 1e-3  # the frequencies of glass change by 1e-5 to 3e-4 a kelvin
HASTIEST_MS = 10.0  # Linux wakes a process that late now and then
ALIVE_HZ = 20e3  # gate.ALIVE_HZ_4 / 2
FEWEST_PULSES = 10.0  # the reference stage (boards/stage) needs 511 us
SHORTEST_RAMP = 10.0  # periods of the band's lower edge


@refuses("`waveform.bit_clock_hz`, `link.clock_hz`")
def _bit_ticks(board: Board) -> Iterator[str]:
    """A drive word lasts four clocks of the FPGA or more."""
    if board.link.clock_hz < MIN_BIT_TICKS * board.waveform.bit_clock_hz:
        yield (
            f"waveform.bit_clock_hz = {board.waveform.bit_clock_hz} is above a {MIN_BIT_TICKS}th of link.clock_hz ="
            f" {board.link.clock_hz}"
        )


@refuses("`waveform.bit_clock_hz`, `link.clock_hz`, `temperature`")
def _bit_period(board: Board) -> Iterator[str]:
    """The FPGA takes the bit clock at every temperature."""
    # The FPGA's own bounds are in whole clocks; the bit clock is not, and follows the plate's temperature.
    clock_hz, temperature = board.link.clock_hz, board.temperature
    fewest = max(clock_hz // BIT_CLOCK_HZ[1], MIN_BIT_TICKS)
    most = max(clock_hz // BIT_CLOCK_HZ[0], fewest)
    at: dict[str, float] = {"": 1.0}
    if temperature is not None:
        for key, at_c in (("lowest_c", temperature.lowest_c), ("highest_c", temperature.highest_c)):
            at[f", scaled by {temperature.scale(at_c):.5g} at temperature.{key} = {at_c:g},"] = temperature.scale(at_c)
    for where, scale in at.items():
        ticks = clock_hz / board.waveform.bit_clock_hz / scale if scale > 0 else 0.0
        if ticks >= MIN_BIT_TICKS and not fewest <= round(ticks * 65536) / 65536 <= most:
            yield (
                f"waveform.bit_clock_hz = {board.waveform.bit_clock_hz:g}{where} is {ticks:.7g} clocks of link.clock_hz ="
                f" {clock_hz}, and the FPGA takes {fewest} to {most}: take another bit clock"
            )
            return


@refuses("`limits.min_pulse_us`, `waveform.bit_clock_hz`")
def _pulse(board: Board) -> Iterator[str]:
    """A drive word is a pulse that is long enough."""
    if board.limits.min_pulse_us * 1e-6 * board.waveform.bit_clock_hz > 1:
        yield (
            f"limits.min_pulse_us = {board.limits.min_pulse_us:g} is longer than a drive word,"
            f" {1e6 / board.waveform.bit_clock_hz:g} us at waveform.bit_clock_hz = {board.waveform.bit_clock_hz}"
        )


@refuses("`waveform.duration_ms`, `limits.longest_emission_ms`")
def _emission(board: Board) -> Iterator[str]:
    """An emission is as long as allowed."""
    if board.waveform.duration_ms > board.limits.longest_emission_ms:
        yield (
            f"waveform.duration_ms = {board.waveform.duration_ms:g} is longer than limits.longest_emission_ms ="
            f" {board.limits.longest_emission_ms:g}"
        )


@refuses("`temperature`, `waveform`, `limits`")
def _temperatures(board: Board) -> Iterator[str]:
    """At every temperature words and emissions are as long as allowed."""
    temperature, limits = board.temperature, board.limits
    if temperature is None:
        return
    for key, at_c in (("lowest_c", temperature.lowest_c), ("highest_c", temperature.highest_c)):
        scale = temperature.scale(at_c)
        where = f"temperature.{key} = {at_c:g} scales the bit clock by {scale:.5g}"
        if not 0.5 < scale < 2:
            yield f"{where}: by coefficient_per_k = {temperature.coefficient_per_k:g}, which is no glass"
            return
        if board.waveform.duration_ms / scale > limits.longest_emission_ms:
            yield (
                f"{where}: an emission of {board.waveform.duration_ms / scale:.5g} ms is longer than limits.longest_emission_ms ="
                f" {limits.longest_emission_ms:g}"
            )
        word_ticks = int(board.link.clock_hz / board.waveform.bit_clock_hz / scale)
        if word_ticks < max(MIN_BIT_TICKS, limits.min_pulse_us * 1e-6 * board.link.clock_hz):
            yield (
                f"{where}: a drive word of {word_ticks} clocks of the FPGA is shorter than limits.min_pulse_us ="
                f" {limits.min_pulse_us:g}, or than {MIN_BIT_TICKS} clocks"
            )


@warns("`temperature.coefficient_per_k`")
def _coefficient(board: Board) -> Iterator[str]:
    """It is that of a glass."""
    if board.temperature is not None and abs(board.temperature.coefficient_per_k) > GLASS_PER_K:
        yield (
            f"temperature.coefficient_per_k = {board.temperature.coefficient_per_k:g} is"
            f" {100 * board.temperature.coefficient_per_k:g} % a kelvin; glass changes by 0.001 to 0.03 %: is it a share, not"
            " percent?"
        )


@refuses("`limits.heartbeat_timeout_ms`, `link.sck_hz` or `baud`")
def _heartbeat(board: Board) -> Iterator[str]:
    """It is twice as long as a frame on the wire; of several FPGAs, as the uploads to the others."""
    link, timeout_ms = board.link, board.limits.heartbeat_timeout_ms
    to_others = (len(link.fpga) - 1) * -(-board.waveform.samples // FRAME_SAMPLES) if link.fpga else 0
    quiet_ms = link.wire_s(max(to_others, 1) * MAX_FRAME_BYTES) * 1e3
    if quiet_ms > timeout_ms / 2:
        at = f"link.baud = {link.baud}" if link.kind == "serial" else f"link.sck_hz = {link.sck_hz}"
        taken = "the uploads to the other FPGAs take" if to_others else "one frame takes"
        yield f"limits.heartbeat_timeout_ms = {timeout_ms:g} is less than twice the {quiet_ms:.3g} ms that {taken} at {at}"


@warns("`limits.heartbeat_timeout_ms`")
def _patience(board: Board) -> Iterator[str]:
    """Linux can keep it."""
    if board.limits.heartbeat_timeout_ms < HASTIEST_MS:
        yield (
            f"limits.heartbeat_timeout_ms = {board.limits.heartbeat_timeout_ms:g}: Linux wakes a process up to {HASTIEST_MS:g} ms"
            " late now and then, and the FPGA switches off each time; 100 is usual"
        )


@refuses("`limits.ramp_ms`, `max_duty`, `duty_budget_ms`, `waveform.duration_ms`")
def _ramp_duty(board: Board) -> Iterator[str]:
    """The budget holds a ramp and an emission."""
    # Ramps count as activity: the duty bucket gains 1 - max_duty in each of their ticks (stage_limits.v).
    limits = board.limits
    gained_ms = (limits.ramp_ms + board.waveform.duration_ms) * (1 - limits.max_duty)
    if gained_ms > limits.duty_budget_ms:
        yield (
            f"limits.ramp_ms = {limits.ramp_ms:g} and an emission of {board.waveform.duration_ms:g} ms take {gained_ms:.3g} ms of"
            f" limits.duty_budget_ms = {limits.duty_budget_ms:g} at max_duty = {limits.max_duty:g}: the FPGA switches off"
            " whenever it is armed; shorten the ramp, or raise the budget"
        )


@warns("`limits.ramp_ms`, `max_duty`, `duty_budget_ms`")
def _two_ramps(board: Board) -> Iterator[str]:
    """It holds a ramp down and one up, too."""
    limits = board.limits
    once_ms = (limits.ramp_ms + board.waveform.duration_ms) * (1 - limits.max_duty)
    gained_ms = once_ms + limits.ramp_ms * (1 - limits.max_duty)
    if once_ms <= limits.duty_budget_ms < gained_ms:
        yield (
            f"limits.ramp_ms = {limits.ramp_ms:g}, down and up again, and an emission take {gained_ms:.3g} ms of duty_budget_ms ="
            f" {limits.duty_budget_ms:g}: the FPGA switches off when it is armed soon after it was disarmed; raise the budget"
        )


@warns("`limits.ramp_ms`, `waveform.band_low_hz`")
def _ramp_speed(board: Board) -> Iterator[str]:
    """A ramp is slower than the band."""
    least_ms = SHORTEST_RAMP / board.waveform.band_low_hz * 1e3
    if board.limits.ramp_ms < least_ms:
        yield (
            f"limits.ramp_ms = {board.limits.ramp_ms:g} is as fast as the band itself (waveform.band_low_hz ="
            f" {board.waveform.band_low_hz:g}): arming and disarming are felt and heard; take {least_ms:.2g} ms or more, 10 is"
            " usual"
        )


@warns("`limits.hv_settle_us`")
def _settle(board: Board) -> Iterator[str]:
    """The supply has ten pulses of hv_alive to come up."""
    pulses = board.limits.hv_settle_us * 1e-6 * ALIVE_HZ
    if pulses < FEWEST_PULSES:
        yield (
            f"limits.hv_settle_us = {board.limits.hv_settle_us:g} is {pulses:.2g} pulses of hv_alive ({ALIVE_HZ:g} Hz): a charge"
            " pump that they feed has hardly begun, and the first ramp finds no supply; 1000 is usual"
        )
