"""All that is done to the pins of simulated gateware, tick by tick: noted while it is done, kept as JSON, done again to another.

A file is {"parameters": those of `BuildParameters`, "end_tick": N, "steps": [{"do": "exchange", ...}, ...]} with its bytes in
base64; steps are in the order in which they are done. `tests/conformance` writes one of a script that fails.
"""

from pathlib import Path
from typing import Annotated, Self

import msgspec
from msgspec import Meta, Struct

from controller.device.board.validation import NO_JSON
from controller.device.fpga.build_parameters import BuildParameters
from controller.errors import ConfigError
from controller.regular_file import read_regular
from controller.workshop.gateware.gateware import Permit
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.pin_timing import TRIGGER_HIGH_TICKS
from controller.workshop.gateware.rtl_gateware import RtlGateware

SCRIPT_BYTES_MAX = 1 << 28

Simulated = GatewareModel | RtlGateware
Tick = Annotated[int, Meta(ge=0, lt=1 << 48)]


class _Step(Struct, frozen=True, tag_field="do", forbid_unknown_fields=True):
    """What is done at a tick; in a file, `do` says what."""

    tick: Tick


class PermitStep(_Step, frozen=True, tag="permit"):
    """A permit's pin goes to `level`."""

    level: bool
    which: Permit

    def perform(self, gateware: Simulated) -> None:
        """Do it."""
        gateware.permit(self.tick, level=self.level, which=self.which)


class TriggerStep(_Step, frozen=True, tag="trigger"):
    """The trigger is high for some ticks."""

    high_ticks: int

    def perform(self, gateware: Simulated) -> None:
        """Do it."""
        gateware.trigger(self.tick, self.high_ticks)


class ExchangeStep(_Step, frozen=True, tag="exchange"):
    """A frame by the SPI."""

    release_tick: Tick
    mosi: bytes

    def perform(self, gateware: Simulated) -> None:
        """Do it."""
        gateware.exchange(self.tick, self.release_tick, self.mosi, memoryview(bytearray(len(self.mosi))))


class UartStep(_Step, frozen=True, tag="uart"):
    """Bytes by the UART, back to back."""

    wire: bytes

    def perform(self, gateware: Simulated) -> None:
        """Do it."""
        gateware.uart(self.tick, self.wire)


Step = PermitStep | TriggerStep | ExchangeStep | UartStep


class InputScript(Struct, frozen=True, forbid_unknown_fields=True):
    """The whole of it."""

    parameters: BuildParameters
    end_tick: Tick
    steps: list[Step]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file; raises ConfigError if it is none, OSError if it cannot be read."""
        try:
            return msgspec.json.decode(read_regular(path, SCRIPT_BYTES_MAX, links=True), type=cls)
        except NO_JSON as error:
            raise ConfigError(f"{path}: is no script of the gateware's pins: {error}") from error

    def write(self, path: Path) -> None:
        """Write it to a file."""
        path.write_bytes(msgspec.json.encode(self))

    def perform(self, gateware: Simulated, end_tick: int | None = None) -> None:
        """Do all that begins before a tick, by default all; then advance to it.

        Raises ValueError for what the pins do not allow.
        """
        end_tick = self.end_tick if end_tick is None else end_tick
        for step in self.steps:
            if step.tick < end_tick:
                step.perform(gateware)
        gateware.advance(end_tick)


class InputRecorder(GatewareModel):
    """The model, which notes what is done to its pins."""

    def __init__(self, parameters: BuildParameters) -> None:
        super().__init__(parameters)
        self._parameters = parameters
        self._steps: list[Step] = []

    @property
    def script(self) -> InputScript:
        """All of it up to now."""
        return InputScript(self._parameters, self.now, self._steps)

    def permit(self, tick: int, *, level: bool, which: Permit = Permit.RUN) -> None:
        """As of the model."""
        self._steps.append(PermitStep(tick, level, which))
        super().permit(tick, level=level, which=which)

    def trigger(self, tick: int, high_ticks: int = TRIGGER_HIGH_TICKS) -> None:
        """As of the model."""
        self._steps.append(TriggerStep(tick, high_ticks))
        super().trigger(tick, high_ticks)

    def exchange(self, select_tick: int, release_tick: int, mosi: bytes | bytearray | memoryview, miso: memoryview) -> None:
        """As of the model."""
        self._steps.append(ExchangeStep(select_tick, release_tick, bytes(mosi)))
        super().exchange(select_tick, release_tick, mosi, miso)

    def uart(self, tick: int, wire: bytes) -> int:
        """As of the model."""
        self._steps.append(UartStep(tick, wire))
        return super().uart(tick, wire)
