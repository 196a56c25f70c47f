"""Tables of board.toml that name devices: touch panel, link to the FPGA, temperature sensor, socket, scheduling.

Devices are named by what stays the same over a restart and over kernels: paths below /dev/input/by-path or
/dev/serial/by-id, chips by label, lines by name.
"""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from controller.board.records import Positive, Record

SERIAL_BITS_PER_BYTE = 10  # 8N1
FEWEST_SCK_TICKS = 2  # of the gateware: gateware.SCK_TICKS

Address = Annotated[int, Meta(ge=0x08, le=0x77)]
Extent = Annotated[int, Meta(ge=1, le=65535)]
AxisMm = Annotated[float, Meta(ge=-1e5, le=1e5)]  # a raw axis may be many times as long as the plate
Name = Annotated[str, Meta(min_length=1)]


class TouchPanel(Record, frozen=True, kw_only=True):
    """What all touch panels have: where their axes lie on the plate, and what is known of their reports.

    A position is that of the finger `lag_ms` before its report; contacts wider than `max_size_mm` are palms;
    a contact is played from its `confirm_reports`th report on. Ghosts of an emission are gone `ghost_ms` after it
    (0: the panel makes none).
    """

    x_mm_from_axes: tuple[AxisMm, AxisMm, AxisMm]
    y_mm_from_axes: tuple[AxisMm, AxisMm, AxisMm]
    lag_ms: Annotated[float, Meta(ge=0, le=200)] = 0.0
    max_size_mm: Positive = 30.0
    confirm_reports: Annotated[int, Meta(ge=1, le=10)] = 1
    max_emissions_unconfirmed: Annotated[int, Meta(ge=1, le=100)] = 1
    ghost_ms: Annotated[float, Meta(ge=0, le=500)] = 30.0
    recording: str = ""  # what `run` replays on a board without devices

    @property
    def lag_s(self) -> float:
        """Time from where the finger was to its report, in s."""
        return self.lag_ms * 1e-3

    @property
    def max_size_m(self) -> float:
        """Widest contact that is a finger, in m."""
        return self.max_size_mm * 1e-3

    @property
    def ghost_s(self) -> float:
        """Time after an emission within which its ghosts have gone, in s."""
        return self.ghost_ms * 1e-3


class RecordingTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="recording"):
    """No panel: a recording is replayed."""

    ghost_ms: Annotated[float, Meta(ge=0, le=500)] = 0.0  # what was recorded does not hear what is played now


class LinuxInputTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="linux_input"):
    """A panel with a kernel driver: by a path such as /dev/input/by-path/..., or by its name."""

    device: Name
    grab: bool = False


class I2cTouch(TouchPanel, frozen=True, kw_only=True):
    """What panels on an I2C bus have; the interrupt line falls when there is a report."""

    bus: Name  # such as /dev/i2c-1
    interrupt_chip: Name  # label of the GPIO chip
    interrupt_line: Name
    reset_line: str = ""  # on the same chip; none: it is not reset by us
    width: Extent | None = None  # largest raw x and y; None: asked from the panel where it can say
    height: Extent | None = None


class Ft5x06Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="ft5x06"):
    """FocalTech FT5x06, FT6x36, and EDT modules with them, M06 included."""

    address: Address = 0x38
    width: Extent
    height: Extent


class Gt911Touch(I2cTouch, frozen=True, kw_only=True, tag_field="kind", tag="gt911"):
    """Goodix GT911 and its kin (`gt911.PRODUCTS`); which address it takes is decided by the interrupt line at reset."""

    address: Literal[0x14, 0x5D] = 0x5D


class SerialTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="serial_panel"):
    """A panel that speaks Elo SmartSet over a serial port."""

    device: Name
    baud: Annotated[int, Meta(ge=1200, le=115200)] = 9600


Touch = RecordingTouch | LinuxInputTouch | Ft5x06Touch | Gt911Touch | SerialTouch


class LinkSettings(Record, frozen=True, kw_only=True):
    """How drive words reach the FPGA."""

    kind: Literal["simulated", "serial", "spi"]
    clock_hz: Annotated[int, Meta(ge=1_000_000, le=400_000_000)]
    sck_hz: Annotated[int, Meta(ge=100_000, le=100_000_000)]
    slots: Annotated[int, Meta(ge=1, le=16)]
    device: str = ""  # serial port, or /dev/spidevB.C
    # Clock of the SPI controller, which divides it by an even number: Pi 3 400e6, Pi 4 500e6, Pi 5 200e6; none: SCK is as asked
    spi_source_hz: Annotated[int, Meta(ge=1_000_000, le=1_000_000_000)] | None = None
    baud: Annotated[int, Meta(ge=9600, le=12_000_000)] = 1_000_000
    gpio_chip: str = ""  # label of the chip with the lines below
    trigger_line: str = ""
    configured_line: str = ""  # input: high while the FPGA is configured, has its clock and is out of reset; may be left out
    permit_line: str = ""  # output: run permit given by this host while it plays; may be left out where a switch gives it

    def __post_init__(self) -> None:
        if self.sck_hz * FEWEST_SCK_TICKS > self.clock_hz:
            raise ValueError(f"sck_hz = {self.sck_hz} is above half of clock_hz = {self.clock_hz}")
        if self.kind == "serial" and not self.device:
            raise ValueError("device is missing: the serial port of the FPGA, such as /dev/ttyUSB0")
        if self.kind == "spi":
            for key, example in (("device", "/dev/spidev0.0"), ("gpio_chip", "pinctrl-bcm2711"), ("trigger_line", "GPIO25")):
                if not getattr(self, key):
                    raise ValueError(f"{key} is missing: a link of kind 'spi' needs it, such as {example!r}")

    def wire_s(self, size_bytes: int) -> float:
        """Time that bytes take on the wire, without the pauses between frames."""
        return size_bytes * (SERIAL_BITS_PER_BYTE / self.baud if self.kind == "serial" else 8 / self.sck_hz)


class Temperature(Record, frozen=True, kw_only=True):
    """A sensor of the plate's temperature, and how the plate's frequencies follow it.

    The bit clock is scaled by 1 + coefficient_per_k * (temperature - reference_c): warm glass is softer, its
    waves are slower, and the waveforms of a bank built at `reference_c` have to be played as much slower.
    """

    kind: Literal["hwmon", "lm75"]
    device: Name  # hwmon: name of the chip, or path of a temp*_input; lm75: the bus, such as /dev/i2c-1
    address: Address = 0x48  # of an LM75, TMP75 or TMP102
    reference_c: Annotated[float, Meta(ge=-40, le=100)] = 23.0
    coefficient_per_k: Annotated[float, Meta(ge=-1e-2, le=1e-2)]
    period_s: Annotated[float, Meta(ge=0.1, le=3600)] = 2.0
    lowest_c: float = -20.0  # beyond these the reading is taken for a fault of the sensor
    highest_c: float = 85.0


class Realtime(Record, frozen=True, kw_only=True):
    """What the loop asks of the kernel's scheduler; one warning where it is not permitted."""

    priority: Annotated[int, Meta(ge=0, le=98)] = 50  # of SCHED_FIFO; 0: an ordinary process
    cpu: Annotated[int, Meta(ge=0, le=1023)] | None = None  # the core to stay on
    lock_memory: bool = True


class ApplicationSocket(Record, frozen=True, kw_only=True):
    """The Unix socket through which a user interface drives the panel."""

    path: Name = "/run/haptic-panel/panel.sock"
    owner: str = ""  # empty: as the service
    group: str = ""
    mode: Annotated[str, Meta(pattern="^0?[0-7]{3}$")] = "660"
    play_group: str = ""  # empty: whoever may connect may play
    operate_group: str = ""  # who may arm, disarm and load scenes; empty: root and the service's own user only
    max_clients: Annotated[int, Meta(ge=1, le=64)] = 8
    clients_per_user: Annotated[int, Meta(ge=1, le=64)] = 4  # of a user who may play and not operate
    idle_s: Annotated[float, Meta(ge=0, le=86_400)] = 10.0  # silent for so long, a client gives way to one that finds no place
    commands_per_s: Annotated[float, Meta(ge=1, le=10_000)] = 500.0  # of one client, in the long run
    burst: Annotated[int, Meta(ge=1, le=10_000)] = 50
    max_amplitude: Annotated[float, Meta(ge=0.25, le=1)] = 1.0  # 0.25: the least that can be asked for
