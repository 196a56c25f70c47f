"""The processes beside the loop: `python -m controller.service.beside_loop panel|thermometer PRIORITY SETTINGS` (JSON).

Started by the service (`worker`); standard input is the way to it. They end when it does, and by no signal that is
meant for it: a service manager sends those to all of a service's processes.
"""

from __future__ import annotations

import signal
import socket
import sys

import msgspec

from controller.board.devices import Realtime, Temperature, Touch
from controller.service.realtime import enter_realtime
from controller.service.temperature_sensors import sensor_of, serve_sensor
from controller.touch.panel_process import serve_panel
from controller.touch.panels import open_panel


def main(arguments: list[str]) -> None:
    """Serve until the loop has gone."""
    what, priority, settings = arguments
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    enter_realtime(Realtime(priority=int(priority), lock_memory=int(priority) > 0))  # what is refused, the loop has told
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
