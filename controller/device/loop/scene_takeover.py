"""Taking over a scene that was prepared, between two turns of the loop."""

from __future__ import annotations

from collections.abc import Callable

from controller.device.loop.commands import CommandSource
from controller.device.loop.context import LoopContext
from controller.device.loop.layers import Layers
from controller.device.loop.playing.playback import Playback
from controller.device.loop.preparation import PreparedScene, SceneChange
from controller.device.loop.scheduler import Scheduler


class SceneTakeover:
    """Takes over each scene that `change` has prepared, and says so to whoever asked for it."""

    def __init__(
        self,
        context: LoopContext,
        scheduler: Scheduler,
        playback: Playback,
        layers: Layers,
        change: SceneChange,
        commands: CommandSource | None,
        scene_changed: Callable[[PreparedScene], None] | None,
    ) -> None:
        self._source = context.source
        self._clock_estimate = context.clock_estimate
        self._counters = context.counters
        self._emissions = context.emissions
        self._scheduler = scheduler
        self._playback = playback
        self._layers = layers
        self._change = change
        self._commands = commands
        self._scene_changed = scene_changed

    def turn(self, now_s: float) -> None:
        """Take over a scene if one is prepared."""
        prepared = self._change.take()
        if prepared is None:
            return
        if prepared.saves:
            if self._commands is not None:
                self._commands.loaded(prepared.ticket, prepared.reason)
            return
        if prepared.scene is not None:
            if prepared.selection is not None:
                self._playback.sender.change_bank(prepared.selection)
                self._emissions.expected = prepared.expected
            self._scheduler.change_scene(self._layers.over(prepared.scene), self._clock_estimate.fpga_s(now_s))
            self._playback.sender.pin([(emitter.x_m, emitter.y_m, emitter.amplitude) for emitter in prepared.scene.emitters])
            self._counters.scenes_loaded += 1
            if self._commands is not None:
                self._commands.scene_changed()
        else:
            self._counters.scenes_refused += 1
            self._counters.scene_refused = prepared.reason
        if not prepared.ticket:
            self._counters.reloads += 1
            self._counters.reload_refused = prepared.reason
        if self._scene_changed is not None:
            self._scene_changed(prepared)
        if prepared.ticket and self._commands is not None:
            self._commands.loaded(prepared.ticket, prepared.reason)
        # The fixed emitters of the scene before; last, as the link may fail
        if prepared.scene is not None and self._playback.occupancy.repeating:
            self._playback.stop()
            self._source.emitted(now_s, now_s)
