"""Drive a panel from another program: a small client of its application socket.

>>> with PanelClient("/run/haptic-panel/panel.sock") as panel:      # doctest: +SKIP
...     panel.play("click", at_mm=(100, 70), amplitude=0.5)
...     for touch in panel.touches():
...         if touch.contact and touch.x_mm > 105:
...             panel.play("click", finger=touch.finger)

The same from a shell: `python -m controller.device.application_socket.client --socket S play click --at 100 70`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Self, TypedDict, Unpack

import msgspec
from msgspec import Raw

from controller.device.application_socket.client.link import PanelLink, T
from controller.device.application_socket.protocol import client_messages
from controller.device.application_socket.protocol.client_messages import Transform
from controller.device.application_socket.protocol.panel_messages import (
    Answer,
    ContactNotice,
    Description,
    Emissions,
    FaultNotice,
    FiguresAnswer,
    Greeting,
    LayerAnswer,
    LogLine,
    StateAnswer,
    Touch,
)

PointMm = tuple[float, float]
DEFAULT_PATH = "/run/haptic-panel/panel.sock"


class Where(TypedDict, total=False):
    """For whom an effect is to be played, and how strongly; see `PanelClient.play`."""

    finger: int | None
    region: str | None
    amplitude: float | None


class PanelClient:
    """A connection to a running panel, for use by one thread at a time.

    Every method raises LinkError if no panel listens at the path, it does not answer within `timeout_s`, or it ends the
    connection; ControllerError if this user may not connect or lacks the right that is needed, or if the panel refuses the
    request.
    """

    def __init__(self, path: str = DEFAULT_PATH, timeout_s: float = 5.0) -> None:
        self._link = PanelLink(path, timeout_s)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the connection."""
        self._link.close()

    def play(self, effect: str | Mapping[str, Any], *, at_mm: PointMm | None = None, **where: Unpack[Where]) -> Answer:
        """Play an effect at a point of the plate, at a finger or at all fingers in a region, and wait for the outcome.

        The effect is one of `hello().effects`, a name given to `keep_clip`, or a table with the keys of a scene's
        [effects.NAME]. A place is in mm from the plate's corner; a finger is numbered as by `touches`, and the effect follows
        it; a region is one of this client's layer or of the scene. `amplitude` is a share of the full amplitude, 0.1 to 1;
        default: the largest that the board allows.

        `outcome` of the answer is "played", "merged" (replaced by a newer command), "skipped" or "refused", with its
        `reason`.
        """
        return self._link.answer(self.start_play(effect, at_mm=at_mm, **where))

    def start_play(self, effect: str | Mapping[str, Any], *, at_mm: PointMm | None = None, **where: Unpack[Where]) -> int:
        """As `play`, but without waiting: returns the id to give to `wait`."""
        x_mm, y_mm = at_mm or (None, None)
        if isinstance(effect, str):
            return self._link.ask(client_messages.PlayRequest(effect=effect, x_mm=x_mm, y_mm=y_mm, **where))
        return self._link.ask(client_messages.Clip(effect=Raw(msgspec.json.encode(effect)), x_mm=x_mm, y_mm=y_mm, **where))

    def keep_clip(self, name: str, effect: Mapping[str, Any]) -> None:
        """Have the panel keep an effect, a table with the keys of a scene's [effects.NAME], to be played by that name."""
        self._link.done(client_messages.Clip(effect=Raw(msgspec.json.encode(effect)), name=name))

    def wait(self, number: int) -> Answer:
        """Wait for the outcome of a command given with `start_play`."""
        return self._link.answer(number)

    def put_regions(
        self,
        regions: Sequence[Mapping[str, Any]],
        *,
        effects: Mapping[str, Mapping[str, Any]] | None = None,
        transform: Transform | None = None,
    ) -> LayerAnswer:
        """Replace this client's layer of regions, which lies over the scene as long as this client is connected.

        Regions and effects are tables of a scene, as they stand in a scene.toml, lengths in mm; without a transform the layer
        lies where the one before lay. The answer comes when the layer is in force; its `refused` names the regions that are
        not in it. A layer that is refused as a whole leaves the one before.
        """
        raw = Raw(msgspec.json.encode(effects or {}))
        tables = tuple(Raw(msgspec.json.encode(region)) for region in regions)
        return self._link.question(client_messages.Regions(regions=tables, effects=raw, transform=transform), LayerAnswer)

    def move_regions(self, *, x_mm: float = 0.0, y_mm: float = 0.0, scale: float = 1.0) -> None:
        """Move this client's layer: its point (x, y) is at (x_mm + scale x, y_mm + scale y) on the plate."""
        self._link.done(client_messages.MoveRegions(x_mm=x_mm, y_mm=y_mm, scale=scale))

    def touches(self) -> Iterator[Touch]:
        """Every touch from this call on, until the iterator is closed."""
        return self._link.follow(Touch, "touches")

    def contacts(self) -> Iterator[ContactNotice]:
        """Every contact as the touch panel has it, ghosts too, as for `states`; for operators."""
        return self._link.follow(ContactNotice, "contacts")

    def subscribe(self, *topics: client_messages.Topic) -> None:
        """Have the panel send what belongs to these topics, for `heard`."""
        self._link.done(client_messages.Subscribe(to=topics))

    def heard(self, kind: type[T], wait_s: float) -> list[T]:
        """What has come of a kind that was subscribed to; if nothing has, wait up to `wait_s` for a message of any kind."""
        return self._link.heard(kind, wait_s)

    def emissions(self) -> Iterator[Emissions]:
        """What is played from this call on, and what is not, until the iterator is closed, as for `states`."""
        return self._link.follow(Emissions, "emissions")

    def states(self) -> Iterator[StateAnswer]:
        """State of the panel now and after each change, until the iterator is closed; that ends `touches` too."""
        return self._link.follow(StateAnswer, "state")

    def faults(self) -> Iterator[FaultNotice]:
        """Every fault from this call on, until the iterator is closed, as for `states`; `describe` has the last 50."""
        return self._link.follow(FaultNotice, "faults")

    def descriptions(self) -> Iterator[Description]:
        """Description of the panel now and whenever another scene is in force, until the iterator is closed, as for `states`."""
        return self._link.follow(Description, "description")

    def log(self) -> Iterator[LogLine]:
        """The last lines of the service's log, and every one from then on, as for `states`; for operators."""
        return self._link.follow(LogLine, "log")

    def arm(self) -> None:
        """Switch the outputs on as soon as the FPGA allows it; `states` reports when they are. For operators."""
        self._link.done(client_messages.Arm())

    def disarm(self) -> None:
        """Ramp the outputs down to 0 V; they stay off until a client arms. For operators."""
        self._link.done(client_messages.Disarm())

    def test_channel(self, channel: int) -> Answer:
        """Play a chirp on one channel alone, and wait for the outcome, as of `play`; for operators."""
        return self._link.answer(self._link.ask(client_messages.ChannelTest(channel=channel)))

    def write_trace(self) -> None:
        """Have the service write what its loop did in the last seconds; for operators.

        The service's log names the file, `haptic-panel trace` explains it.
        """
        self._link.done(client_messages.WriteTrace())

    def stop(self) -> None:
        """As `disarm`, whatever this user's rights are."""
        self._link.done(client_messages.Stop())

    def state(self) -> StateAnswer:
        """State of the panel: outputs, cause of a fault, touch panel, temperature."""
        return self._link.question(client_messages.AskState(), StateAnswer)

    def load_scene(self, name: str) -> None:
        """Load another scene of the board; returns when it is in force. If it is refused, the panel keeps the scene before."""
        self._link.done(client_messages.LoadScene(name=name))

    def save_scene(self, name: str, toml: str) -> None:
        """Keep a scene.toml, given as text, on the device, so that `load_scene` finds it by its name."""
        self._link.done(client_messages.SaveScene(name=name, toml=toml))

    def figures(self) -> dict[str, Any]:
        """Counters and latencies of the panel so far."""
        return self._link.question(client_messages.AskFigures(), FiguresAnswer).figures

    def describe(self) -> Description:
        """What the panel is and plays: plate, patches, axes, scene, effects, limits, versions, last faults."""
        return self._link.question(client_messages.Describe(), Description)

    def hello(self) -> Greeting:
        """Version, board, extents in mm, the effects that a command can play, and this user's rights."""
        return self._link.question(client_messages.Hello(), Greeting)
