"""What commands may ask of the loop, such as those that come through the application socket."""

from __future__ import annotations

from typing import Any

from controller.device.loop.context import LoopContext
from controller.device.loop.layers import Layers
from controller.device.loop.outputs import Outputs
from controller.device.loop.playing.host_timing import HostTiming
from controller.device.loop.preparation import SceneChange
from controller.device.loop.scheduler import Scheduler
from controller.device.scene.effects.clips import ClientEffect
from controller.device.scene.scene import Scene
from controller.device.touch.source import Heard
from controller.errors import ConfigError, FaultError


class PanelControl:
    """What commands may ask of one loop; without a `change` its scene cannot be changed."""

    def __init__(
        self,
        context: LoopContext,
        outputs: Outputs,
        scheduler: Scheduler,
        timing: HostTiming,
        layers: Layers,
        change: SceneChange | None,
    ) -> None:
        self._layers = layers
        self._outputs = outputs
        self._scheduler = scheduler
        self._clock_estimate = context.clock_estimate
        self._counters = context.counters
        self.emissions = context.emissions  # the last ones, noted while they are wanted
        self._trace = context.trace
        self._source = context.source
        self.skipped = context.counters.skipped  # what was due and is not played
        self._change = change
        self._timing = timing
        self.fingers_in, self.fingers_down, self.switch = scheduler.fingers_in, scheduler.fingers_down, outputs.switch
        self.put_layer, self.move_layer, self.drop_layer = layers.put, layers.move, layers.drop

    def play(
        self, ticket: int, effect: str | ClientEffect, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float
    ) -> None:
        """Play an effect at a point, or at a finger wherever it moves, `amplitude` times the effect's own, MIN_AMPLITUDE to 1.

        Exactly one `CommandSource.outcome` follows, with the ticket; 0: nobody waits for it. Raises ControllerError, and no
        outcome follows, if the outputs are off, or the effect or the finger is unknown.
        """
        self._require_on()
        self._scheduler.play(ticket, effect, x_m, y_m, finger, amplitude, self._clock_estimate.fpga_s(now_s))

    def test_channel(self, ticket: int, channel: int, x_m: float, y_m: float, now_s: float) -> None:
        """Play a chirp on one channel alone, whose actuator is at the point; exactly one `CommandSource.outcome` follows.

        Raises ControllerError, and no outcome follows, if the outputs are off.
        """
        self._require_on()
        self._scheduler.test_channel(ticket, channel, x_m, y_m, self._clock_estimate.fpga_s(now_s))

    def _require_on(self) -> None:
        """Wake outputs that idle; FaultError, with the cause, if they are off."""
        if not self._outputs.wanted:
            raise FaultError("the outputs are off: the panel is disarmed; a client that may operate it has to arm it")
        if self._outputs.idle:
            self._outputs.wake()
        if not self._outputs.on and not self._outputs.waking:
            raise FaultError(f"the outputs are off: {self._outputs.cause or 'they are being armed'}")

    def write_trace(self, reason: str) -> None:
        """Have written what the loop did in the last seconds, with the reason; the log says where.

        Raises ConfigError if nothing writes it.
        """
        if not self._trace.is_written:
            raise ConfigError("this panel writes no traces: it has no folder for them, as the service has")
        self._trace.asked(reason, by_hand=True)

    def hear(self, heard: Heard | None) -> None:
        """Have the contacts of each report handed on as the touch panel has them, ghosts too; None: no longer."""
        self._source.heard = heard

    def load_scene(self, ticket: int, name: str) -> None:
        """Prepare another scene outside the loop and take it over; `CommandSource.loaded` follows.

        Raises ControllerError, and `loaded` does not follow, if this panel cannot change its scene.
        """
        self._changer().begin(name, ticket)

    def save_scene(self, ticket: int, name: str, toml: str) -> None:
        """Check a scene.toml outside the loop and keep it, so that `load_scene` finds it; `CommandSource.loaded` follows.

        Raises ControllerError, and `loaded` does not follow, if this panel cannot change its scene.
        """
        self._changer().save(name, toml, ticket)

    def _changer(self) -> SceneChange:
        if self._change is None:
            raise ConfigError("this panel cannot change its scene: it was started without the helper that prepares scenes")
        return self._change

    def figures(self) -> dict[str, Any]:
        """Counters and latencies so far, ready for JSON; without histograms, which would take 12 ms of the loop's time."""
        outputs = "ramping" if self._outputs.ramping else self._outputs.cause or ("on" if self._outputs.on else "off")
        return self._counters.export(histograms=False) | {
            "outputs": outputs,
            "outputs_on": self._outputs.may_be_on,
            "waiting": len(self._scheduler.due),
            "schedule": self._timing.figures(),
            "latency_histograms": self._counters.coarse_latency(),
        }

    def scene(self) -> tuple[str, Scene]:
        """Name of the scene in force, empty if it has none, and the scene without clients' layers."""
        return "" if self._change is None else self._change.name, self._layers.scene

    def effects(self) -> tuple[str, ...]:
        """Names of the effects that `play` accepts."""
        return tuple(self._scheduler.scene.effects)
