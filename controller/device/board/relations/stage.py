"""Relations of the stages: edges that their limits allow, that waveforms and ramps need, and the heat that edges burn."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.panel import EDGE_WINDOW_S
from controller.device.board.relations.relation import refuses, warns
from controller.device.board.relations.stage_heat import worst_edge_j

if TYPE_CHECKING:
    from controller.device.board.board import Board

RAMP_EDGES = 0.445  # of the drive words of a ramp, in each channel that idles high: pulses of changing density (pins.ramp_bits)


@refuses("`limits.ramp_ms`, `waveform.bit_clock_hz`, edge limits")
def _ramp_edges(board: Board) -> Iterator[str]:
    """The edges of a ramp are allowed."""
    limits, high = board.limits, sum(actuator.idle for actuator in board.actuators)
    edges = limits.ramp_ms * 1e-3 * board.waveform.bit_clock_hz * RAMP_EDGES * (high > 0)
    for key, rate_hz, made in (
        ("max_channel_edge_rate_hz", limits.max_channel_edge_rate_hz, edges),
        ("max_total_edge_rate_hz", limits.max_total_edge_rate_hz, edges * high),
    ):
        if made > rate_hz * EDGE_WINDOW_S:
            yield (
                f"limits.ramp_ms = {limits.ramp_ms:g} makes about {made:.4g} edges, more than the {rate_hz * EDGE_WINDOW_S:.4g}"
                f" that limits.{key} = {rate_hz:g} allows in {EDGE_WINDOW_S:g} s: the FPGA switches off whenever it is armed;"
                " shorten the ramp"
            )


@refuses("`limits.max_channel_edge_rate_hz`, `resistor_rating_w`, `derating`, `driver`")
def _heat(board: Board) -> Iterator[str]:
    """No resistor gets hotter than it may."""
    limits = board.limits
    edge_j, permitted_w = worst_edge_j(board.driver), limits.resistor_rating_w * limits.derating
    burnt_w = limits.max_channel_edge_rate_hz * edge_j
    if burnt_w > permitted_w * (1 + 1e-9):
        d = board.driver
        yield (
            f"limits.max_channel_edge_rate_hz = {limits.max_channel_edge_rate_hz:g} lets a stage burn {burnt_w:.2g} W"
            f" ({edge_j * 1e6:.3g} uJ an edge at most, of driver.supply_v = {d.supply_v:g}, capacitance_f = {d.capacitance_f:g})"
            f" in a resistor that may have {permitted_w:.3g} W (resistor_rating_w = {limits.resistor_rating_w:g} times derating ="
            f" {limits.derating:g}): allow at most {int(permitted_w / edge_j)} edges a second, or take a larger resistor"
        )


@warns("`limits.max_duty`, `max_edge_rate_hz`, `max_channel_edge_rate_hz`")
def _duty_edges(board: Board) -> Iterator[str]:
    """Duty is limited before edges are."""
    limits = board.limits
    rate_hz = limits.max_duty * min(limits.max_edge_rate_hz, board.waveform.bit_clock_hz)
    if rate_hz > limits.max_channel_edge_rate_hz * (1 + 1e-9):
        yield (
            f"limits.max_duty = {limits.max_duty:g} of waveforms with max_edge_rate_hz = {limits.max_edge_rate_hz:g} is"
            f" {rate_hz:g} edges a second, above max_channel_edge_rate_hz = {limits.max_channel_edge_rate_hz:g}: the FPGA"
            " switches off, for good, before the duty limit makes the host pause; max_duty ="
            f" {limits.max_channel_edge_rate_hz / rate_hz * limits.max_duty:.2g} avoids it"
        )


@warns("`limits.max_total_edge_rate_hz`, `max_channel_edge_rate_hz`, `actuators`")
def _total_edges(board: Board) -> Iterator[str]:
    """The limit of all channels is between that of one and of all."""
    limits, channels = board.limits, len(board.actuators)
    if limits.max_total_edge_rate_hz < limits.max_channel_edge_rate_hz:
        yield (
            f"limits.max_total_edge_rate_hz = {limits.max_total_edge_rate_hz:g} is below that of one channel,"
            f" max_channel_edge_rate_hz = {limits.max_channel_edge_rate_hz:g}: the FPGA switches off for good as soon as several"
            " play"
        )
    elif limits.max_total_edge_rate_hz > channels * limits.max_channel_edge_rate_hz * (1 + 1e-9):
        yield (
            f"limits.max_total_edge_rate_hz = {limits.max_total_edge_rate_hz:g} is above what {channels} channels of"
            f" max_channel_edge_rate_hz = {limits.max_channel_edge_rate_hz:g} reach: it does not protect the supply"
        )


@refuses("`limits.max_edge_rate_hz`, `waveform.band_low_hz`")
def _edges_of_band(board: Board) -> Iterator[str]:
    """A waveform of the band can keep it."""
    needed_hz = 2 * board.waveform.band_low_hz
    if board.limits.max_edge_rate_hz < needed_hz:
        yield (
            f"limits.max_edge_rate_hz = {board.limits.max_edge_rate_hz:g} is below {needed_hz:g}, two edges for each period of"
            f" waveform.band_low_hz = {board.waveform.band_low_hz:g}: no waveform of the band keeps it, and no bank can be built"
        )


@warns("`limits.max_edge_rate_hz`, `waveform`")
def _edges_of_waveforms(board: Board) -> Iterator[str]:
    """Waveforms in the middle of the band keep it."""
    needed_hz = board.waveform.band_low_hz + board.waveform.band_high_hz
    if 2 * board.waveform.band_low_hz <= board.limits.max_edge_rate_hz < needed_hz:
        yield (
            f"limits.max_edge_rate_hz = {board.limits.max_edge_rate_hz:g} is below {needed_hz:g}, two edges for each period in"
            " the middle of the band: most waveforms have more, and bank build refuses them"
        )
