"""Parts of the loop without the whole of it."""

from types import SimpleNamespace

from controller.device.loop.context import LoopContext
from controller.device.loop.playing.host_timing import HostTiming
from controller.device.loop.playing.occupancy import Occupancy
from controller.device.loop.playing.playback import Playback
from controller.device.loop.playing.sending import Sender
from controller.device.loop.skips import ALL


def context_of(board, clock, session, where=lambda *_: None):
    """Context of a panel whose fingers are where `where` says, by default nowhere."""
    return LoopContext(board, clock, session, SimpleNamespace(predict=where, down=tuple))


def playback_of(context, selection, *, slots, duty=1.0, command_s=1e-5, played=None):
    """Playback of emissions of 2 ms."""
    occupancy = Occupancy(context.clock_estimate, 2e-3, duty)
    timing = HostTiming(1.4e-3, command_s, 2e-3 / duty)
    return Playback(context, Sender(context, selection, occupancy, slots, ALL), occupancy, timing, played)
