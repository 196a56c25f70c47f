"""`measurement.toml`: what was played, what was recorded, in which unit, and where the records lie. Described in README.md."""

import json
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from string import Formatter
from typing import Annotated, Literal, Self

import msgspec
from msgspec import Meta

from controller.device.board.board import Board
from controller.device.board.panel import CHANNELS, FPGAS_MAX
from controller.device.board.records import NotNegative, Positive, Record, load_toml
from controller.errors import CalibrationError, ConfigError

NAME = "measurement.toml"
FORMATS = (".npy", ".npz", ".wav", ".uff", ".unv")
FIELDS = {"point", "emission", "channel", "repetition"}

Hz = Annotated[float, Meta(ge=1e3, le=1e9)]
Channel = Annotated[int, Meta(ge=0, lt=CHANNELS * FPGAS_MAX)]
Channels = Annotated[tuple[Channel, ...], Meta(min_length=1, max_length=4096)]
Word = Annotated[int, Meta(ge=0, lt=1 << CHANNELS)]
Words = Annotated[tuple[Word, ...], Meta(min_length=2, max_length=FPGAS_MAX)]
Quantity = Literal["m", "m/s", "m/s^2"]


class WordsDrive(Record, frozen=True, tag_field="kind", tag="words"):
    """Drive words as they were played: all channels at once, or one at a time where only its bit changes."""

    # .npy of uint32, (emission, word) or (word,): bit q is channel q; of several FPGAs (emission, word, FPGA) or (word, FPGA)
    file: str
    bit_clock_hz: Hz  # words a second
    supply_v: Positive  # a bit that is set is this voltage, one that is not is 0 V
    idle_word: Word | Words = 0  # levels before and after an emission; of several FPGAs a list, one word of each

    @classmethod
    def of(cls, board: Board) -> Self:
        """What a board plays, in the file `drive.npy`."""
        idle = tuple(one.idle_word for one in board.fpga_boards)
        return cls(
            file="drive.npy",
            bit_clock_hz=board.waveform.bit_clock_hz,
            supply_v=board.driver.supply_v,
            idle_word=idle if board.link.fpga else idle[0],
        )


class SweepDrive(Record, frozen=True, tag_field="kind", tag="sweep"):
    """A swept sine, amplitude_v sin(phase) from phase 0; 0 V before and after."""

    start_hz: Positive  # start_hz, stop_hz: first and last frequency
    stop_hz: Positive
    duration_ms: Annotated[float, Meta(gt=0, le=10e3)]  # length
    amplitude_v: Positive  # amplitude
    channels: Channels  # channel of each emission
    spacing: Literal["exponential", "linear"] = "exponential"  # how the frequency rises: `exponential` or `linear` in time
    fade_ms: NotNegative = 0.0  # raised-cosine rise and fall of the amplitude

    def __post_init__(self) -> None:
        if self.start_hz == self.stop_hz:
            raise ValueError(f"start_hz and stop_hz are both {self.start_hz:g}: a sweep goes from one frequency to another")
        if 2 * self.fade_ms > self.duration_ms:
            raise ValueError(f"fade_ms = {self.fade_ms:g} twice is longer than duration_ms = {self.duration_ms:g}")


class SamplesDrive(Record, frozen=True, tag_field="kind", tag="samples"):
    """Any drive as samples in V, each held until the next; 0 V before and after."""

    file: str  # .npy, (sample,) for all emissions or (emission, sample), in V
    rate_hz: Hz  # samples a second
    channels: Channels  # channel of each emission


class ImpulsesDrive(Record, frozen=True, tag_field="kind", tag="impulses"):
    """One pulse of one bit period."""

    bit_clock_hz: Hz  # 1 / length of the pulse
    supply_v: Positive  # its height
    channels: Channels  # channel of each emission


DriveTable = WordsDrive | SweepDrive | SamplesDrive | ImpulsesDrive


class RecordsTable(Record, frozen=True):
    """Where the records lie and what their numbers mean."""

    # Name of a file with everything, or of many with the fields {point}, {emission} or {channel}, {repetition}; emissions and
    # repetitions are counted from 0. What no field names are axes of the file's array: point, emission, repetition, sample
    files: str
    unit: Literal["m", "m/s", "m/s^2", "V"]  # of the samples
    # v_per_m, v_per_m_s, v_per_m_s2: with unit V one of these: what the sensor gives for a displacement, a velocity or an
    # acceleration
    v_per_m: Positive | None = None
    v_per_m_s: Positive | None = None
    v_per_m_s2: Positive | None = None
    # Of what stands on the plate; divided out. Left out: found from the waves, and divided out if it is surely not nil
    sensor_mass_mg: NotNegative | None = None
    full_scale: Positive | None = None  # of WAV files and of whole numbers: what the largest number stands for, in `unit`
    track: Annotated[int, Meta(ge=1, le=64)] = 1  # of WAV files with several: which, counted from 1
    repetitions: Annotated[int, Meta(ge=1, le=10_000)] = 1  # how often each emission was played
    # Records that run through: from the start of one repetition to that of the next. Emissions follow each other, each with all
    # its repetitions. Left out: each repetition is a record of its own
    period_ms: Positive | None = None
    # Time of a record's first sample after the start of the first drive word; below 0 where the record begins earlier. Left
    # out: found from the first waves that arrive
    first_sample_us: Annotated[float, Meta(ge=-1e6, le=1e6)] | None = None

    def __post_init__(self) -> None:
        given = [name for name in ("v_per_m", "v_per_m_s", "v_per_m_s2") if getattr(self, name) is not None]
        if self.unit == "V" and len(given) != 1:
            raise ValueError("unit = 'V' needs one of v_per_m, v_per_m_s, v_per_m_s2: the sensitivity of the sensor")
        if self.unit != "V" and given:
            raise ValueError(f"{given[0]} is of use with unit = 'V'; the records are in {self.unit}")
        fields = self.fields
        if unknown := fields - FIELDS:
            raise ValueError(f"files = {self.files!r}: unknown field {{{min(unknown)}}}; there are {', '.join(sorted(FIELDS))}")
        if {"emission", "channel"} <= fields:
            raise ValueError(f"files = {self.files!r}: {{emission}} or {{channel}}, not both")
        if self.period_ms is not None and fields - {"point"}:
            raise ValueError(f"files = {self.files!r}: with period_ms a record holds all emissions; the only field is {{point}}")
        if PurePosixPath(self.files).suffix.lower() not in FORMATS:
            raise ValueError(f"files = {self.files!r}: a file of records ends with one of {', '.join(FORMATS)}")

    @property
    def fields(self) -> set[str]:
        """Names in braces."""
        try:
            return {name for _, name, spec, how in Formatter().parse(self.files) if name is not None and not spec and not how}
        except ValueError as error:
            raise ValueError(f"files = {self.files!r}: {error}") from None

    @property
    def quantity(self) -> tuple[Quantity, float]:
        """What was measured, and how much of it one `unit` of the records is."""
        for of, volts in (("m", self.v_per_m), ("m/s", self.v_per_m_s), ("m/s^2", self.v_per_m_s2)):
            if volts is not None:
                return of, 1 / volts  # type: ignore[return-value]
        assert self.unit != "V"
        return self.unit, 1.0


class MeasurementFile(Record, frozen=True):
    """The whole measurement.toml."""

    # When it was measured, ISO 8601
    date: Annotated[str, Meta(pattern=r"^\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d(\.\d+)?)?(Z|[+-]\d\d:\d\d)?)?\Z")]
    sample_rate_hz: Hz  # of the records, as the recorder states it
    records: RecordsTable  # the records
    drive: DriveTable  # what was played
    temperature_c: Annotated[float, Meta(ge=-50, le=150)] | None = None  # of the plate
    # `board digest` of the board that was measured, in hex; `haptic-panel calibrate check` warns where it differs
    board_sha256: Annotated[str, Meta(pattern=r"^[0-9a-f]{64}\Z")] | None = None
    # Which panel was measured: `panel_identity` of its computer. Left out: unknown, and a bank from it states no lower bound
    panel: Annotated[str, Meta(pattern=r"^[0-9a-f]{16}\Z")] | None = None
    points: str | None = None  # CSV file with the columns point, x_mm, y_mm. Left out: the points are in the file of the records

    def files(self, point: str, emissions: int, repetitions: int) -> Iterator[tuple[int | None, int | None, str]]:
        """Names of the files of a point, in the order of emission and repetition, None where a file holds all of them."""
        fields, channels = self.records.fields, getattr(self.drive, "channels", ())
        for emission in range(emissions) if fields & {"emission", "channel"} else (None,):
            for repetition in range(repetitions) if "repetition" in fields else (None,):
                channel = channels[emission] if channels and emission is not None else None
                name = self.records.files.format(point=point, emission=emission, channel=channel, repetition=repetition)
                yield emission, repetition, name


def read_settings(folder: Path) -> MeasurementFile:
    """Read the `measurement.toml` of a folder.

    Raises CalibrationError, naming file, key and value; also for names of files that lead out of the folder.
    """
    file = folder / NAME
    try:
        settings = load_toml(file, MeasurementFile)
    except ConfigError as error:
        hint = "" if folder.is_dir() else ": give the folder of a measurement"
        raise CalibrationError(f"{error}{hint}") from error
    drive_file = getattr(settings.drive, "file", None)
    for key, name in (("records.files", settings.records.files), ("points", settings.points), ("drive.file", drive_file)):
        parts = PurePosixPath(name or "x")
        if name == "" or parts.is_absolute() or ".." in parts.parts or "\0" in str(parts):
            raise CalibrationError(f"{file}: {key} = {name!r}: must be the name of a file in the folder of the measurement")
    drive, period_ms = settings.drive, settings.records.period_ms
    if isinstance(drive, SweepDrive) and period_ms is not None and drive.duration_ms > period_ms:
        raise CalibrationError(
            f"{file}: drive.duration_ms = {drive.duration_ms:g} is longer than records.period_ms = {period_ms:g}: each sweep"
            " would run into the record of the next"
        )
    if "channel" in settings.records.fields:
        channels = getattr(settings.drive, "channels", None)
        if channels is None:
            raise CalibrationError(f"{file}: records.files: drive words have an {{emission}}, not one {{channel}}")
        if len(set(channels)) != len(channels):
            raise CalibrationError(f"{file}: drive.channels has a channel twice: name the files by {{emission}}")
    return settings


def write_settings(folder: Path, settings: MeasurementFile) -> None:
    """Write the `measurement.toml` of a folder; raises CalibrationError if it cannot be written."""
    tables = msgspec.to_builtins(settings)
    try:
        (folder / NAME).write_text("\n".join(_toml_lines(tables)) + "\n", encoding="utf-8")
    except OSError as error:
        raise CalibrationError(f"{folder / NAME}: cannot be written ({error.strerror})") from error


def _toml_lines(tables: dict[str, object]) -> Iterator[str]:
    """Keys, then tables one deep; texts, numbers and lists of them are written as in JSON."""
    for key, value in tables.items():
        if value is not None and not isinstance(value, dict):
            yield f"{key} = {json.dumps(value, ensure_ascii=False)}"
    for key, value in tables.items():
        if isinstance(value, dict):
            yield f"\n[{key}]"
            yield from _toml_lines(value)
