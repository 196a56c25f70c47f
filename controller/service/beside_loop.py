"""Helper processes of the service: `python -m controller.service.beside_loop panel|thermometer PRIORITY SETTINGS` (JSON).

The service starts them (`worker`); their standard input is a socket to it. They end when it is closed, and ignore the signals
that a service manager sends to all processes of a service.
"""

from __future__ import annotations

import signal
import socket
import sys

import msgspec

from controller.board.devices import Realtime, Temperature
from controller.board.touch_panels import Touch
from controller.service.realtime import enter_realtime
from controller.service.temperature_sensors import sensor_of, serve_sensor
from controller.touch.panel_process import serve_panel
from controller.touch.panels import open_panel


def main(arguments: list[str]) -> None:
    """Serve until the loop closes the socket."""
    what, priority, settings = arguments
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    enter_realtime(Realtime(priority=int(priority), lock_memory=int(priority) > 0))  # the loop has reported what is refused
    with socket.socket(fileno=sys.stdin.fileno()) as loop:
        try:
            if what == "panel":
                touch: Touch = msgspec.json.decode(settings, type=Touch)
                serve_panel(lambda: open_panel(touch), loop)
            else:
                serve_sensor(sensor_of(msgspec.json.decode(settings, type=Temperature)), loop)
        except (BrokenPipeError, ConnectionResetError):
            return  # the loop has gone


if __name__ == "__main__":
    main(sys.argv[1:])
