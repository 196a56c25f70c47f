"""The GPIO lines between host and FPGA, or several: trigger and run permit (outputs), configured (inputs).

libgpiod requests the lines and drives the permit. The trigger, once for every emission, is driven by the kernel's own call (Linux,
include/uapi/linux/gpio.h) with arguments made once: a third of the instructions.
"""

from __future__ import annotations

import contextlib
import fcntl
import struct
from collections.abc import Callable
from typing import Final

import gpiod
from gpiod.line import Direction, Value

from controller.device.board.devices import LinkSettings
from controller.device.board.gpio_chip import request_lines
from controller.errors import LinkError

CONSUMER = "haptic-panel"
SET_VALUES: Final = 0xC010B40F  # GPIO_V2_LINE_SET_VALUES_IOCTL
LINE_VALUES: Final = struct.Struct("=QQ")  # struct gpio_v2_line_values: values, and which lines they are for; bits as requested


class GpioLines:
    """Trigger, run permit and `configured` of one panel, held until `close`, which withdraws the permit.

    Permit and configured are optional. The permit is not given before `begin`. Raises LinkError if the chip or a line is absent or
    held by another program, or two lines are the same.
    """

    def __init__(self, settings: LinkSettings, now_s: Callable[[], float]) -> None:
        self._now_s = now_s
        self._trigger = settings.trigger_line
        self._configured = settings.configured_lines
        self._permit = settings.permit_line
        self._failed: set[str] = set()  # devices of FPGAs that nothing else may reach
        given = [line for line in (self._trigger, *self._configured, self._permit) if line]
        if len(set(given)) < len(given):  # a trigger that takes the permit away, or gives it
            raise LinkError(
                f"trigger, configured and permit have to be lines of their own; given are {', '.join(map(repr, given))}"
            )
        out = gpiod.LineSettings(direction=Direction.OUTPUT, output_value=Value.INACTIVE)
        lines = {name: out for name in (self._trigger, self._permit) if name}
        lines |= dict.fromkeys(self._configured, gpiod.LineSettings(direction=Direction.INPUT))
        self._request, self._numbers = request_lines(settings.gpio_chip, lines, CONSUMER, LinkError)
        self._fd: int = self._request.fd
        bit = 1 << self._request.offsets.index(self._numbers[self._trigger])
        self._rise, self._fall = bytearray(LINE_VALUES.pack(bit, bit)), bytearray(LINE_VALUES.pack(0, bit))

    def begin(self) -> None:
        """Give the permit; raises LinkError if an FPGA is not configured, or a line fails."""
        for line in self._configured:
            if not self._high(line):
                raise LinkError(
                    f"the FPGA is not configured: its line {line!r} is low; load the gateware, or look at its supply and its clock"
                )
        self.permit(given=True)

    def failed(self, device: str) -> None:
        """Withdraw the permit until messages to this device succeed again."""
        self._failed.add(device)
        with contextlib.suppress(LinkError):
            self.permit(given=False)

    def works(self, device: str) -> None:
        """Give the permit again once no device is left that has failed; raises LinkError if the line fails."""
        self._failed.discard(device)
        if not self._failed:
            self.permit(given=True)

    def pulse(self) -> float:
        """Pulse the trigger line: two system calls, much longer than the 4 clocks that the gateware needs.

        Returns the loop's clock, read directly after the rising edge. Raises LinkError if the line fails.
        """
        try:
            fcntl.ioctl(self._fd, SET_VALUES, self._rise)  # a bytearray: anything else is first tried as one, and copied twice
            edge_s = self._now_s()
            fcntl.ioctl(self._fd, SET_VALUES, self._fall)
        except OSError as error:
            raise _failure("trigger", self._trigger, error) from error
        return edge_s

    def permit(self, *, given: bool) -> None:
        """Give (`given`) or withdraw the run permit, if the board has a line for it; raises LinkError if the line fails."""
        if self._permit:
            try:
                self._request.set_value(self._numbers[self._permit], Value.ACTIVE if given else Value.INACTIVE)
            except OSError as error:
                raise _failure("permit", self._permit, error) from error

    def configured(self) -> bool:
        """Whether each FPGA is configured and out of reset; True if the board has no such line.

        Raises LinkError if the line fails.
        """
        return all(self._high(line) for line in self._configured)

    def _high(self, line: str) -> bool:
        try:
            return bool(self._request.get_value(self._numbers[line]) is Value.ACTIVE)
        except OSError as error:
            raise _failure("configured", line, error) from error

    def close(self) -> None:
        """Withdraw the permit and release the lines, if that was not done before."""
        if self._fd < 0:
            return
        try:
            self.permit(given=False)
        except LinkError:
            pass  # a chip that was removed drives nothing: the permit is pulled down
        finally:
            self._fd = -1  # the number may be another file's soon
            self._request.release()


def _failure(role: str, line: str, error: OSError) -> LinkError:
    return LinkError(f"the {role} line {line!r} failed ({error.strerror}): was its GPIO chip removed?")
