"""When the outputs are to be switched off because nothing has been touched for long."""

from __future__ import annotations

from controller.clocks import NEVER
from controller.device.loop.outputs import Outputs
from controller.device.loop.playing.playback import Playback
from controller.device.loop.scheduler import Scheduler


class Idling:
    """Keeps when something was last touched or played; `after_s` later the outputs idle. NEVER: they stay on."""

    def __init__(self, outputs: Outputs, scheduler: Scheduler, playback: Playback, after_s: float) -> None:
        self.after_s = after_s
        self.active_s = -NEVER  # when something was last touched or played
        self._outputs = outputs
        self._scheduler = scheduler
        self._playback = playback

    def begins(self, now_s: float, *, touched: bool) -> bool:
        """Whether the outputs are to idle from now on; wakes those that idle under a scene that stays armed, or are not wanted."""
        outputs, scheduler = self._outputs, self._scheduler
        if touched or not outputs.on or scheduler.active or self._playback.accepted is not None or not scheduler.scene.may_idle:
            self.active_s = now_s
            if outputs.idle and (not outputs.wanted or not scheduler.scene.may_idle):
                outputs.wake()
            return False
        return now_s - self.active_s >= self.after_s and now_s >= self._playback.occupancy.free_s
