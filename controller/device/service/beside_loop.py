"""Helper processes of the service: `python -m controller.device.service.beside_loop panel|thermometer PRIORITY SETTINGS` (JSON).

The service starts them (`worker`); their standard input is a socket to it. They end when it is closed, and ignore the signals
that a service manager sends to all processes of a service.
"""

from __future__ import annotations

import signal
import socket
import sys

import msgspec

from controller.device.board.devices import Realtime, Temperature
from controller.device.board.touch_panels import DrivenPanel, touch_record
from controller.device.service.realtime import enter_realtime
from controller.device.service.temperature_sensors import sensor_of, serve_sensor
from controller.device.touch.drivers.panel_process import PanelSettings, serve_panel
from controller.device.touch.panels import open_panel


def main(arguments: list[str]) -> None:
    """Serve until the loop closes the socket."""
    what, priority, settings = arguments
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
        signal.signal(number, signal.SIG_IGN)
    enter_realtime(Realtime(priority=int(priority), lock_memory=int(priority) > 0))  # the loop has reported what is refused
    with socket.socket(fileno=sys.stdin.fileno()) as loop:
        try:
            if what == "panel":
                _serve_panel(msgspec.json.decode(settings, type=PanelSettings), loop)
            else:
                serve_sensor(sensor_of(msgspec.json.decode(settings, type=Temperature)), loop)
        except (BrokenPipeError, ConnectionResetError):
            return  # the loop has gone


def _serve_panel(settings: PanelSettings, loop: socket.socket) -> None:
    touch = msgspec.convert(settings.touch, touch_record(settings.touch["kind"]))
    shared = None
    if isinstance(touch, DrivenPanel) and touch.share:
        from controller.device.touch.drivers.shared_panel import SharedPanel

        shared = SharedPanel(touch, settings.length_m, settings.width_m)
    serve_panel(lambda: open_panel(touch), loop, shared)


if __name__ == "__main__":
    main(sys.argv[1:])
