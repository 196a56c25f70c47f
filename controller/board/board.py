"""Boards: everything about one panel, from `boards/<name>/board.toml` to frozen, checked records.

Files use mm and ms; properties return SI units. An unknown key, a wrong type or an impossible value is a ConfigError that
names file, key and value. The reference for users (reference.md) is generated from these records and their docstrings.
"""

from __future__ import annotations

import hashlib
import os
import sys
import sysconfig
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from controller.board.devices import ApplicationSocket, LinkSettings, Realtime, Temperature, Touch
from controller.board.records import NotNegative, PlaceMm, Positive, Record, Share, SizeMm, load_toml
from controller.errors import ConfigError

CHANNELS = 32
MAX_FRAME_BYTES = 512  # frames.LOAD_FRAME_MAX_BYTES
MIN_BIT_TICKS = 4  # registers.BIT_TICKS_MIN
SYSTEM_BOARDS = Path("/etc/haptic-panel/boards")


class Plate(Record, frozen=True):
    """The plate: size, material and support; its origin is a corner, x runs along the length.

    Attributes
    ----------
    length_mm
        Extent along x.
    width_mm
        Extent along y.
    thickness_mm
        Thickness.
    young_modulus_pa
        Young's modulus.
    poisson_ratio
        Poisson's ratio.
    density_kg_m3
        Density.
    edge
        How the edge is supported.
    decay_time_ms
        Time in which a free vibration falls to 1/e.
    theory
        Plate theory that the model uses.
    """

    length_mm: Annotated[float, Meta(ge=20, le=2000)]
    width_mm: Annotated[float, Meta(ge=20, le=2000)]
    thickness_mm: Annotated[float, Meta(ge=0.05, le=20)]
    young_modulus_pa: Annotated[float, Meta(ge=1e9, le=1e12)]
    poisson_ratio: Annotated[float, Meta(ge=0, lt=0.5)]
    density_kg_m3: Annotated[float, Meta(ge=100, le=25e3)]
    edge: Literal["simply_supported"]
    decay_time_ms: Annotated[float, Meta(ge=0.1, le=10)]
    theory: Literal["kirchhoff"] = "kirchhoff"

    @property
    def length_m(self) -> float:
        """Extent along x in m."""
        return self.length_mm * 1e-3

    @property
    def width_m(self) -> float:
        """Extent along y in m."""
        return self.width_mm * 1e-3

    @property
    def thickness_m(self) -> float:
        """Thickness in m."""
        return self.thickness_mm * 1e-3

    @property
    def decay_time_s(self) -> float:
        """Time in which a free vibration falls to 1/e, in s."""
        return self.decay_time_ms * 1e-3


class Actuator(Record, frozen=True):
    """A square piezo patch and the output that drives it.

    Attributes
    ----------
    channel
        Output of the FPGA, and bit of a drive word.
    x_mm, y_mm
        Centre of the patch.
    size_mm
        Edge length of the patch.
    idle
        Level, 0 or 1, at which its output rests while the panel is armed.
    """

    channel: Annotated[int, Meta(ge=0, lt=CHANNELS)]
    x_mm: PlaceMm
    y_mm: PlaceMm
    size_mm: SizeMm
    idle: Annotated[int, Meta(ge=0, le=1)]


class Driver(Record, frozen=True):
    """The push-pull stage of one channel, with the series R and L into the piezo's C (paper, fig. 4).

    Attributes
    ----------
    supply_v
        Supply of the stages.
    resistance_ohm
        Series resistance.
    inductance_h
        Series inductance.
    capacitance_f
        Capacitance of a patch.
    moment_n_per_v
        Bending moment per length of a patch's edge, per volt.
    """

    supply_v: Annotated[float, Meta(gt=0, le=60)]
    resistance_ohm: Annotated[float, Meta(ge=1, le=1e6)]
    inductance_h: Annotated[float, Meta(ge=1e-5, le=1)]
    capacitance_f: Annotated[float, Meta(ge=1e-12, le=1e-6)]
    moment_n_per_v: Annotated[float, Meta(ge=1e-6, le=1)]


class Waveform(Record, frozen=True):
    """The waveform of one emission.

    Attributes
    ----------
    band_low_hz
        Lower edge of the band.
    band_high_hz
        Upper edge of the band, below half of `bit_clock_hz`.
    duration_ms
        T, the length of one emission: 1 to 1000 samples of `bit_clock_hz`.
    bit_clock_hz
        Drive words a second.
    """

    band_low_hz: Positive
    band_high_hz: Positive
    duration_ms: Annotated[float, Meta(gt=0, le=10)]
    bit_clock_hz: Annotated[float, Meta(ge=100e3, le=2e6)]

    def __post_init__(self) -> None:
        if self.band_high_hz <= self.band_low_hz:
            raise ValueError(f"band_high_hz = {self.band_high_hz} is not above band_low_hz = {self.band_low_hz}")
        if self.band_high_hz >= self.bit_clock_hz / 2:
            raise ValueError(f"band_high_hz = {self.band_high_hz} is not below half of bit_clock_hz = {self.bit_clock_hz}")
        if not 1 <= round(self.duration_ms * 1e-3 * self.bit_clock_hz) <= 1000:
            raise ValueError(f"duration_ms = {self.duration_ms} is not 1 to 1000 samples of bit_clock_hz = {self.bit_clock_hz}")

    @property
    def samples(self) -> int:
        """Drive words in one emission."""
        return round(self.duration_ms * 1e-3 * self.bit_clock_hz)

    @property
    def bit_period_s(self) -> float:
        """Time for which one drive word is output, in s."""
        return 1 / self.bit_clock_hz

    @property
    def duration_s(self) -> float:
        """T: one emission, in s."""
        return self.samples / self.bit_clock_hz


class Bank(Record, frozen=True):
    """How the board's bank of precomputed waveforms is built and used.

    Attributes
    ----------
    pitch_mm
        Distance of the bank's cells.
    snap_mm
        A single finger at most this far from a cell's centre plays that cell without interpolation.
    """

    pitch_mm: Annotated[float, Meta(ge=0.5, le=50)]
    snap_mm: NotNegative


class Limits(Record, frozen=True):
    """Limits of what the panel plays, and the resistor ratings they follow from. The FPGA enforces those of time and edges.

    Attributes
    ----------
    heartbeat_timeout_ms
        The FPGA switches its outputs off when the host was silent for this long.
    ramp_ms
        Time in which outputs ramp up on arming and down on disarming.
    max_duty
        Largest share of time with emissions.
    duty_budget_ms
        Emission time that may run ahead of `max_duty`.
    longest_emission_ms
        Longest single emission.
    hv_settle_us
        From switching the supply on (hv_enable) to the first edge of a ramp.
    min_pulse_us
        Shortest pulse of an output; at most one sample of the waveform.
    max_channel_edge_rate_hz
        Edges a second of one channel that the FPGA allows.
    max_total_edge_rate_hz
        Edges a second of all channels together that the FPGA allows; protects the supply.
    max_edge_rate_hz
        Largest edge rate of a channel within any waveform of the bank; a bank with more is not built.
    resistor_rating_w
        Power rating of a stage's resistor.
    derating
        Share of that rating that may be used.
    """

    heartbeat_timeout_ms: Annotated[float, Meta(ge=1, le=250)]
    ramp_ms: Annotated[float, Meta(gt=0, le=100)]
    max_duty: Share
    duty_budget_ms: Annotated[float, Meta(ge=20, le=1000)]
    longest_emission_ms: Annotated[float, Meta(gt=0, le=10)]
    hv_settle_us: Annotated[float, Meta(ge=1, le=100e3)]
    min_pulse_us: Annotated[float, Meta(ge=0.4, le=10)]
    max_channel_edge_rate_hz: Annotated[float, Meta(gt=0, le=500e3)]
    max_total_edge_rate_hz: Annotated[float, Meta(gt=0, le=16e6)]
    max_edge_rate_hz: Positive
    resistor_rating_w: Annotated[float, Meta(gt=0, le=100)]
    derating: Share

    @property
    def arming_s(self) -> float:
        """From ARM to the idle levels, in s."""
        return self.hv_settle_us * 1e-6 + self.ramp_ms * 1e-3


class Board(Record, frozen=True):
    """One panel: the whole board.toml. Names of scenes and recordings are relative to its folder.

    Attributes
    ----------
    name
        Name of the board: lower case letters, digits, - and _.
    scene
        Scene that is played unless another is asked for: a name beside board.toml, or a path.
    plate
        The plate.
    actuators
        The piezo patches; each channel at most once, each patch on the plate.
    driver
        The driver stages.
    waveform
        The waveform of one emission.
    bank
        The bank of precomputed waveforms.
    touch
        The touch panel.
    link
        The link to the FPGA.
    limits
        Limits.
    temperature
        Left out: the plate is taken to be as warm as the bank assumes.
    realtime
        Left out: the defaults.
    application_socket
        Left out: there is no socket.
    folder
        Folder of the board.toml; set on reading, not a key of the file.
    """

    name: Annotated[str, Meta(pattern="^[a-z0-9][a-z0-9_-]{0,63}$")]
    scene: str
    plate: Plate
    actuators: tuple[Actuator, ...]
    driver: Driver
    waveform: Waveform
    bank: Bank
    touch: Touch
    link: LinkSettings
    limits: Limits
    temperature: Temperature | None = None
    realtime: Realtime = Realtime()
    application_socket: ApplicationSocket | None = None
    folder: Path = msgspec.field(default_factory=Path)

    def __post_init__(self) -> None:
        if not 1 <= len(self.actuators) <= CHANNELS:
            raise ValueError(f"actuators are {len(self.actuators)}; a board has 1 to {CHANNELS} channels")
        channels = [a.channel for a in self.actuators]
        for index, a in enumerate(self.actuators):
            if a.channel in channels[:index]:
                raise ValueError(
                    f"actuators[{index}].channel = {a.channel} is taken by actuators[{channels.index(a.channel)}] already"
                )
            half = a.size_mm / 2
            for axis, value, extent in (("x_mm", a.x_mm, self.plate.length_mm), ("y_mm", a.y_mm, self.plate.width_mm)):
                if not half <= value <= extent - half:
                    raise ValueError(f"actuators[{index}].{axis} = {value} puts the patch off the plate (0 to {extent} mm)")

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
    def is_the_systems(self) -> bool:
        """Whether its folder is in /etc, where the service looks for its board."""
        return Path(os.path.abspath(self.folder)).parent.resolve() == SYSTEM_BOARDS.resolve()  # noqa: PTH100

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
        """SHA-256 of the tables that a bank is computed from: plate, actuators, driver, waveform."""
        tables = (self.plate, self.actuators, self.driver, self.waveform)
        return hashlib.sha256(msgspec.json.encode(tables, order="deterministic")).digest()


def load_board(path: Path) -> Board:
    """Read and check a board.toml.

    Parameters
    ----------
    path : Path
        The file, or the folder that holds it.

    Raises
    ------
    ConfigError
        Naming file, key and value.
    """
    file = path / "board.toml" if path.is_dir() else path
    board = load_toml(file, Board)
    if board.link.clock_hz < MIN_BIT_TICKS * board.waveform.bit_clock_hz:
        raise ConfigError(
            f"{file}: waveform.bit_clock_hz = {board.waveform.bit_clock_hz} is above"
            f" a {MIN_BIT_TICKS}th of link.clock_hz = {board.link.clock_hz}"
        )
    if board.limits.min_pulse_us * 1e-6 * board.waveform.bit_clock_hz > 1:
        raise ConfigError(
            f"{file}: limits.min_pulse_us = {board.limits.min_pulse_us:g} is longer than a drive word,"
            f" {1e6 / board.waveform.bit_clock_hz:g} us at waveform.bit_clock_hz = {board.waveform.bit_clock_hz}"
        )
    if board.waveform.duration_ms > board.limits.longest_emission_ms:
        raise ConfigError(
            f"{file}: waveform.duration_ms = {board.waveform.duration_ms:g} is longer than"
            f" limits.longest_emission_ms = {board.limits.longest_emission_ms:g}"
        )
    frame_ms = MAX_FRAME_BYTES * 8 / board.link.sck_hz * 1e3
    if frame_ms > board.limits.heartbeat_timeout_ms / 2:
        raise ConfigError(
            f"{file}: limits.heartbeat_timeout_ms = {board.limits.heartbeat_timeout_ms:g} is less than twice the {frame_ms:.3g} ms"
            f" that one frame takes at link.sck_hz = {board.link.sck_hz}"
        )
    return msgspec.structs.replace(board, folder=file.parent)


def simulated(board: Board) -> Board:
    """The same board with simulated gateware instead of its FPGA."""
    return msgspec.structs.replace(board, link=msgspec.structs.replace(board.link, kind="simulated"))


def find_board(name_or_path: str) -> Path:
    """Folder of a board.

    Parameters
    ----------
    name_or_path : str
        Path of a folder or of its board.toml; else a name, looked up in /etc, the source tree and the installed data.

    Raises
    ------
    ConfigError
        If there is no such board; the message lists those that exist.
    """
    given = Path(name_or_path)
    if given.is_file() and given.suffix == ".toml":
        return given.parent
    if (given / "board.toml").is_file():
        return given
    places = board_places()
    for place in places:
        if (place / name_or_path / "board.toml").is_file():
            return place / name_or_path
    known = sorted({file.parent.name for place in places for file in place.glob("*/board.toml")})
    raise ConfigError(f"board {name_or_path!r} not found; there are: {', '.join(known) or 'none'} (or a folder with a board.toml)")


def board_places() -> list[Path]:
    """Folders in which boards are looked up by name."""
    return [SYSTEM_BOARDS, data_folder("boards")]


def data_folder(room: str) -> Path:
    """Folder of `boards`, `fpga_rtl` or `systemd`: in the source tree, else below share/ of the installation."""
    beside = Path(__file__).resolve().parent.parent.parent / room
    if beside.is_dir() and (beside.parent / "pyproject.toml").is_file():
        return beside
    for prefix in (sysconfig.get_path("data"), sys.prefix, "/usr"):
        folder = Path(prefix) / "share" / "haptic-panel" / room
        if folder.is_dir():
            return folder
    return beside
