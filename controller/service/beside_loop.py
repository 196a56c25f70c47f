"""The processes beside the loop: `python -m controller.service.beside_loop panel|thermometer PRIORITY SETTINGS` (JSON).

Started by the service (`worker`); standard input is the way to it. They end when it does, and by no signal that is
meant for it: a service manager sends those to all of a service's processes.
"""

from __future__ import annotations

import signal
import socket
import sys

import msgspec

from controller.board.devices import Ft5x06Touch, Gt911Touch, I2cTouch, Realtime, Temperature
from controller.service.systemd import enter_realtime
from controller.service.temperature import sensor_of, serve_sensor
from controller.touch.event_reader import EventReader
from controller.touch.panel_process import serve_panel


def open_i2c_panel(settings: I2cTouch) -> EventReader:
    """Driver of a touch panel on an I2C bus.

    Raises
    ------
    TouchError
        If it is not there.
    """
    if isinstance(settings, Ft5x06Touch):
        from controller.touch.ft5x06 import open_ft5x06

        return open_ft5x06(settings)
    from controller.touch.gt911 import open_gt911

    assert isinstance(settings, Gt911Touch)
    return open_gt911(settings)


def main(arguments: list[str]) -> None:
    """Serve until the loop has gone."""
    what, priority, settings = arguments
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    enter_realtime(Realtime(priority=int(priority), lock_memory=int(priority) > 0))  # what is refused, the loop has told
    with socket.socket(fileno=sys.stdin.fileno()) as loop:
        try:
            if what == "panel":
                touch = msgspec.json.decode(settings, type=Ft5x06Touch | Gt911Touch)
                serve_panel(lambda: open_i2c_panel(touch), loop)
            else:
                serve_sensor(sensor_of(msgspec.json.decode(settings, type=Temperature)), loop)
        except (BrokenPipeError, ConnectionResetError):
            return  # the loop has gone


if __name__ == "__main__":
    main(sys.argv[1:])
