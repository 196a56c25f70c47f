"""`haptic-panel page`: the bridge between browsers and the panel's application socket."""

from __future__ import annotations

import argparse
import contextlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.arguments import Declare
from controller.console import say, tell
from controller.device.service.installation import is_installed, missing_package
from controller.errors import ConfigError, ControllerError, UsageError
from controller.log import Priority
from controller.programs import end

if TYPE_CHECKING:
    from controller.device.page.settings import PageSettings

FINGERS = 4  # of the demonstration
END_S = 5.0  # that the simulated panel may take to ramp down


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser = declare(
        example="haptic-panel page --demo",
        description="Serve web pages that are felt: haptic.js, the files of a folder, and a page that shows the panel, on one "
        "origin with a socket to the panel. It is a process of its own, and talks to the panel's application socket as any client "
        "does. Prints its address; Ctrl-C or SIGTERM ends it.",
    )
    parser.add_argument(
        "--settings", metavar="FILE", help="page.toml: origins and their rights, addresses, limits, the screen's place"
    )
    parser.add_argument("--www", metavar="DIR", help="folder of files to serve (default: the settings')")
    parser.add_argument("--socket", metavar="PATH", help="the panel's application socket (default: the settings')")
    parser.add_argument("--port", type=int, metavar="N", help="TCP port, 0: any that is free (default: the settings')")
    parser.add_argument("--demo", action="store_true", help="simulate a panel, and let the page do everything with it")
    parser.add_argument("--board", metavar="B", help="with --demo: that is simulated, by name or folder (default: simulated)")
    parser.set_defaults(command=run)


def run(options: argparse.Namespace) -> int:
    """Serve until a signal."""
    from controller.device.page.settings import load_settings

    if options.demo and options.socket:
        raise UsageError("--demo: has a panel and socket of its own; leave out --socket")
    if options.board and not options.demo:
        raise UsageError("--board: is of the panel that --demo simulates; without it the panel is the socket's")
    board = options.board or "simulated"
    file = Path(options.settings) if options.settings else None
    changed = {name: value for name in ("www", "socket", "port") if (value := getattr(options, name)) is not None}
    settings = load_settings(file)
    if not options.demo:
        return _serve(_with(settings, changed), file)
    if not is_installed("workshop"):
        raise ConfigError(missing_package("controller.workshop") or "--demo needs the workshop")
    with tempfile.TemporaryDirectory(prefix="haptic-panel-") as folder:
        socket = str(Path(folder) / "panel.sock")
        origins = settings.origins if file else {"self": ("operate",)}
        changed |= {"socket": socket, "origins": origins, "field": settings.field or _field(board)}
        with _simulated_panel(socket, board):
            return _serve(_with(settings, changed), file)


def _with(settings: PageSettings, changed: dict[str, object]) -> PageSettings:
    """Settings with what the command line says instead, checked as the file's."""
    import msgspec

    from controller.device.board.records import as_record
    from controller.device.page.settings import PageSettings

    given = {name: value for name, value in msgspec.structs.asdict(settings).items() if value is not None}
    return as_record("", given | changed, PageSettings)


def _serve(settings: PageSettings, file: Path | None) -> int:
    import asyncio

    from controller.device.page.bridge import Bridge

    def ready(addresses: list[str]) -> None:
        say(addresses[0])
        tell(f"serving at {' and '.join(addresses)}; {addresses[0]}live/ shows the panel; Ctrl-C ends it")

    asyncio.run(Bridge(settings, file).run(ready))
    return 0


def _field(board: str) -> str:
    """File of the field view of the panel that is simulated; empty if it cannot be kept: the demo goes on without."""
    from controller.device.board.board import load_board
    from controller.device.board.lookup import find_board
    from controller.workshop.physics.pictures.field_file import kept_field

    try:
        return str(kept_field(load_board(find_board(board))))
    except ConfigError as error:
        tell(f"no field view: {error}", Priority.WARNING)
        return ""


@contextlib.contextmanager
def _simulated_panel(socket: str, board: str) -> Iterator[None]:
    """`haptic-panel serve` as another process, which plays by now, and ends with this one."""
    read_end, write_end = os.pipe()
    command = [sys.executable, "-m", "controller", "serve", "--board", board, "--fingers", str(FINGERS)]
    command += ["--ready-fd", str(write_end), "--", socket]
    traces = os.environ | {"RUNTIME_DIRECTORY": str(Path(socket).parent)}
    with os.fdopen(read_end, "rb") as answer:
        panel = subprocess.Popen(command, stdin=subprocess.DEVNULL, pass_fds=(write_end,), start_new_session=True, env=traces)
        os.close(write_end)
        try:
            if not answer.read(1):
                raise ControllerError(f"the simulated panel did not begin (exit code {panel.wait()})")
            yield
        finally:
            panel.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                panel.wait(END_S)
            end(panel)
