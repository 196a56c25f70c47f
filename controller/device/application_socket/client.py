"""Drive a panel from another program: a small client of its application socket.

>>> with PanelClient("/run/haptic-panel/panel.sock") as panel:      # doctest: +SKIP
...     panel.play("click", at_mm=(100, 70), amplitude=0.5)
...     for touch in panel.touches():
...         if touch.contact and touch.x_mm > 105:
...             panel.play("click", finger=touch.finger)

The same from a shell: `python -m controller.device.application_socket.client --socket S play click --at 100 70`.
"""

from __future__ import annotations

import grp
import os
import pwd
import socket
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args

import msgspec
from msgspec import Raw

from controller.device.application_socket import messages
from controller.device.application_socket.messages import (
    Answer,
    AnyMessage,
    AnyRequest,
    Data,
    Description,
    Emissions,
    Farewell,
    FaultNotice,
    FiguresAnswer,
    Greeting,
    LayerAnswer,
    LogLine,
    StateAnswer,
    Touch,
    Transform,
)
from controller.errors import ControllerError, LinkError

T = TypeVar("T", bound="Notice")
DEFAULT_PATH = "/run/haptic-panel/panel.sock"
RECEIVE_BYTES = 65536
MAX_KEPT = 1000  # of each kind that arrive while an answer is awaited; older ones are dropped

Notice = Touch | Emissions | StateAnswer | FaultNotice | Description | LogLine
Reply = Answer | LayerAnswer | Data


class PanelClient:
    """A connection to a running panel, for use by one thread at a time.

    Parameters
    ----------
    path : str
        Path of the panel's socket.
    timeout_s : float
        Longest wait for an answer.

    Raises
    ------
    LinkError
        By every method: if no panel listens at the path, it does not answer in time, or it ends the connection.
    ControllerError
        If this user may not connect, or not play.
    """

    def __init__(self, path: str = DEFAULT_PATH, timeout_s: float = 5.0) -> None:
        self._path = path
        self._timeout_s = timeout_s
        self._encoder = msgspec.json.Encoder()
        self._decoder = messages.message_decoder()
        self._received = bytearray()
        self._notices: dict[type[Any], deque[Any]] = {kind: deque(maxlen=MAX_KEPT) for kind in get_args(Notice)}
        self._answers: dict[int, Reply] = {}  # by request id: answers that no call has taken yet
        self._last_id = 0
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            self._socket.connect(path)
        except PermissionError as error:
            self._socket.close()
            raise ControllerError(f"{path}: {_who_may_connect(path)}") from error
        except OSError as error:
            self._socket.close()
            raise LinkError(f"{path}: no panel to talk to ({error.strerror or error}); is the service running?") from error

    def __enter__(self) -> PanelClient:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the connection."""
        self._socket.close()

    def play(
        self,
        effect: str | Mapping[str, Any],
        *,
        at_mm: tuple[float, float] | None = None,
        finger: int | None = None,
        region: str | None = None,
        amplitude: float | None = None,
    ) -> Answer:
        """Play an effect at a point of the plate, at a finger or at all fingers in a region, and wait for the outcome.

        Parameters
        ----------
        effect : str or mapping
            One of `hello().effects`, a name given to `keep_clip`, or a table with the keys of a scene's [effects.NAME].
        at_mm : (float, float), optional
            Place on the plate from its corner, x and y in mm.
        finger : int, optional
            Instead of a place: a finger, as numbered by `touches`; the effect follows it.
        region : str, optional
            Instead of a place: a region of this client's layer, or of the scene, by its name.
        amplitude : float, optional
            Share of the full amplitude, 0.1 to 1; default: the largest that the board allows.

        Returns
        -------
        Answer
            `outcome` is "played", "merged" (replaced by a newer command), "skipped" or "refused", with its `reason`.
        """
        return self._answer(self.start_play(effect, at_mm=at_mm, finger=finger, region=region, amplitude=amplitude))

    def start_play(
        self,
        effect: str | Mapping[str, Any],
        *,
        at_mm: tuple[float, float] | None = None,
        finger: int | None = None,
        region: str | None = None,
        amplitude: float | None = None,
    ) -> int:
        """As `play`, but without waiting: returns the id to give to `wait`."""
        x_mm, y_mm = at_mm or (None, None)
        where: dict[str, Any] = {"x_mm": x_mm, "y_mm": y_mm, "finger": finger, "region": region, "amplitude": amplitude}
        number = self._new_id()
        if isinstance(effect, str):
            return self._ask(messages.PlayRequest(id=number, effect=effect, **where))
        return self._ask(messages.Clip(id=number, effect=Raw(self._encoder.encode(effect)), **where))

    def keep_clip(self, name: str, effect: Mapping[str, Any]) -> None:
        """Have the panel keep an effect for this client, to be played by that name.

        Parameters
        ----------
        effect : mapping
            A table with the keys of a scene's [effects.NAME].

        Raises
        ------
        ControllerError
            If it is not valid, or this user may not play.
        """
        self._done(messages.Clip(id=self._new_id(), effect=Raw(self._encoder.encode(effect)), name=name))

    def wait(self, number: int) -> Answer:
        """Wait for the outcome of a command given with `start_play`."""
        return self._answer(number)

    def put_regions(
        self,
        regions: Sequence[Mapping[str, Any]],
        *,
        effects: Mapping[str, Mapping[str, Any]] | None = None,
        transform: Transform | None = None,
    ) -> LayerAnswer:
        """Replace this client's layer of regions, which lies over the scene as long as this client is connected.

        Parameters
        ----------
        regions, effects
            Tables of a scene, as they stand in a scene.toml; lengths in mm.
        transform : Transform, optional
            Where the layer lies; default: where the one before lay.

        Returns
        -------
        LayerAnswer
            The layer is in force; `refused` names the regions that are not in it.

        Raises
        ------
        ControllerError
            If it was refused as a whole; the layer before stays.
        """
        number = self._new_id()
        raw = Raw(self._encoder.encode(effects or {}))
        tables = tuple(Raw(self._encoder.encode(region)) for region in regions)
        answer = self._wait(self._ask(messages.Regions(id=number, regions=tables, effects=raw, transform=transform)))
        if isinstance(answer, LayerAnswer):
            return answer
        raise _refused(answer)

    def move_regions(self, *, x_mm: float = 0.0, y_mm: float = 0.0, scale: float = 1.0) -> None:
        """Move this client's layer: its point (x, y) is at (x_mm + scale x, y_mm + scale y) on the plate.

        Raises
        ------
        ControllerError
            If this client has sent no regions, or may not.
        """
        self._done(messages.MoveRegions(id=self._new_id(), x_mm=x_mm, y_mm=y_mm, scale=scale))

    def touches(self) -> Iterator[Touch]:
        """Every touch from this call on, until the iterator is closed."""
        return self._subscribed(Touch, "touches")

    def emissions(self) -> Iterator[Emissions]:
        """What is played from this call on, and what is not, until the iterator is closed, as for `states`."""
        return self._subscribed(Emissions, "emissions")

    def states(self) -> Iterator[StateAnswer]:
        """State of the panel now and after each change, until the iterator is closed; that ends `touches` too."""
        return self._subscribed(StateAnswer, "state")

    def faults(self) -> Iterator[FaultNotice]:
        """Every fault from this call on, until the iterator is closed, as for `states`; `describe` has the last 50."""
        return self._subscribed(FaultNotice, "faults")

    def descriptions(self) -> Iterator[Description]:
        """Description of the panel now and whenever another scene is in force, until the iterator is closed, as for `states`."""
        return self._subscribed(Description, "description")

    def log(self) -> Iterator[LogLine]:
        """The last lines of the service's log, and every one from then on, until the iterator is closed, as for `states`.

        Raises
        ------
        ControllerError
            If this user does not have the right to operate.
        """
        return self._subscribed(LogLine, "log")

    def _subscribed(self, kind: type[T], topic: messages.Topic) -> Iterator[T]:
        self._done(messages.Subscribe(id=self._new_id(), to=(topic,)))
        return self._follow(self._notices[kind])

    def _follow(self, kept: deque[T]) -> Iterator[T]:
        try:
            while True:
                while kept:
                    yield kept.popleft()
                self._keep(self._receive(None))  # nobody may touch the panel for hours
        except GeneratorExit:
            if self._socket.fileno() >= 0:
                self._done(messages.Unsubscribe(id=self._new_id()))
                for notices in self._notices.values():
                    notices.clear()

    def arm(self) -> None:
        """Switch the outputs on as soon as the FPGA allows it; `states` reports when they are.

        Raises
        ------
        ControllerError
            If this user does not have the right to operate.
        """
        self._done(messages.Arm(id=self._new_id()))

    def disarm(self) -> None:
        """Ramp the outputs down to 0 V; they stay off until a client arms.

        Raises
        ------
        ControllerError
            If this user does not have the right to operate.
        """
        self._done(messages.Disarm(id=self._new_id()))

    def test_channel(self, channel: int) -> Answer:
        """Play a chirp on one channel alone, and wait for the outcome, as of `play`; for operators."""
        return self._answer(self._ask(messages.ChannelTest(id=self._new_id(), channel=channel)))

    def write_trace(self) -> None:
        """Have the service write what its loop did in the last seconds; its log names the file, `haptic-panel trace` explains it.

        Raises
        ------
        ControllerError
            If this user does not have the right to operate.
        """
        self._done(messages.WriteTrace(id=self._new_id()))

    def stop(self) -> None:
        """As `disarm`, whatever this user's rights are."""
        self._done(messages.Stop(id=self._new_id()))

    def state(self) -> StateAnswer:
        """State of the panel: outputs, cause of a fault, touch panel, temperature."""
        answer = self._wait(self._ask(messages.AskState(id=self._new_id())))
        if isinstance(answer, StateAnswer):
            return answer
        raise _refused(answer)

    def load_scene(self, name: str) -> None:
        """Load another scene of the board; returns when it is in force.

        Raises
        ------
        ControllerError
            If it is refused; the panel keeps the scene before.
        """
        self._done(messages.LoadScene(id=self._new_id(), name=name))

    def figures(self) -> dict[str, Any]:
        """Counters and latencies of the panel so far."""
        answer = self._wait(self._ask(messages.AskFigures(id=self._new_id())))
        if isinstance(answer, FiguresAnswer):
            return answer.figures
        raise _refused(answer)

    def describe(self) -> Description:
        """What the panel is and plays: plate, patches, axes, scene, effects, limits, versions, last faults."""
        answer = self._wait(self._ask(messages.Describe(id=self._new_id())))
        if isinstance(answer, Description):
            return answer
        raise _refused(answer)

    def hello(self) -> Greeting:
        """Version, board, extents in mm, the effects that a command can play, and this user's rights."""
        answer = self._wait(self._ask(messages.Hello(id=self._new_id())))
        if isinstance(answer, Greeting):
            return answer
        raise _refused(answer)

    def _new_id(self) -> int:
        self._last_id += 1
        return self._last_id

    def _ask(self, request: AnyRequest) -> int:
        try:
            self._socket.settimeout(self._timeout_s)
            self._socket.sendall(self._encoder.encode(request) + b"\n")
        except BrokenPipeError:
            self._receive_all()  # its farewell may still be there
            raise LinkError(f"{self._path}: the panel has ended the connection") from None
        except OSError as error:
            raise LinkError(f"{self._path}: the panel does not read what it is sent ({error.strerror or error})") from error
        assert isinstance(request.id, int)
        return request.id

    def _done(self, request: AnyRequest) -> None:
        answer = self._answer(self._ask(request))
        if answer.outcome != "done":
            raise _refused(answer)

    def _answer(self, number: int) -> Answer:
        answer = self._wait(number)
        if isinstance(answer, Answer):
            return answer
        raise LinkError(f"{self._path}: the panel sent an answer of another kind than was asked for: {answer}")

    def _wait(self, number: int) -> Reply:
        while number not in self._answers:
            self._keep(self._receive(self._timeout_s))
        return self._answers.pop(number)

    def _keep(self, message: AnyMessage) -> None:
        if isinstance(message, Farewell) and message.lacks:
            raise ControllerError(f"{self._path}: {message.reason}")
        if isinstance(message, Farewell):
            raise LinkError(f"{self._path}: the panel has ended the connection: {message.reason}")
        if isinstance(message, Reply) and isinstance(message.id, int):
            self._answers[message.id] = message
        elif isinstance(message, Notice):
            self._notices[type(message)].append(message)

    def _receive(self, timeout_s: float | None) -> AnyMessage:
        """Wait for the next message."""
        while True:
            line, end, rest = self._received.partition(b"\n")
            if end:
                self._received = rest
                try:
                    return self._decoder.decode(line)
                except (msgspec.DecodeError, UnicodeDecodeError) as error:
                    raise LinkError(f"{self._path}: the answer is not that of a panel of this version ({error})") from error
            try:
                self._socket.settimeout(timeout_s)
                more = self._socket.recv(RECEIVE_BYTES)
            except TimeoutError:
                raise LinkError(f"{self._path}: the panel does not answer within {self._timeout_s:g} s") from None
            except OSError as error:
                raise LinkError(f"{self._path}: the panel has ended the connection ({error.strerror})") from error
            if not more:
                raise LinkError(f"{self._path}: the panel has ended the connection")
            self._received += more

    def _receive_all(self) -> None:
        """Handle what arrived before the connection ended; raises at its end."""
        while True:
            self._keep(self._receive(self._timeout_s))


def _who_may_connect(path: str) -> str:
    """Message for a user whom the mode of the socket's file keeps out: the group that may connect, and how to join it."""
    user = _name(lambda: pwd.getpwuid(os.geteuid()).pw_name, str(os.geteuid()))
    try:
        number = Path(path).stat().st_gid
    except OSError:
        return f"user {user!r} may not enter the folder of the socket"
    group = _name(lambda: grp.getgrgid(number).gr_name, str(number))
    return f"user {user!r} may not connect, group {group!r} may: have root do `adduser {user} {group}`, and log in again"


def _name(of: Callable[[], str], otherwise: str) -> str:
    try:
        return of()
    except KeyError:
        return otherwise


def _refused(answer: Reply) -> ControllerError:
    return ControllerError(f"the panel refused: {answer.reason}" if isinstance(answer, Answer) else f"unexpected answer: {answer}")


if __name__ == "__main__":
    from controller.device.application_socket.client_commands import main

    raise SystemExit(main())
