"""Relations of patches and drivers: places and channels of the patches, what the driver passes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from controller.device.board.panel import CHANNELS, FPGAS_MAX
from controller.device.board.plate.patches import TOUCHING_MM, discs
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.device.board.relations.relation import refuses, warns
from controller.device.board.relations.stage_heat import passed

if TYPE_CHECKING:
    from controller.device.board.board import Board

LARGEST_PATCH = 0.75  # of the shortest wave: one of a whole wave does not drive it at all
LEAST_PASSED = 0.5  # of the stage's voltage, in the middle of the band
VACUUM_F_M = 8.854e-12
CERAMIC = (500.0, 4000.0)  # relative permittivity of piezo ceramics, hard to soft
CERAMIC_MM = (0.05, 3.0)  # thickness that is made
PARTS_DIFFER = 1.5  # datasheets allow 30 % of capacitance; glue is not known better


@refuses("`actuators`")
def _count(board: Board) -> Iterator[str]:
    """There are 1 to 32 for each FPGA."""
    most = board.channels
    if not 1 <= len(board.actuators) <= most:
        yield f"actuators are {len(board.actuators)}; a board has 1 to {most} channels"


@refuses("`actuators.channel`")
def _channels(board: Board) -> Iterator[str]:
    """No two patches share a channel."""
    first: dict[int, int] = {}
    for index, actuator in enumerate(board.actuators):
        if first.setdefault(actuator.channel, index) != index:
            yield f"actuators[{index}].channel = {actuator.channel} is taken by actuators[{first[actuator.channel]}] already"


@refuses("`link.fpga`, `actuators.channel`")
def _fpgas(board: Board) -> Iterator[str]:
    """Each of two to four FPGAs has a channel, and there is no channel of another."""
    fpgas = len(board.link.fpga)
    if fpgas == 1 or fpgas > FPGAS_MAX:
        yield f"link.fpga are {fpgas}; give 2 to {FPGAS_MAX}, or leave it out"
        return
    driven = {actuator.channel // CHANNELS for actuator in board.actuators}
    if beyond := driven - set(range(max(fpgas, 1))):
        yield (
            f"actuators.channel: there are channels from {CHANNELS * min(beyond)} on, and FPGAs for {CHANNELS * max(fpgas, 1)}:"
            " give a further [[link.fpga]]"
        )
    elif idle := set(range(fpgas)) - driven:
        yield f"link.fpga[{min(idle)}] has no channel: give it actuators with channels from {CHANNELS * min(idle)} on"


@refuses("`link.fpga`, `kind`")
def _together(board: Board) -> Iterator[str]:
    """Several FPGAs have a trigger line, which a serial link has not."""
    if board.link.fpga and board.link.kind == "serial":
        yield "link.fpga: several FPGAs begin together by a trigger line, which link.kind = 'serial' has not: connect them by SPI"


@refuses("`link.fpga.cable`, `gateware.load`")
def _cables(board: Board) -> Iterator[str]:
    """What loads several FPGAs knows one from the other."""
    if board.gateware is None or not any("{cable}" in word for word in board.gateware.load):
        if board.gateware is not None and board.link.fpga:
            yield "gateware.load names no {cable}: several FPGAs are loaded one by one, each known by its link.fpga.cable"
        return
    cables = [one.cable for one in board.link.fpga]
    if not cables:
        yield "gateware.load names a {cable}: those are of the FPGAs in link.fpga, and there is none"
    for number, cable in enumerate(cables):
        if not cable or cable in cables[:number]:
            yield f"link.fpga[{number}].cable = {cable!r}: each FPGA needs one of its own, by which gateware.load knows it"


@refuses("`actuators.x_mm`, `y_mm`, `size_mm`, `plate.length_mm`, `width_mm`")
def _on_plate(board: Board) -> Iterator[str]:
    """Each patch lies on the plate."""
    for index, a in enumerate(board.actuators):
        for axis, value, extent in (("x_mm", a.x_mm, board.plate.length_mm), ("y_mm", a.y_mm, board.plate.width_mm)):
            if not a.size_mm / 2 <= value <= extent - a.size_mm / 2:
                yield f"actuators[{index}].{axis} = {value} puts the patch off the plate (0 to {extent} mm)"


@refuses("`actuators.x_mm`, `y_mm`, `size_mm`")
def _apart(board: Board) -> Iterator[str]:
    """No patch lies on another."""
    for index, a in enumerate(board.actuators):
        for other, b in enumerate(board.actuators[:index]):
            apart_mm = max(abs(a.x_mm - b.x_mm), abs(a.y_mm - b.y_mm))
            if apart_mm < (a.size_mm + b.size_mm) / 2 - TOUCHING_MM:
                yield (
                    f"actuators[{index}] lies on actuators[{other}]: their centres are {apart_mm:g} mm apart along x or y, less"
                    f" than half of their sizes together, {(a.size_mm + b.size_mm) / 2:g} mm"
                )
                return  # piled patches lie on each other in hundreds of pairs


@refuses("`patches`, `actuators`, `plate`")
def _patches(board: Board) -> Iterator[str]:
    """What is glued to the plate lies on it, and not on each other."""
    try:
        if board.patches is not None:
            board.patches.on(board.plate, board.actuators)
    except ValueError as error:
        yield str(error)


@warns("`actuators.idle`")
def _idle(board: Board) -> Iterator[str]:
    """Half of the patches of each disc idle high, so that steps cancel."""
    levels = [actuator.idle for actuator in board.actuators]
    why = "the steps between idle and playing do not cancel, and a single emission has half the contrast"
    advice = "let half of the patches of each disc idle high, as a checkerboard"
    if len(set(levels)) == 1 and len(levels) > 1:
        yield f"actuators: all {len(levels)} have idle = {levels[0]}: {why}; {advice}"
        return
    for group in discs(board.actuators):
        high = sum(actuator.idle for actuator in group)
        if abs(2 * high - len(group)) > len(group) % 2:
            channels = ", ".join(str(actuator.channel) for actuator in group)
            yield (
                f"actuators: {high} of the {len(group)} patches of one disc (channels {channels}) have idle = 1: {why}; {advice}"
            )
            return


@warns("`actuators.size_mm`, `plate`, `waveform.band_high_hz`")
def _patch_size(board: Board) -> Iterator[str]:
    """A patch is below 0.75 of the shortest wave."""
    wave_mm = bending_wavelength_m(board.plate, board.waveform.band_high_hz) * 1e3
    size_mm = max((actuator.size_mm for actuator in board.actuators), default=0.0)
    if size_mm > LARGEST_PATCH * wave_mm:
        yield (
            f"actuators: a patch of size_mm = {size_mm:g} is {size_mm / wave_mm:.2g} of the wave of {wave_mm:.3g} mm at"
            f" waveform.band_high_hz = {board.waveform.band_high_hz:g}, which it hardly drives: make patches smaller than half of"
            " it, or take a lower band"
        )


@warns("`driver.capacitance_f`, `actuators.size_mm`")
def _capacitance(board: Board) -> Iterator[str]:
    """A patch is of a thickness that is made."""
    for size_mm in sorted({actuator.size_mm for actuator in board.actuators}):
        thin_mm, thick_mm = (1e3 * VACUUM_F_M * of * (size_mm * 1e-3) ** 2 / board.driver.capacitance_f for of in CERAMIC)
        if thick_mm < CERAMIC_MM[0] or thin_mm > CERAMIC_MM[1]:
            yield (
                f"driver.capacitance_f = {board.driver.capacitance_f:g} in a patch of actuators.size_mm = {size_mm:g} is ceramic"
                f" {thin_mm:.2g} to {thick_mm:.2g} mm thick, which is not made ({CERAMIC_MM[0]:g} to {CERAMIC_MM[1]:g} mm):"
                " measure one patch"
            )
            return


@warns("`driver`, `waveform.band_low_hz`, `band_high_hz`")
def _driver_band(board: Board) -> Iterator[str]:
    """The stage's filter passes half in the band's middle."""
    hz = board.waveform.middle_hz
    share = passed(board.driver, hz)
    if share < LEAST_PASSED:
        d = board.driver
        resonance_hz = 1 / (2 * math.pi * math.sqrt(d.inductance_h * d.capacitance_f))
        yield (
            f"driver: resistance_ohm = {d.resistance_ohm:g}, inductance_h = {d.inductance_h:g} and capacitance_f ="
            f" {d.capacitance_f:g} pass {share:.2g} of the stage's voltage at {hz:g} Hz, the middle of the band: a filter of"
            f" {resonance_hz:.3g} Hz; match them to waveform.band_low_hz and band_high_hz"
        )


@warns("`parts`, `driver.capacitance_f`, `moment_n_per_v`, `patches`, `actuators.size_mm`")
def _parts(board: Board) -> Iterator[str]:
    """What a board gives is within a half of what its parts make of it."""
    if board.parts is None:
        return
    on, patches = board.parts.on(board.plate), board.patches
    pairs = [("driver.moment_n_per_v", board.driver.moment_n_per_v, on.disc_moment_n_per_v if patches else on.moment_n_per_v)]
    for size_mm in sorted({actuator.size_mm for actuator in board.actuators}):
        pairs.append(
            (
                f"actuators.size_mm = {size_mm:g}: driver.capacitance_f",
                board.driver.capacitance_f,
                board.parts.capacitance_f(size_mm),
            )
        )
    if patches:
        pairs.append(("patches.mass_kg_m2", patches.mass_kg_m2, on.mass_kg_m2))
        pairs.append(("patches.stiffness_ratio", patches.stiffness_ratio, on.stiffness_ratio))
    for key, given, made in pairs:
        if not made / PARTS_DIFFER <= given <= made * PARTS_DIFFER:
            yield f"{key} = {given:.3g}, of {board.parts.called} {made:.3g}: measure it, or give the parts that the panel has"


# Of patches on a plate: what any plate must keep, whatever plays on it
PLACES = (_count, _channels, _fpgas, _on_plate, _apart, _patches)
