"""What is really there of a simulated panel, where it is not as its board.toml says: no real panel is quite.

`link.device` of a simulated link names its file, beside board.toml; without one all is as board.toml says. It is absolute: what the
host believes changes as board.toml is mended, what is there does not.
"""

import math
import shutil
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta

from controller.arrays import Floats
from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS, FPGAS_MAX, Actuator, Driver
from controller.device.board.plate.plate import Plate
from controller.device.board.records import Record, as_record, load_toml
from controller.device.board.relations.panel import PLACES
from controller.device.fpga.build_parameters import BuildParameters
from controller.errors import ConfigError


class ActualPatch(Record, frozen=True, kw_only=True):
    """A patch that moves, and the output that it hangs on."""

    channel: Annotated[int, Meta(ge=0, lt=CHANNELS * FPGAS_MAX)]
    x_mm: float
    y_mm: float
    size_mm: float


class SensorFrame(Record, frozen=True, kw_only=True):
    """Where a sensor is that was sent to the plate's corner, and by how much it then turns."""

    x_mm: float = 0.0
    y_mm: float = 0.0
    degrees: float = 0.0

    def place_m(self, asked_m: Floats) -> Floats:
        """Place on the plate of a sensor that was sent to `asked_m` (2,)."""
        cosine, sine = math.cos(math.radians(self.degrees)), math.sin(math.radians(self.degrees))
        return np.array([[cosine, -sine], [sine, cosine]]) @ asked_m + np.array([self.x_mm, self.y_mm]) * 1e-3


class ActualTouch(Record, frozen=True, kw_only=True):
    """The touch panel's wires."""

    interrupt: bool = True  # whether its interrupt line arrives


class Fpga(Record, frozen=True, kw_only=True):
    """An FPGA with a flash: what is in it since `gateware load` counts; without the file it is as it was delivered, empty."""

    flash: Annotated[str, Meta(min_length=1)]  # file beside this one


class ActualPanel(Record, frozen=True, kw_only=True):
    """What is there, where it is not as board.toml says; keys of [plate] and [driver] are those of board.toml."""

    plate: dict[str, Any] = msgspec.field(default_factory=dict)
    driver: dict[str, Any] = msgspec.field(default_factory=dict)
    actuators: tuple[ActualPatch, ...] | None = None  # those that move; None: as board.toml says
    frame: SensorFrame = SensorFrame()
    touch: ActualTouch = ActualTouch()
    fpga: Fpga | None = None  # None: it has the board's gateware

    def of(self, board: Board) -> Board:
        """The board that is there: plate, patches and stages behind the outputs; idle levels are those that the host gives them.

        Raises ConfigError if a key does not exist, or patches do not fit.
        """
        there = f"{_file(board)}: "
        real = msgspec.structs.replace(
            board,
            plate=_changed(there + "plate.", board.plate, self.plate, Plate),
            driver=_changed(there + "driver.", board.driver, self.driver, Driver),
            actuators=board.actuators if self.actuators is None else tuple(_patches(board, self.actuators)),
        )
        if refused := [said for relation in PLACES for said in relation.broken(real)]:
            raise ConfigError(f"{there}{'; '.join(refused)}")
        return real


def rewired(board: Board, swapped: Iterable[Sequence[int]], dead: Collection[int]) -> tuple[ActualPatch, ...]:
    """Patches of a board of whose outputs some hang on each other's patch, without those that are dead."""
    hangs_on = {actuator.channel: actuator.channel for actuator in board.actuators}
    for a, b in swapped:
        hangs_on[a], hangs_on[b] = hangs_on[b], hangs_on[a]
    return tuple(
        ActualPatch(channel=hangs_on[one.channel], x_mm=one.x_mm, y_mm=one.y_mm, size_mm=one.size_mm)
        for one in board.actuators
        if one.channel not in dead
    )


def actual_panel(board: Board) -> ActualPanel:
    """What is really there of a board; raises ConfigError if its file is missing or invalid."""
    return load_toml(_file(board), ActualPanel) if board.link.kind == "simulated" and board.link.device else ActualPanel()


def gateware_of(board: Board, build_hash: int) -> BuildParameters | None:
    """What the simulated FPGA of a board is configured with; None: with nothing.

    Raises ConfigError as `actual_panel` does, or GatewareError if the flash holds no whole bitstream.
    """
    of_board = BuildParameters.of(board, build_hash)
    flash = _flash(board)
    if flash is None:
        return of_board
    if not flash.exists():
        return None
    from controller.device.fpga.bitstreams.bitstream import read_identity  # noqa: PLC0415 - loads OpenSSL: 4 MB of a simulated service

    return replace(of_board, **{name.lower(): value for name, value in read_identity(flash).parameters.items()})


def load_flash(board: Board, bitstream: Path) -> None:
    """Write a bitstream to the flash of a board's simulated FPGA; raises ConfigError if it has none."""
    flash = _flash(board)
    if flash is None:
        raise ConfigError(f"board {board.name!r}: its simulated FPGA has no flash: it has the board's gateware as it is")
    shutil.copyfile(bitstream, flash)


def _flash(board: Board) -> Path | None:
    fpga = actual_panel(board).fpga
    return None if fpga is None else _file(board).with_name(fpga.flash)


def _file(board: Board) -> Path:
    return board.beside(board.link.device)


def _patches(board: Board, patches: Iterable[ActualPatch]) -> Iterator[Actuator]:
    idle = {actuator.channel: actuator.idle for actuator in board.actuators}
    for patch in patches:
        yield Actuator(**msgspec.structs.asdict(patch), idle=idle.get(patch.channel, 0))


def _changed(before: str, table: Record, keys: dict[str, Any], kind: type[Any]) -> Any:
    there = {name: kept for name, kept in msgspec.to_builtins(table).items() if kept is not None}
    return as_record(before, there | keys, kind)
