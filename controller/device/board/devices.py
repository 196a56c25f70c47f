"""Tables of board.toml that name devices: link to the FPGA, temperature sensor, socket, scheduling.

Name devices by what does not change from one boot or kernel to the next: paths below /dev/input/by-path or /dev/serial/by-id,
GPIO chips by label, lines by name or, where they have none, by number.
"""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal, Self

import msgspec
from msgspec import Meta

from controller.device.board.records import Record

SERIAL_BITS_PER_BYTE = 10  # 8N1
MIN_SCK_TICKS = 2  # gateware.SCK_TICKS
MIN_AMPLITUDE: Final = 0.1  # that is composed, of the full one: within 3 % for a lone finger (waveforms/README.md)

OF_LINKS = {  # keys that a kind of link needs
    "serial": {"device": "the serial port of the FPGA, such as /dev/ttyUSB0"},
    "spi": {
        key: f"a link of kind 'spi' needs it, such as {example!r}"
        for key, example in (("device", "/dev/spidev0.0"), ("gpio_chip", "pinctrl-bcm2711"), ("trigger_line", "GPIO25"))
    },
}

Address = Annotated[int, Meta(ge=0x08, le=0x77)]
Name = Annotated[str, Meta(min_length=1)]


def divided_hz(source_hz: int, asked_hz: int) -> float:
    """Actual SCK of a controller that divides its own clock by an even number.

    Linux: spi-bcm2835.c (Pi 1 to 4), spi-dw-core.c (Pi 5).

    At most `asked_hz`, unless the largest divider is too small.
    """
    if asked_hz >= source_hz / 2:
        return source_hz / 2
    divider = -(-source_hz // asked_hz)
    return source_hz / min(divider + divider % 2, 65536)


class LinkedFpga(Record, frozen=True, kw_only=True):
    """One of several FPGAs on one clock, one trigger line and one line of run permit and faults.

    Attributes:
    device: Its own chip select, /dev/spidevB.C; of a simulated one left out.
    configured_line: Input: as `link.configured_line`, of this FPGA alone. Each FPGA has one, or none has.
    cable: What stands for `{cable}` in `gateware.load`: by what the loader knows this FPGA from the others, such as the serial
        number of its USB.
    """

    device: str = ""
    configured_line: str = ""
    cable: str = ""


class LinkSettings(Record, frozen=True, kw_only=True):
    """The link to the FPGA.

    Attributes:
    kind: `simulated`: no FPGA, its gateware is computed; `serial`: UART; `spi`: SPI and GPIO lines.
    clock_hz: Clock of the FPGA's logic.
    sck_hz: SCK that is asked for; at most half of `clock_hz`.
    slots: Waveforms that the FPGA's memory holds.
    device: Serial port, or /dev/spidevB.C; of a simulated link a file beside board.toml that says what is there of the panel, where
        it is not as board.toml says (`haptic-panel rehearse`).
    spi_source_hz: Clock of the SPI controller, which divides it by an even number: 400e6 on a Pi 3, 500e6 on a Pi 4, 200e6 on a Pi
        5; left out: SCK is taken to be as asked.
    baud: Baud rate of a serial link.
    gpio_chip: Label of the GPIO chip with the following lines, each given by its name or, where it has none of its own, by its
        number on the chip, such as "25". Where several chips have the label: the path of a udev link to the chip.
    trigger_line: Output: starts the waveform that was prepared.
    configured_line: Input: high while the FPGA is configured, has its clock and is out of reset; of several FPGAs, while all are.
        May be left out.
    permit_line: Output: run permit that this host gives while it plays; may be left out where a switch gives it.
    fpga: Two to four FPGAs, the first with channels 0 to 31, each further one with the next 32. Left out: one.
    """

    kind: Literal["simulated", "serial", "spi"]
    clock_hz: Annotated[int, Meta(ge=1_000_000, le=400_000_000)]
    sck_hz: Annotated[int, Meta(ge=100_000, le=100_000_000)]
    slots: Annotated[int, Meta(ge=1, le=16)]
    device: str = ""
    spi_source_hz: Annotated[int, Meta(ge=1_000_000, le=1_000_000_000)] | None = None
    baud: Annotated[int, Meta(ge=9600, le=12_000_000)] = 1_000_000
    gpio_chip: str = ""
    trigger_line: str = ""
    configured_line: str = ""
    permit_line: str = ""
    fpga: tuple[LinkedFpga, ...] = ()

    def __post_init__(self) -> None:
        if self.sck_hz * MIN_SCK_TICKS > self.clock_hz:
            raise ValueError(f"sck_hz = {self.sck_hz} is above half of clock_hz = {self.clock_hz}")
        for key, said in self.also_required({"kind": self.kind}).items():
            if not self.fpga or key != "device":
                missing = [] if getattr(self, key) else [key]
            else:
                missing = [f"fpga[{number}].{key}" for number, one in enumerate(self.fpga) if not one.device]
            if missing:
                raise ValueError(f"{missing[0]} is missing: {said}")

    @classmethod
    def also_required(cls, table: dict[str, Any]) -> dict[str, str]:
        """Keys that a kind of link makes required."""
        return OF_LINKS.get(str(table.get("kind")), {})

    @property
    def configured_lines(self) -> tuple[str, ...]:
        """Lines that say whether FPGAs are configured: one of all, or one of each."""
        return tuple(line for line in (self.configured_line, *(one.configured_line for one in self.fpga)) if line)

    def of_fpga(self, number: int) -> Self:
        """The link to one of several FPGAs."""
        own = self.fpga[number]
        device, configured = own.device or self.device, own.configured_line or self.configured_line
        return msgspec.structs.replace(self, device=device, configured_line=configured, fpga=())

    def wire_s(self, size_bytes: int) -> float:
        """Time that bytes take on the wire, in s, without the pauses between frames."""
        return size_bytes * (SERIAL_BITS_PER_BYTE / self.baud if self.kind == "serial" else 8 / self.sck_hz)


class Temperature(Record, frozen=True, kw_only=True):
    """A sensor of the plate's temperature, and how the waves' speed depends on it.

    The bit clock is scaled by 1 + coefficient_per_k * (temperature - reference_c): warm glass is softer and its waves slower, so
    that waveforms computed for `reference_c` have to be played as much slower.

    Attributes:
    kind: `hwmon`: a sensor with a kernel driver; `lm75`: an LM75, TMP75 or TMP102 on an I2C bus.
    device: hwmon: name of the chip, or path of a temp*_input; lm75: the bus, such as /dev/i2c-1.
    address: Address of an lm75 on the bus.
    reference_c: Temperature that the bank was built for.
    coefficient_per_k: Relative change of the bit clock per kelvin.
    period_s: Time between readings.
    lowest_c, highest_c: A reading beyond these is a fault of the sensor.
    """

    kind: Literal["hwmon", "lm75"]
    device: Name
    address: Address = 0x48
    reference_c: Annotated[float, Meta(ge=-40, le=100)] = 23.0
    coefficient_per_k: Annotated[float, Meta(ge=-1e-2, le=1e-2)]
    period_s: Annotated[float, Meta(ge=0.1, le=3600)] = 2.0
    lowest_c: float = -20.0
    highest_c: float = 85.0

    def __post_init__(self) -> None:
        if not self.lowest_c <= self.reference_c <= self.highest_c:
            raise ValueError(f"reference_c = {self.reference_c:g} is not between lowest_c and highest_c")

    def scale(self, temperature_c: float) -> float:
        """Factor of the bit clock at a temperature."""
        return 1 + self.coefficient_per_k * (temperature_c - self.reference_c)


class GatewareLoading(Record, frozen=True, kw_only=True):
    """How an FPGA is loaded that answers with another gateware than this software's, before its outputs may be on.

    Attributes:
    load: Program and arguments, without a shell; `{bitstream}` in one of them stands for the path of the file, `{cable}` for that
        of several FPGAs. It is to load the FPGA's memory, not its flash: what that holds is what a lost supply goes back to.
    bitstream: The file: in the folder `gateware` of the release that runs, else beside board.toml; of a further one `.fpga1` stands
        before `.bit`. Left out: `NAME.bit`, after the board's folder, so a copy of a board does not load the original's.
    limit_s: Longest time that it may take; then it is ended, and the FPGA refused.
    """

    load: Annotated[tuple[Annotated[str, Meta(min_length=1)], ...], Meta(min_length=1)]
    bitstream: Annotated[str, Meta(min_length=1)] | None = None
    limit_s: Annotated[float, Meta(gt=0, le=60)] = 20.0

    def __post_init__(self) -> None:
        if not any("{bitstream}" in word for word in self.load):
            raise ValueError("load names no {bitstream}: one of its arguments stands for the file")


class Realtime(Record, frozen=True, kw_only=True):
    """Scheduling of the event loop's thread; one warning where it is not permitted.

    Attributes:
    priority: Priority of SCHED_FIFO; 0: an ordinary process.
    cpu: Core to run on; left out: any.
    lock_memory: Whether to keep what the loop uses in memory.
    """

    priority: Annotated[int, Meta(ge=0, le=98)] = 50
    cpu: Annotated[int, Meta(ge=0, le=1023)] | None = None
    lock_memory: bool = True


LOOK_GROUP: Final = "haptic-look"  # made by the Debian package, for haptic-panel-metrics


class ApplicationSocket(Record, frozen=True, kw_only=True):
    """The Unix socket through which a user interface drives the panel.

    Attributes:
    path: Path of the socket.
    owner: User who owns it; empty: that of the service.
    group: Its group; empty: that of the service.
    mode: Its file mode, octal.
    play_group: Group that may play; empty: whoever may connect.
    look_group: Group that may only look: read state and figures, whatever other groups a user is in. Where there is none of the
        default's name, nobody.
    operate_group: Group that may also arm, disarm and load scenes; empty: root and the service's own user only.
    regions_group: Group that may lay regions of its own over the scene, whether it may play or not; empty: only who may operate.
    max_clients: Clients at a time.
    clients_per_user: Clients of one user who may play and not operate.
    idle_s: A client silent for this long gives way to one that finds no place.
    commands_per_s: Commands a second of one client in the long run.
    burst: Commands that a client may send at once.
    max_amplitude: Largest amplitude that a client may ask for.
    layer_regions: Regions of one client.
    layer_bytes: Length of one line with regions.
    layers_per_s: How often a second one client may replace its regions in the long run.
    """

    path: Name = "/run/haptic-panel/panel.sock"
    owner: str = ""
    group: str = ""
    mode: Annotated[str, Meta(pattern=r"^0?[0-7]{3}\Z")] = "660"
    play_group: str = ""
    operate_group: str = ""
    regions_group: str = ""
    look_group: str = LOOK_GROUP
    max_clients: Annotated[int, Meta(ge=1, le=64)] = 9
    clients_per_user: Annotated[int, Meta(ge=1, le=64)] = 5
    idle_s: Annotated[float, Meta(ge=0, le=86_400)] = 10.0
    commands_per_s: Annotated[float, Meta(ge=1, le=10_000)] = 500.0
    burst: Annotated[int, Meta(ge=1, le=10_000)] = 50
    max_amplitude: Annotated[float, Meta(ge=MIN_AMPLITUDE, le=1)] = 1.0
    layer_regions: Annotated[int, Meta(ge=1, le=1000)] = 250
    layer_bytes: Annotated[int, Meta(ge=8192, le=131_072)] = 65_536
    layers_per_s: Annotated[float, Meta(ge=0.1, le=1000)] = 30.0
