"""A client's side of the application socket: requests go out, answers come back by their ids, and what comes unasked is kept."""

from __future__ import annotations

import contextlib
import grp
import os
import pwd
import socket
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar, get_args

import msgspec

from controller.device.application_socket.protocol import client_messages, panel_messages
from controller.device.application_socket.protocol.client_messages import AnyRequest
from controller.device.application_socket.protocol.panel_messages import (
    Answer,
    AnyMessage,
    ContactNotice,
    Data,
    Description,
    Emissions,
    Farewell,
    FaultNotice,
    LayerAnswer,
    LogLine,
    StateAnswer,
    Touch,
)
from controller.errors import ControllerError, LinkError

T = TypeVar("T", bound="Notice")
D = TypeVar("D", bound="Reply")
RECEIVE_BYTES = 65536
MAX_KEPT = 1000  # of each kind that arrive while an answer is awaited; older ones are dropped

Notice = Touch | ContactNotice | Emissions | StateAnswer | FaultNotice | Description | LogLine
Reply = Answer | LayerAnswer | Data


class Silent(LinkError):
    """Nothing has come in time."""


class PanelLink:
    """A connection to a running panel, for use by one thread at a time; its methods raise what those of `PanelClient` do."""

    def __init__(self, path: str, timeout_s: float) -> None:
        self._path = path
        self._timeout_s = timeout_s
        self._encoder = msgspec.json.Encoder()
        self._decoder = panel_messages.message_decoder()
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

    def close(self) -> None:
        """End the connection."""
        self._socket.close()

    def follow(self, kind: type[T], topic: client_messages.Topic) -> Iterator[T]:
        """Everything of a topic from this call on, until the iterator is closed, which ends all topics."""
        self.done(client_messages.Subscribe(to=(topic,)))
        return self._follow(self._notices[kind])

    def heard(self, kind: type[T], wait_s: float) -> list[T]:
        """What has come of a kind that was subscribed to; if nothing has, wait so long for a message of any kind."""
        kept = self._notices[kind]
        if not kept:
            with contextlib.suppress(Silent):
                self._keep(self._receive(wait_s))
        found = list(kept)
        kept.clear()
        return found

    def _follow(self, kept: deque[T]) -> Iterator[T]:
        try:
            while True:
                while kept:
                    yield kept.popleft()
                self._keep(self._receive(None))  # nobody may touch the panel for hours
        except GeneratorExit:
            if self._socket.fileno() >= 0:
                self.done(client_messages.Unsubscribe())
                for notices in self._notices.values():
                    notices.clear()

    def ask(self, request: AnyRequest) -> int:
        """Send a request under an id that none has had; the id to wait for."""
        self._last_id += 1
        numbered = msgspec.structs.replace(request, id=self._last_id)
        try:
            self._socket.settimeout(self._timeout_s)
            self._socket.sendall(self._encoder.encode(numbered) + b"\n")
        except BrokenPipeError:
            self._receive_all()  # its farewell may still be there
            raise LinkError(f"{self._path}: the panel has ended the connection") from None
        except OSError as error:
            raise LinkError(f"{self._path}: the panel does not read what it is sent ({error.strerror or error})") from error
        return self._last_id

    def done(self, request: AnyRequest) -> None:
        """Send a request, and wait until it is done; ControllerError if it is refused."""
        answer = self.answer(self.ask(request))
        if answer.outcome != "done":
            raise _refused(answer)

    def question(self, request: AnyRequest, kind: type[D]) -> D:
        """Send a question, and wait for its answer; ControllerError if it is refused."""
        answer = self._wait(self.ask(request))
        if isinstance(answer, kind):
            return answer
        raise _refused(answer)

    def answer(self, number: int) -> Answer:
        """Wait for the outcome of a request."""
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
            except (TimeoutError, BlockingIOError):  # the latter without any wait
                raise Silent(f"{self._path}: the panel does not answer within {self._timeout_s:g} s") from None
            except OSError as error:
                raise LinkError(f"{self._path}: the panel has ended the connection ({error.strerror})") from error
            if not more:
                raise LinkError(f"{self._path}: the panel has ended the connection")
            self._received += more

    def _receive_all(self) -> None:
        """Handle what arrived before the connection ended; raises at its end."""
        while True:
            self._keep(self._receive(self._timeout_s))


def _refused(answer: Reply) -> ControllerError:
    return ControllerError(f"the panel refused: {answer.reason}" if isinstance(answer, Answer) else f"unexpected answer: {answer}")


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
