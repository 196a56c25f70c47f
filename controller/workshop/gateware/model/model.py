"""The gateware as a model: the same bits at the same tick as the Verilog, going from change to change.

Ticks are FPGA clocks since reset was released. An input that changes at tick t is sampled by the clock edge that ends tick t;
`haptic_core.v` says through how many registers it then passes.
"""

from controller.device.fpga.build_parameters import BuildParameters
from controller.device.fpga.capture import Capture
from controller.device.fpga.frames import ECHO_DELAY_BYTES, FRAME_BYTES, HEADER
from controller.device.fpga.registers import FILTER_TICKS, FrameType
from controller.device.fpga.status import Status, pack_status
from controller.workshop.gateware.gateware import Permit, Port
from controller.workshop.gateware.model.core import Core
from controller.workshop.gateware.model.decoder import decode
from controller.workshop.gateware.model.events import EventKind, Events, GatewareEvent
from controller.workshop.gateware.model.gate import PIN_TICKS
from controller.workshop.gateware.model.lines import Lines
from controller.workshop.gateware.model.uart import BYTE_TO_PULSE_TICKS
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS, InputTiming, sck_rise_tick

INPUT_TICKS = 2  # two flip-flops: an edge of a pin at t is seen in the state of t + 2
TRIGGER_TICKS = INPUT_TICKS + FILTER_TICKS - 1  # until the pin has been seen high for long enough by the glitch filter
EXECUTE_TICKS = 4  # from the rise of chip select to the tick in which its frame is executed
LANDED_TICKS = 4  # from the rise of SCK that ends a word of a LOAD to the tick in which it is written
EMPTY_TICKS = 2  # from the rise of chip select to the last busy tick of an assertion without any bit
RATE_TICKS = 1  # that the measured length of a LOAD exceeds the time between the edges of chip select


class GatewareModel:
    """`haptic_core.v` with its pins: a `Gateware`.

    With `lines`, captures also contain every change of MISO and of the UART's transmit line.
    """

    def __init__(self, parameters: BuildParameters, *, lines: bool = False) -> None:
        self._events = Events()
        self._core = Core(parameters, self._events)
        self._commands = self._core.commands
        self._gate = self._commands.gate
        self._uart = self._core.uart
        self._timing = InputTiming()
        self._permit_pins = dict.fromkeys(Permit, False)
        self._lines = Lines(record_frames=lines)

    @property
    def now(self) -> int:
        """The current tick."""
        return self._events.now

    @property
    def fault(self) -> bool:
        """Whether a fault is latched."""
        return bool(self._gate.faults)

    def advance(self, tick: int) -> None:
        """Advance to `tick`; does nothing if that has passed."""
        while (change := self.next_change()) is not None and change < tick:
            self._lines.settle(change)
            self._core.step(change)
            self._events.now = change + 1
            self._lines.note(self._events.now, fault=bool(self._gate.faults), waiting_from=self._core.waiting_from())
            self._gate.limits.settle(change - PIN_TICKS)
        self._events.now = max(self._events.now, tick)

    def next_change(self) -> int | None:
        """Next tick in which something happens without further input; None if nothing will."""
        return self._core.next_change()

    def status(self, port: Port = Port.SPI) -> Status:
        """The status with which the link `port` is answered if its frame begins now."""
        return self._core.status(port)

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """Set the permit pin `which` to `level` at `tick`; both are low at tick 0."""
        self._events.add(GatewareEvent(tick + INPUT_TICKS - 1, EventKind.PERMIT, which, level))
        if level != self._permit_pins[which]:
            self._permit_pins[which] = level
            self._events.add(GatewareEvent(tick + INPUT_TICKS, EventKind.PERMIT_NOTED))

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """Raise the trigger pin at `tick` for `high_ticks`."""
        self._timing.trigger(tick, high_ticks)
        self._commands.telemetry.trigger_pin.append((tick + INPUT_TICKS, tick + INPUT_TICKS + high_ticks))
        if high_ticks >= FILTER_TICKS:
            self._events.add(GatewareEvent(tick + TRIGGER_TICKS, EventKind.TRIGGER))

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """Exchange one frame; parameters as in `Gateware.exchange`.

        Raises ValueError if it begins in the past, or its timing is not what the pins allow.
        """
        if select_tick + INPUT_TICKS < self._events.now:
            raise ValueError(f"a frame for tick {select_tick} is in the past: the model is at tick {self._events.now}")
        self._timing.frame(select_tick, release_tick, len(mosi))
        self.advance(select_tick + INPUT_TICKS)
        answer = bytearray(max(FRAME_BYTES, len(miso)) + 1)
        pack_status(answer, 0, self.status())
        sent = memoryview(mosi).cast("B")
        if len(sent) >= FRAME_BYTES and sent[2] == FrameType.TEST:
            answer[FRAME_BYTES : len(sent) + 1] = sent[FRAME_BYTES - ECHO_DELAY_BYTES : len(sent) + 1 - ECHO_DELAY_BYTES]
        miso[:] = answer[: len(miso)]
        self._lines.exchange(select_tick, release_tick, answer, len(miso))
        self._core.spi_until = release_tick + (EXECUTE_TICKS if len(sent) else EMPTY_TICKS)
        self._core.defer_uart()
        if not len(sent):
            return
        frame = decode(sent)
        commands = self._commands
        busy, live = commands.landing_busy, commands.landing_live
        if frame.loaded_words:
            written = sck_rise_tick(select_tick, release_tick, len(sent), 8 * (HEADER.size + 4) - 1) + LANDED_TICKS
            self._events.add(GatewareEvent(written, EventKind.LANDING, frame=frame, landing_busy=busy, landing_live=live))
        ticks = release_tick - select_tick + RATE_TICKS
        self._events.add(
            GatewareEvent(
                release_tick + EXECUTE_TICKS,
                EventKind.FRAME,
                frame=frame,
                ticks=ticks,
                landing_busy=busy,
                landing_live=live,
                queue_full=self._commands.queue.full,
            )
        )

    def uart(self, tick: int, wire: bytes) -> int:
        """Send bytes (COBS-encoded frames) over the UART, back to back from the first start bit at `tick` on.

        Returns the tick in which the last stop bit ends.
        """
        timing = self._uart.timing
        for number, byte in enumerate(wire):
            received = timing.received_tick(timing.bit_tick(tick, number, 0))
            self._events.add(GatewareEvent(received + BYTE_TO_PULSE_TICKS, EventKind.UART_BYTE, byte=byte))
        return timing.bit_tick(tick, len(wire), 0)

    def take_capture(self) -> Capture:
        """Changes of the output pins since the last capture, up to now."""
        capture = self._gate.pins.take(self._events.now)
        self._lines.settle(self._events.now)
        return self._lines.take(capture, self._events.now, self._uart.take_tx(self._events.now))
