"""Construction of the event loop from its parts, the same for a simulated run and for the device."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from controller.clocks import NEVER
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import FRAME_BYTES, UPLOAD_BYTES
from controller.device.loop.commands import CommandSource, Outcome
from controller.device.loop.context import LoopContext, Watch
from controller.device.loop.dispatcher import Dispatcher
from controller.device.loop.event_loop import NOBODY, EventLoop
from controller.device.loop.playing.host_timing import HostTiming
from controller.device.loop.playing.occupancy import Occupancy
from controller.device.loop.playing.playback import Playback
from controller.device.loop.playing.records import Played
from controller.device.loop.playing.sending import Sender
from controller.device.loop.preparation import SceneChange
from controller.device.loop.scheduler import Scheduler
from controller.device.loop.skips import ALL, Skips
from controller.device.scene.scene import Scene
from controller.device.waveforms.selection import Selection
from controller.device.waveforms.wide_selection import selection_of
from controller.metrics import Counters

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
    context: LoopContext,
    scene: Scene,
    bank: Bank,
    *,
    played: Callable[[Played], None] | None = None,  # called with every start
    commands: CommandSource | None = None,  # commands, change, watch: as `EventLoop` takes them
    change: SceneChange | None = None,
    watch: Watch = NOBODY,
    skips: Skips = ALL,  # what of the work is left out: all that can be; less to measure what it saves
) -> Assembly:
    """Construct a loop."""
    board = context.board
    snap_m = bank.snap_m(board) if skips.cells else -1.0
    selection = selection_of(bank, board, snap_m, ready=skips.cells)
    occupancy = Occupancy(context.clock_estimate, board.waveform.duration_s, board.limits.max_duty)
    fpgas = max(len(board.link.fpga), 1)
    timing = HostTiming(
        board.link.wire_s(UPLOAD_BYTES + UPLOAD_COMMANDS * FRAME_BYTES) * fpgas,
        board.link.wire_s(PLAY_COMMANDS * FRAME_BYTES) * fpgas,
        occupancy.apart_s,
    )
    sender = Sender(context, selection, occupancy, board.link.slots, skips)
    sender.pin([(emitter.x_m, emitter.y_m, emitter.amplitude) for emitter in scene.emitters])
    playback = Playback(context, sender, occupancy, timing, played)
    scheduler = Scheduler(
        scene,
        context.counters,
        context.source.confirmed,
        board.touch.max_emissions_unconfirmed,
        _nobody if commands is None else commands.outcome,
        skips,
        bank.wave_scale,
    )
    loop = EventLoop(
        context,
        scheduler,
        playback,
        Dispatcher(context, scheduler, playback),
        commands=commands,
        change=change,
        watch=watch,
        idle_after_s=NEVER if board.idle_disarm_s is None or not skips.idle else board.idle_disarm_s,
    )
    return Assembly(loop, context.counters, selection, timing, lambda: len(scheduler.due))


def _nobody(ticket: int, outcome: Outcome, age_s: float) -> None:
    """In place of a source of commands."""
