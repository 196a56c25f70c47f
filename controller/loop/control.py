"""What commands may ask of the loop, done: the `PanelControl` behind the application socket."""

from __future__ import annotations

from typing import Any

from controller.errors import ConfigError, FaultError
from controller.fpga.clock_estimate import ClockEstimate
from controller.loop.host_timing import HostTiming
from controller.loop.outputs import Outputs
from controller.loop.scene_source import SceneChange
from controller.loop.scheduler import Scheduler
from controller.metrics import Counters


class LoopControl:
    """`PanelControl` of one loop.

    Parameters
    ----------
    outputs : Outputs
    scheduler : Scheduler
    clock_estimate : ClockEstimate
        Converts the time of a command into FPGA time.
    counters : Counters
    change : SceneChange or None
        None: scenes cannot be changed.
    timing : HostTiming
    """

    def __init__(
        self,
        outputs: Outputs,
        scheduler: Scheduler,
        clock_estimate: ClockEstimate,
        counters: Counters,
        change: SceneChange | None,
        timing: HostTiming,
    ) -> None:
        self._outputs = outputs
        self._scheduler = scheduler
        self._clock_estimate = clock_estimate
        self._counters = counters
        self._change = change
        self._timing = timing

    def play(self, ticket: int, effect: str, x_m: float, y_m: float, finger: int | None, amplitude: float, now_s: float) -> None:
        """Play an effect; see `PanelControl.play`.

        Raises
        ------
        FaultError
            While the outputs are off, with the cause.
        ConfigError
            If the effect or the finger is unknown.
        """
        if not self._outputs.wanted:
            raise FaultError("the outputs are off: the panel is disarmed; a client that may operate it has to arm it")
        if self._outputs.idle:
            self._outputs.wake()
        if not self._outputs.on and not self._outputs.waking:
            raise FaultError(f"the outputs are off: {self._outputs.cause or 'they are being armed'}")
        self._scheduler.play(ticket, effect, x_m, y_m, finger, amplitude, self._clock_estimate.fpga_s(now_s))

    def switch(self, on: bool) -> None:
        """Arm or disarm the outputs; see `PanelControl.switch`."""
        self._outputs.wanted = on

    def load_scene(self, ticket: int, name: str) -> None:
        """Prepare another scene; see `PanelControl.load_scene`.

        Raises
        ------
        ConfigError
            If this loop cannot change its scene.
        """
        if self._change is None:
            raise ConfigError("this panel cannot change its scene: it was started without the helper that prepares scenes")
        self._change.begin(name, ticket)

    def figures(self) -> dict[str, Any]:
        """Counters and latencies, ready for JSON; without histograms, which would take 12 ms of the loop's time."""
        outputs = "ramping" if self._outputs.ramping else self._outputs.cause or ("on" if self._outputs.on else "off")
        return self._counters.export(histograms=False) | {
            "outputs": outputs,
            "outputs_on": self._outputs.may_be_on,
            "waiting": len(self._scheduler.due),
            "schedule": self._timing.figures(),
            "latency_histograms": self._counters.coarse_latency(),
        }

    def effects(self) -> tuple[str, ...]:
        """Names of the effects that `play` accepts."""
        return tuple(self._scheduler.scene.effects)
