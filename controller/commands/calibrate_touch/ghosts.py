"""`haptic-panel calibrate-touch --ghosts`: false contacts that emissions cause, and the `ghost_ms` that follows."""

import argparse
from typing import Any

from controller.clocks import Clock, MonotonicClock, VirtualClock
from controller.commands.bank import open_bank
from controller.commands.calibrate_touch.value import calibrate_value
from controller.commands.common.fpga_link import open_fpga_of
from controller.commands.common.output import progress_bar
from controller.console import tell
from controller.device.bank.reader import Bank
from controller.device.board.board import Board
from controller.device.fpga.links.link import Link
from controller.device.loop.context import LoopContext
from controller.device.loop.playing.records import Played
from controller.device.loop.wiring import assemble
from controller.device.scene.effects.trains import Train
from controller.device.scene.scene import Scene, load_scene
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import open_panel, open_session
from controller.device.service.realtime import enter_realtime
from controller.device.touch.event_reader import Event, EventReader
from controller.device.touch.live_source import LiveSource
from controller.device.touch_calibration.event_capture import EventCapture, emission_event, recording_text
from controller.device.touch_calibration.ghost_figures import GhostFigures, ghost_figures
from controller.device.touch_calibration.ghost_survey import KNOCK, Knocks, Overheard
from controller.errors import ConfigError

SIMULATED_RATE, SIMULATED_LIVES, SIMULATED_SIZE_MM = 0.3, (1, 3), 6.0  # what the simulated board's panel does


def calibrate_ghosts(options: argparse.Namespace) -> int:
    """Play, record the panel, and print or write `ghost_ms`; or determine it from such a recording."""
    return calibrate_value(options, "ghost_ms", _measured, ghost_figures, figures, table)


def _measured(options: argparse.Namespace, board: Board) -> str:
    """Play knocks on the board's FPGA while nobody touches its panel; all that the panel said, as a recording."""
    simulated = board.link.kind == "simulated"
    if simulated and board.touch.has_device:
        raise ConfigError(f"board {board.name!r} has a simulated FPGA: --ghosts needs the one whose emissions the panel hears")
    clock: Clock = VirtualClock() if simulated else MonotonicClock()
    with open_bank(options, board, load_scene(scene := find_scene(board, board.scene), board), scene, keep=True) as bank:
        if not simulated:
            tell("hands off the panel for one to three minutes: it plays by itself")
            for warning in enter_realtime(board.realtime):  # each heartbeat that is missed costs a second
                tell(warning)
        link = open_fpga_of(board)(board, clock.now_s)
        try:
            reader = _simulated_panel(board, link) if simulated else open_panel(board)
            try:
                return _play(board, bank, clock, link, EventCapture(reader))
            finally:
                reader.close()
        finally:
            link.close()


def _play(board: Board, bank: Bank, clock: Clock, link: Link, kept: EventCapture) -> str:
    session = open_session(link, board, clock.now_s)
    panel = Overheard(LiveSource(kept, board))
    emissions: list[Event] = []

    def played(start: Played) -> None:
        emissions.append(emission_event(start.trigger_s, board.waveform.duration_s))
        knocks.begun(start.trigger_s)

    def stop() -> None:
        loop.stop()

    places = [(float(x_m), float(y_m)) for x_m, y_m in bank.grid.points()[bank.cells]]
    knocks = Knocks(panel, places, board.waveform.duration_s, stop, progress_bar("emissions"))
    try:
        loop = assemble(
            LoopContext(board, clock, session, panel), Scene((), {KNOCK: Train()}), bank, played=played, commands=knocks
        ).loop
        loop.run(knocks.ready)
    finally:
        knocks.close()
    if knocks.error is not None:
        raise knocks.error
    return recording_text(kept.description, [*kept.events, *emissions])


def _simulated_panel(board: Board, link: Link) -> EventReader:
    from controller.workshop.gateware.simulated_link import SimulatedLink
    from controller.workshop.simulation.ghostly_panel import GhostlyPanel, Ghosts, pins_of

    assert isinstance(link, SimulatedLink)
    tell("a simulated panel: what it does is made up")
    ghosts = Ghosts(SIMULATED_RATE, SIMULATED_LIVES, SIMULATED_SIZE_MM)
    return GhostlyPanel(board, (), pins_of(link), ghosts, until_s=1e6)


def figures(found: GhostFigures) -> dict[str, Any]:
    """The result, ready for JSON."""
    appears, gone, size = found.appears_ms, found.gone_ms, found.size_mm
    return {
        "emissions": found.emissions,
        "ghosts": found.ghosts,
        "rate": round(found.rate, 4),
        "rate_below": found.rate_below,
        "appears_ms": None if appears is None else {"earliest": round(appears[0], 2), "latest": round(appears[1], 2)},
        "gone_ms": None if gone is None else dict(zip(("median", "p95", "longest"), (round(v, 2) for v in gone), strict=True)),
        "size_mm": None if size is None else {"median": round(size[0], 2), "largest": round(size[1], 2)},
        "ghost_ms": found.ghost_ms,
    }


def table(figures: dict[str, Any]) -> list[str]:
    """The result as lines for people."""
    if not figures["ghosts"]:
        return [f"no ghost in {figures['emissions']} emissions: below {100 * figures['rate_below']:.1f} % of them, at 95 %"]
    gone, appears, size = figures["gone_ms"], figures["appears_ms"], figures["size_mm"]
    lines = [
        f"{figures['ghosts']} ghosts, made by {100 * figures['rate']:.1f} % of {figures['emissions']} emissions",
        f"first reported {appears['earliest']:.1f} to {appears['latest']:.1f} ms after the emission began",
        f"gone {gone['median']:.1f} ms after its end, 95 % by {gone['p95']:.1f} ms, the longest {gone['longest']:.1f} ms;"
        f" one in {figures['ghosts'] + 1} may be longer",
    ]
    if size is not None:
        lines.append(f"size {size['median']:.1f} mm, at most {size['largest']:.1f} mm")
    return lines
