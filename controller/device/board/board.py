"""Boards: everything about one panel, from `boards/<name>/board.toml` to frozen, checked records.

Files use mm and ms; properties return SI units. An unknown key, a wrong type or an impossible value is a ConfigError that
names file, key and value. The reference for users (reference.md) is generated from these records and their docstrings.
"""

from __future__ import annotations

import operator
import os
from collections.abc import Collection
from functools import cache, reduce
from pathlib import Path
from typing import Annotated, Any, Self, cast

import msgspec
from msgspec import Meta

from controller.device.board.devices import ApplicationSocket, GatewareLoading, LinkSettings, Realtime, Temperature
from controller.device.board.digest import sha256
from controller.device.board.lookup import board_places, fpga_files, in_system_folder
from controller.device.board.panel import CHANNELS, Actuator, AssumedFinger, BankSettings, Compose, Driver, Limits, Waveform
from controller.device.board.plate.parts import Parts, followed
from controller.device.board.plate.patches import Patches
from controller.device.board.plate.plate import Plate
from controller.device.board.records import Record, as_record, read_tables
from controller.device.board.relations.checked import judge
from controller.device.board.relations.relation import Relation
from controller.device.board.touch_panels import TouchPanel, touch_record, touch_records
from controller.errors import ConfigError

# Where left out, these keys of plate and waveform are not part of the digest
LATER_KEYS = {"layers": (), "damping": None, "slope": 0.0, "drift_percent": 0.0}


class Board(Record, frozen=True):
    """One panel: the whole board.toml. Names of scenes and recordings are relative to its folder.

    Attributes:
    name: Name of the board: lower case letters, digits, - and _.
    scene: Scene that is played unless another is asked for: a name beside board.toml, or a path.
    plate: The plate.
    actuators: The piezo patches; each channel at most once, each patch on the plate and none on another.
    driver: The driver stages.
    waveform: The waveform of one emission.
    bank: The bank of precomputed waveforms.
    compose: Left out: as `bank` says.
    touch: The touch panel.
    link: The link to the FPGA.
    limits: Limits.
    patches: Left out: the patches neither weigh anything nor stiffen the plate.
    finger: Left out: drive words are made for a bare plate, as the paper's.
    parts: Left out: [driver] and [patches] give all their keys.
    temperature: Left out: the plate is taken to be as warm as the bank assumes.
    gateware: Left out: an FPGA with another gateware is refused.
    realtime: Left out: the defaults.
    application_socket: Left out: there is no socket.
    idle_disarm_s: After so long without a touch, a command or a fixed emitter the outputs ramp to 0 V, and nothing is sent to the
        FPGA until the next touch or command, felt a ramp later. A scene with a region that has `keep_armed` stays armed. Left out:
        never.
    folder: Folder of the board.toml; set on reading, not a key of the file.
    """

    name: Annotated[str, Meta(pattern=r"^[a-z0-9][a-z0-9_-]{0,63}\Z")]
    scene: str
    plate: Plate
    actuators: tuple[Actuator, ...]
    driver: Driver
    waveform: Waveform
    bank: BankSettings
    touch: TouchPanel
    link: LinkSettings
    limits: Limits
    temperature: Temperature | None = None
    gateware: GatewareLoading | None = None
    realtime: Realtime = Realtime()
    application_socket: ApplicationSocket | None = None
    idle_disarm_s: Annotated[float, Meta(ge=1, le=86400)] | None = None
    compose: Compose = Compose()
    patches: Patches | None = None
    finger: AssumedFinger | None = None
    parts: Parts | None = None
    folder: Path = msgspec.field(default_factory=Path)

    @property
    def called(self) -> str:
        """Value for --board that finds this board: the name of its folder where boards are looked up, else the folder's path."""
        found = next((place / self.key for place in board_places() if (place / self.key / "board.toml").is_file()), None)
        return self.key if found is not None and found.resolve() == self.folder.resolve() else str(self.folder)

    @property
    def key(self) -> str:
        """Name of its folder, which also names its bank: a copy of a board keeps the board's `name` but not its key."""
        return Path(os.path.abspath(self.folder)).name or self.name  # noqa: PTH100 - a symbolic link keeps its name

    @property
    def bitstream(self) -> str:
        """File that its FPGA is loaded with, of several the first: as board.toml names it, else after its folder."""
        named = self.gateware.bitstream if self.gateware is not None else None
        return named or f"{self.key}.bit"

    @property
    def is_the_systems(self) -> bool:
        """Whether its folder is in /etc, where the service looks for its board."""
        return in_system_folder(Path(os.path.abspath(self.folder)))  # noqa: PTH100

    def beside(self, name: str) -> Path:
        """Path of a file that this board names, relative to its folder.

        A name such as `../simulated/scene.toml` is also looked up beside the boards of the other places, so that a copy of a
        board still finds the files of the board beside which the original was. The file need not exist.
        """
        file = self.folder / name
        if file.exists() or Path(name).parts[:1] != ("..",):
            return file
        elsewhere = (place / Path(*Path(name).parts[1:]) for place in board_places())
        return next((other for other in elsewhere if other.exists()), file)

    @property
    def fpga_boards(self) -> tuple[Self, ...]:
        """The board as each of its FPGAs drives it: its own patches, their channels counted from 0 on; of one FPGA, the board."""
        return tuple(self._driven_by(number) for number in range(len(self.link.fpga))) or (self,)

    def _driven_by(self, number: int) -> Self:
        first = CHANNELS * number
        own = tuple(
            msgspec.structs.replace(a, channel=a.channel - first) for a in self.actuators if first <= a.channel < first + CHANNELS
        )
        link, gateware = self.link.of_fpga(number), self.gateware
        if gateware is not None:
            load = tuple(word.replace("{cable}", self.link.fpga[number].cable) for word in gateware.load)
            file = str(fpga_files(Path(self.bitstream), number + 1)[number])
            gateware = msgspec.structs.replace(gateware, load=load, bitstream=file)
        patches = self.patches and self.patches.with_places(self.plate, self.actuators)  # those of all are on the plate
        return msgspec.structs.replace(self, actuators=own, link=link, gateware=gateware, patches=patches)

    @property
    def channels(self) -> int:
        """Outputs of all its FPGAs, with or without a patch."""
        return CHANNELS * max(len(self.link.fpga), 1)

    @property
    def idle_word(self) -> int:
        """Drive word of the idle levels: bit q is the level of channel q."""
        return sum(a.idle << a.channel for a in self.actuators)

    @property
    def channel_mask(self) -> int:
        """Drive word with the bit of every channel that has an actuator."""
        return sum(1 << a.channel for a in self.actuators)

    @property
    def bit_period(self) -> int:
        """Time for which one drive word is output, in 65536ths of a tick of the FPGA."""
        return round(self.link.clock_hz / self.waveform.bit_clock_hz * 65536)

    @property
    def bit_ticks(self) -> int:
        """Time for which one drive word is output, in whole ticks of the FPGA."""
        return round(self.link.clock_hz / self.waveform.bit_clock_hz)

    @property
    def emission_ticks(self) -> int:
        """Length of an emission in ticks of the FPGA."""
        return self.waveform.samples * self.bit_period >> 16

    def period_ticks(self, period_s: float) -> int:
        """Period of repeated emissions in ticks; one that differs from the emission's length by a tick of rounding equals it."""
        ticks = round(period_s * self.link.clock_hz)
        return self.emission_ticks if abs(ticks - self.emission_ticks) <= 1 else ticks

    def digest(self) -> bytes:
        """SHA-256 of the tables that a bank is computed from: plate, actuators, driver, waveform, patches, finger."""
        plate, waveform = (
            {key: value for key, value in msgspec.to_builtins(table).items() if key not in LATER_KEYS or value != LATER_KEYS[key]}
            for table in (self.plate, self.waveform)
        )
        tables = (plate, self.actuators, self.driver, waveform, *filter(None, (self.patches, self.finger)))
        return sha256(msgspec.json.encode(tables))  # keys in the order of the records


def load_board(path: Path, without: Collection[Relation] = ()) -> Board:
    """Read and check a board.toml.

    `path` is the file, or the folder that holds it. A board may break the relations between keys in `without`: a command that mends
    these keys has to read them first. Raises ConfigError, naming file, key and value; all keys that are missing or unknown, and all
    relations that refuse (`relations`).
    """
    file = path / "board.toml" if path.is_dir() else path
    board = as_board(f"{file}: ", read_tables(file))
    if refused := judge(board, without).refused:
        raise ConfigError(f"{file}: {'; '.join(refused)}")
    return msgspec.structs.replace(board, folder=file.parent)


def of_one_fpga(board: Board) -> Board:
    """The board, for what serves boards of one FPGA; raises ConfigError if it has several."""
    if board.link.fpga:
        raise ConfigError(f"board {board.name!r}: link.fpga: this serves boards of one FPGA, not of {len(board.link.fpga)}")
    return board


def as_board(before: str, tables: dict[str, Any]) -> Board:
    """Convert the tables of a board.toml to a board, by the record of its kind of touch panel.

    `before` is the start of an error message. Raises ConfigError as of `as_record`.
    """
    touch = tables.get("touch")
    record = touch_record(touch.get("kind")) if isinstance(touch, dict) else None
    found = as_record(before, tables, board_file((record,) if record else touch_records()))
    return _completed(before, Board(**{name: getattr(found, name) for name in Board.__struct_fields__}))


def _completed(before: str, board: Board) -> Board:
    """The board with the keys of [driver] and [patches] that were left out, as they follow from its parts.

    Raises ConfigError if there are no parts either, or they give a value that no board may have.
    """
    tables = {name: msgspec.structs.asdict(table) for name in ("driver", "patches") if (table := getattr(board, name)) is not None}
    missing = [f"{name}.{key}" for name, table in tables.items() for key, value in table.items() if value != value]  # noqa: PLR0124
    if not missing:
        return board
    if board.parts is None:
        raise ConfigError(f"{before}{'; '.join(f'{key} is missing' for key in missing)}: give it, or [parts]")
    follows = followed(board.parts, board.plate, board.waveform, **tables)
    return msgspec.structs.replace(
        board, **{name: as_record(f"{before}[parts] makes {name}.", follows[name], type(getattr(board, name))) for name in tables}
    )


@cache
def board_file(panels: tuple[type[TouchPanel], ...]) -> type[Board]:
    """The record of a board.toml whose touch panel is one of these."""
    own: dict[str, Any] = {"touch": reduce(operator.or_, panels)}
    as_it_is: Any = msgspec.field
    fields = [  # all of them, as one that is declared again goes behind the others
        (one.name, own.get(one.name, one.type), as_it_is(default=one.default, default_factory=one.default_factory))
        for one in msgspec.structs.fields(Board)
    ]
    namespace = {"__doc__": Board.__doc__}
    made = msgspec.defstruct("Board", fields, bases=(Board,), namespace=namespace, module=__name__, frozen=True, kw_only=True)
    return cast(type[Board], made)


def simulated(board: Board) -> Board:
    """The same board with simulated gateware instead of its FPGA."""
    device = board.link.device if board.link.kind == "simulated" else ""
    return msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, kind="simulated", device=device))
