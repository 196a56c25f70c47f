"""The FPGA's own wires beside SPI: trigger out, run permit out, configured in."""

from __future__ import annotations

from collections.abc import Callable

import gpiod
from gpiod.line import Direction, Value

from controller.board.devices import LinkSettings
from controller.board.gpio_chip import request_lines
from controller.errors import LinkError

CONSUMER = "haptic-panel"


class GpioLines:
    """Trigger, run permit and `configured` of one panel; the permit is given by `permit` and taken away by `close`.

    Parameters
    ----------
    settings : LinkSettings
        Label of the chip and names of the lines; permit and configured may be left out.
    now_s : callable
        The loop's clock.

    Raises
    ------
    LinkError
        If the chip or a line is absent or held by another program.
    """

    def __init__(self, settings: LinkSettings, now_s: Callable[[], float]) -> None:
        self._now_s = now_s
        self._trigger = settings.trigger_line
        self._configured = settings.configured_line
        self._permit = settings.permit_line
        out = gpiod.LineSettings(direction=Direction.OUTPUT, output_value=Value.INACTIVE)
        lines = {name: out for name in (self._trigger, self._permit) if name}
        if self._configured:
            lines[self._configured] = gpiod.LineSettings(direction=Direction.INPUT)
        self._request = request_lines(settings.gpio_chip, lines, CONSUMER, LinkError)

    def pulse(self) -> float:
        """Raise the trigger and let it fall again: two system calls, far longer than the gateware's 4 clocks.

        Returns
        -------
        float
            Time of the rise on the loop's clock, taken directly after it, in s.
        """
        try:
            self._request.set_value(self._trigger, Value.ACTIVE)
            edge_s = self._now_s()
            self._request.set_value(self._trigger, Value.INACTIVE)
        except OSError as error:
            raise LinkError(f"the trigger line {self._trigger!r} failed ({error.strerror}): is its GPIO chip gone?") from error
        return edge_s

    def permit(self, given: bool) -> None:
        """Give or take away the run permit, where this host has a line for it."""
        if self._permit:
            try:
                self._request.set_value(self._permit, Value.ACTIVE if given else Value.INACTIVE)
            except OSError as error:
                raise LinkError(f"the permit line {self._permit!r} failed ({error.strerror}): is its GPIO chip gone?") from error

    def configured(self) -> bool:
        """Whether the FPGA is configured and out of reset; True where there is no line that says so."""
        if not self._configured:
            return True
        try:
            return bool(self._request.get_value(self._configured) is Value.ACTIVE)
        except OSError as error:
            raise LinkError(f"line {self._configured!r} (configured) failed ({error.strerror}): is its GPIO chip gone?") from error

    def close(self) -> None:
        """Permit off, trigger low, lines free for others."""
        try:
            self.permit(False)
        except LinkError:
            pass  # a chip that is gone drives nothing any more: the permit is pulled down
        finally:
            self._request.release()
