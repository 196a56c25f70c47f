"""Construction of the event loop from its parts, the same for a simulated run and for the device."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import msgspec

from controller.bank.reader import Bank
from controller.board.board import Board
from controller.clocks import Clock
from controller.fpga.clock_estimate import ClockEstimate
from controller.fpga.frames import FRAME_BYTES, UPLOAD_BYTES
from controller.fpga.session import Session
from controller.loop.commands import CommandSource, Outcome
from controller.loop.dispatcher import Dispatcher
from controller.loop.event_loop import EventLoop
from controller.loop.host_timing import HostTiming
from controller.loop.occupancy import Occupancy
from controller.loop.playback import Playback
from controller.loop.records import Played
from controller.loop.scene_source import SceneChange
from controller.loop.scheduler import Scheduler
from controller.loop.skips import ALL, Skips
from controller.metrics import Counters
from controller.scene.scene import Scene
from controller.touch.source import TrackedTouch
from controller.waveforms.selection import Selection

UPLOAD_COMMANDS = 4  # STORE, NOP while the slot is checked, PLAY, NOP
PLAY_COMMANDS = 2


@dataclass(frozen=True, slots=True)
class Assembly:
    """A loop that is ready to run, and those of its parts that callers need."""

    loop: EventLoop
    counters: Counters
    selection: Selection
    timing: HostTiming
    waiting: Callable[[], int]  # emissions that are due now


def assemble(
    board: Board,
    scene: Scene,
    bank: Bank,
    clock: Clock,
    session: Session,
    source: TrackedTouch,
    *,
    slots: int | None = None,
    max_duty: float | None = None,
    played: Callable[[Played], None] | None = None,
    commands: CommandSource | None = None,
    change: SceneChange | None = None,
    skips: Skips = ALL,
    **loop: Any,
) -> Assembly:
    """Construct a loop.

    Parameters
    ----------
    session : Session
        Of an FPGA that has been brought up.
    source : TrackedTouch
    slots, max_duty : int, float
        In place of the board's `link.slots` and `limits.max_duty`.
    played : callable, optional
        Called with every start.
    commands, change, **loop
        As `EventLoop` takes them.
    skips : Skips
        What of the work is left out: all that can be; less to measure what it saves.
    """
    selection = Selection(bank, bank.snap_m(board) if skips.cells else -1.0, board.idle_word, ready=skips.cells)
    counters = Counters()
    session.counters = counters.link
    clock_estimate = ClockEstimate(board.link.clock_hz)
    occupancy = Occupancy(clock_estimate, board.waveform.duration_s, board.limits.max_duty if max_duty is None else max_duty)
    timing = HostTiming(
        board.link.wire_s(UPLOAD_BYTES + UPLOAD_COMMANDS * FRAME_BYTES),
        board.link.wire_s(PLAY_COMMANDS * FRAME_BYTES),
        occupancy.apart_s,
    )
    playback = Playback(
        session,
        selection,
        clock_estimate,
        occupancy,
        source.predict,
        down=source.down,
        slots=board.link.slots if slots is None else slots,
        timing=timing,
        counters=counters,
        played=played,
        skips=skips,
    )
    playback.pin([(spot.x_m, spot.y_m, spot.amplitude) for spot in scene.spots])

    outcomes = _nobody if commands is None else commands.outcome
    scheduler = Scheduler(
        scene, counters, source.confirmed, board.touch.max_emissions_unconfirmed, outcomes, skips, bank.wave_scale
    )
    dispatcher = Dispatcher(clock, session, source, scheduler, playback, clock_estimate, counters)
    parts = (clock, session, source, scheduler, playback, dispatcher, clock_estimate, counters)
    never_idle = msgspec.structs.replace(board, idle_disarm_s=None)
    running = EventLoop(board if skips.idle else never_idle, *parts, commands=commands, change=change, **loop)
    return Assembly(running, counters, selection, timing, lambda: len(scheduler.due))


def _nobody(ticket: int, outcome: Outcome, age_s: float) -> None:
    """In place of a source of commands."""
