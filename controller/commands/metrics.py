"""`haptic-panel metrics`: figures of a running panel for Prometheus."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.arguments import Declare
from controller.console import say
from controller.device.application_socket.client import DEFAULT_PATH
from controller.device.service.installation import is_installed
from controller.errors import ControllerError, UsageError

if TYPE_CHECKING:
    from prometheus_client import CollectorRegistry
    from prometheus_client.core import Metric


LISTEN = "127.0.0.1:9750"


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser = declare(
        example="haptic-panel metrics --listen 127.0.0.1:9750",
        description="Show the figures of a running panel in the text format of Prometheus: states, faults by cause, latency "
        "histograms, skips, queue, temperature, release and update. Asks the panel's application socket, at most once a second; "
        "a panel that does not answer is haptic_panel_up 0. Without options: once, on stdout.",
    )
    parser.add_argument("--socket", default=DEFAULT_PATH, metavar="PATH", help=f"the panel's application socket ({DEFAULT_PATH})")
    how = parser.add_mutually_exclusive_group()
    how.add_argument(
        "--listen", metavar="HOST:PORT", nargs="?", const=LISTEN, help=f"serve http until SIGTERM or Ctrl-C (default: {LISTEN})"
    )
    how.add_argument("--textfile", metavar="FILE.prom", help="write a file for the textfile collector of node_exporter, once")
    parser.add_argument(
        "--host",
        dest="hosts",
        action="append",
        default=[],
        metavar="NAME",
        help="answer requests to this name or address of the device too; else to localhost and the address listened at",
    )
    parser.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Export the figures."""
    from prometheus_client import generate_latest, write_to_textfile

    from controller.device.service.prometheus import PanelCollector, PanelFigures, registry

    alone = registry(PanelCollector(PanelFigures(options.socket), _of_releases))
    if options.listen:
        _serve(alone, options.listen, options.hosts)
        return 0
    if options.hosts:
        raise UsageError("--host: only with --listen")
    if options.textfile:
        file = Path(options.textfile)
        if file.suffix != ".prom":
            raise UsageError(f"--textfile {file}: node_exporter reads only files whose names end with .prom")
        try:
            write_to_textfile(os.fspath(file), alone)
        except OSError as error:
            raise ControllerError(f"--textfile {file}: cannot be written ({error.strerror})") from error
        return 0
    say(generate_latest(alone).decode(), end="")
    return 0


def _of_releases() -> Iterator[Metric]:
    """Releases of this device, also while no panel answers; none without the room that has them."""
    if is_installed("device.update"):
        from controller.device.service.prometheus import update_metrics
        from controller.device.update.installed import update_state
        from controller.device.update.layout import Layout

        yield from update_metrics(update_state(Layout.from_environment()))


def _serve(collected: CollectorRegistry, listen: str, hosts: list[str]) -> None:
    import asyncio
    import contextlib
    import socket

    from controller.device.service.metrics_server import MetricsServer

    host, port = _address(listen)
    try:
        listener = socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    except OSError as error:
        said = os.strerror(error.errno) if error.errno and error.errno > 0 else error.strerror  # else of the name, not of the port
        raise ControllerError(f"--listen {listen}: cannot listen there ({said})") from error
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(MetricsServer(collected, [host, *hosts]).serve(listener))


def _address(listen: str) -> tuple[str, int]:
    host, colon, port = listen.rpartition(":")
    if not colon or not port.isdecimal() or int(port) > 65535:
        raise UsageError(f"--listen {listen}: give HOST:PORT, such as {LISTEN}")
    return host.strip("[]"), int(port)
