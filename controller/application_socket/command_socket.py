"""The loop's end of the application socket: a `CommandSource` of bounded memory and bounded time a turn.

However many clients send whatever they like: a turn reads each once, handles at most `LINES_A_TURN`
lines of all and accepts at most `ACCEPTS_A_TURN` clients. What is left waits, and other work of the
loop comes in between.
"""

from __future__ import annotations

import contextlib
import errno
import math
import select
import socket
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import msgspec

from controller import __version__
from controller.application_socket import messages
from controller.application_socket.connection import UNWATCHED, Connection, LineTooLong, MessageTooLong
from controller.application_socket.messages import LEAST_AMPLITUDE, AnyRequest, Id, Play
from controller.application_socket.peers import Peer, Right, Rights, peer_of
from controller.application_socket.socket_file import SocketFile
from controller.application_socket.tickets import FULL, Tickets, Waiting
from controller.board.board import Board
from controller.board.devices import ApplicationSocket
from controller.board.panel_state import Condition
from controller.errors import ControllerError
from controller.log import Priority, tell
from controller.loop.commands import Outcome, PanelControl
from controller.loop.scheduler import MOST_WAITING
from controller.touch.source import TouchSample

NOW = -math.inf
NEVER = math.inf
EVENTS_A_TURN = 16
LINES_A_TURN = 16  # of all clients
LINES_A_CLIENT = 8  # of these, of one client
ACCEPTS_A_TURN = 2
PAUSE_S = 1e-3  # for which a client over its rate is not read, times the number of clients; and the listener after an accept
LEAVE_S = 1.0  # a client that was told to go may take this long to read why
WAITING_PER_CLIENT = 64  # commands without an outcome
FIGURES_S = 1.0  # the same figures are told for this long: they cost the loop milliseconds
REASON_CHARACTERS = 200


@dataclass(slots=True)
class SocketCounters:
    """What came over the socket; each of `lines` was played, merged, skipped, refused or done, or still waits."""

    clients: int = 0
    turned_away: int = 0  # because there were as many as the board allows, of all or of one user
    without_right: int = 0  # clients that may not even play; they are told and let go
    gave_way: int = 0  # silent ones whose place was needed
    told_to_go: int = 0  # because they did not read
    lines: int = 0
    played: int = 0
    merged: int = 0
    skipped: int = 0
    refused: int = 0  # for any reason, `over_rate` and `not_valid` included
    done: int = 0  # commands that are not to play
    over_rate: int = 0
    not_allowed: int = 0  # commands that the client has no right to
    not_valid: int = 0  # what cannot be read, or be meant on this board
    unanswered: int = 0  # outcomes that nobody was told: the client had gone
    stray_outcomes: int = 0  # of tickets that nobody holds: a mistake of this program


class CommandSocket:
    """Clients of the application socket.

    Parameters
    ----------
    board : Board
        Whose plate it is.
    settings : ApplicationSocket
        Where the socket is, for whom, and how much each client may ask.
    peer_of : callable, optional
        Tells who has connected.

    Raises
    ------
    ConfigError, ControllerError
        If the socket cannot be made, or belongs to a running service.
    """

    def __init__(self, board: Board, settings: ApplicationSocket, peer_of: Callable[[socket.socket], Peer] = peer_of) -> None:
        self.counters = SocketCounters()
        self.condition = Condition()
        self._board = board
        self._max_amplitude = settings.max_amplitude
        self._rights = Rights(settings)
        self._peer_of = peer_of
        self._clients_per_user = settings.clients_per_user
        self._idle_s = settings.idle_s
        self._file = SocketFile(settings)
        self._disarmed = Path(f"{settings.path}.disarmed")
        self._listener_fd = self._file.listener.fileno()
        self._listen_s = NEVER  # when the listener is looked at again
        self._epoll = select.epoll()
        self._epoll.register(self._listener_fd, select.EPOLLIN)
        self._clients = [Connection(settings.commands_per_s, settings.burst) for _ in range(settings.max_clients)]
        self._first = 0  # who is served first: the one after whom a turn's lines were used up before
        self._tickets = Tickets(WAITING_PER_CLIENT * settings.max_clients)
        self._requests = messages.request_decoder()
        self._numbers = msgspec.json.Decoder(messages.Numbered)
        self._figures: dict[str, Any] = {}
        self._figures_until_s = -math.inf
        self._waiting_of: Counter[int] = Counter()  # commands without an outcome, by user
        self._share = math.inf  # of these, the most that one user may have
        self._subscribers = 0
        self._next_s = NEVER

    @property
    def disarmed(self) -> bool:
        """Whether the panel was disarmed and not armed again, by a client of this service or of one before it that has died."""
        return self._disarmed.exists()

    def fileno(self) -> int:
        """File to wait on for reading."""
        return self._epoll.fileno()

    def next_time_s(self) -> float:
        """When to call `serve` though the file is not readable; inf: never."""
        return self._next_s

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Read what clients sent, a bounded part of it, and answer what can be answered."""
        knocks = False
        for fd, events in self._epoll.poll(0, EVENTS_A_TURN):
            if fd == self._listener_fd:
                knocks = True
                continue
            client = next(client for client in self._clients if client.fd == fd)
            if events & (select.EPOLLHUP | select.EPOLLERR):
                client.deaf = True  # both ways are shut: what it sent still counts
            if not client.ended:
                client.receive()
        if knocks:  # after the events: a client may have to give way
            self._accept(now_s)
        if self._listen_s <= now_s:
            self._listen_s = NEVER
            self._epoll.register(self._listener_fd, select.EPOLLIN)
        left = LINES_A_TURN
        self._next_s = next_s = self._listen_s
        first, count = self._first, len(self._clients)
        for number in range(count):
            client = self._clients[(first + number) % count]
            if client.open:
                if left and client.resume_s <= now_s:
                    left -= self._handle_lines(client, min(left, LINES_A_CLIENT), now_s, control)
                    self._first = (first + number + 1) % count
                next_s = min(next_s, self._settle(client, now_s))
        self._next_s = min(self._next_s, next_s)  # an outcome may have come meanwhile

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Tell those who asked for touches."""
        if not self._subscribers:
            return
        for client in self._clients:
            if client.open and client.subscribed:
                for finger, x_m, y_m, time_s, contact, size_m in samples:
                    client.put(
                        messages.Touch(
                            finger=finger,
                            x_mm=round(x_m * 1e3, 3),
                            y_mm=round(y_m * 1e3, 3),
                            time_s=time_s,
                            contact=contact,
                            size_mm=round(size_m * 1e3, 3),
                        )
                    )
                self._send(client)

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Answer a command to play, `age_s` after it was given."""
        self._answer_ticket(ticket, outcome.value, age_ms=round(age_s * 1e3, 3))

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load a scene; an empty reason: it was taken over."""
        outcome: messages.Outcome = "refused" if reason else "done"
        self._answer_ticket(ticket, outcome, reason=reason)

    def changed(self, condition: Condition) -> None:
        """Take note of how the panel is, and tell those who asked for it."""
        self.condition = condition
        for client in self._clients:
            if client.open and client.informed:
                client.put(self._state(None))
                self._send(client)

    def close(self) -> None:
        """Let all clients go."""
        for client in self._clients:
            if client.open:
                client.leave("the service ends")
                client.flush()
                client.close()
        self._epoll.close()
        self._file.close()

    def _accept(self, now_s: float) -> None:
        for _ in range(ACCEPTS_A_TURN):
            try:
                accepted, _ = self._file.listener.accept()
            except BlockingIOError:
                break
            except OSError as error:
                if error.errno not in (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM, errno.ECONNABORTED):
                    raise
                break
            accepted.setblocking(False)
            self._receive(accepted, now_s)
        self._epoll.unregister(self._listener_fd)
        self._listen_s = now_s + PAUSE_S

    def _receive(self, accepted: socket.socket, now_s: float) -> None:
        """Give a new client a place, or tell it why not."""
        peer = self._peer_of(accepted)
        rights = self._rights.of(peer)
        if not rights:
            self.counters.without_right += 1
            _send_away(accepted, self._rights.why_not(peer, "play"), "play")
            return
        place, reason = self._place_for(peer, rights, now_s)
        if place is None:
            self.counters.turned_away += 1
            _send_away(accepted, reason)
            return
        self.counters.clients += 1
        place.begin(accepted, self.counters.clients, now_s, peer, rights)
        self._watch(place, select.EPOLLIN)
        self._share_anew()

    def _place_for(self, peer: Peer, rights: tuple[Right, ...], now_s: float) -> tuple[Connection | None, str]:
        """A place, or why there is none.

        No user has more than a share of the places. Where none is left, the client that has been silent for longest gives
        way: if that is long enough, or if somebody comes who may switch the panel off.
        """
        operator = "operate" in rights
        there = [client for client in self._clients if client.open]
        own = [client for client in there if client.peer.uid == peer.uid]
        reason = ""
        if not operator and len(own) >= self._clients_per_user:
            there, reason = own, f"{len(own)} clients of {self._rights.called(peer)} are connected already"
        elif len(there) == len(self._clients):
            reason = f"{len(there)} clients are connected already"
        else:
            return next(client for client in self._clients if not client.open), ""
        idle = [client for client in there if client.silent and now_s - client.heard_s >= self._idle_s]
        if operator and not idle:
            idle = [client for client in there if "operate" not in client.rights]
        if not idle:
            return None, reason
        gone = min(idle, key=lambda client: (not client.silent, client.heard_s))
        self.counters.gave_way += 1
        gone.leave("its place was needed, and it had been silent for longest")
        gone.flush()
        self._let_go(gone)
        return gone, ""

    def _handle_lines(self, client: Connection, most: int, now_s: float, control: PanelControl) -> int:
        """Answer at most so many of a client's lines; how many it were."""
        for done in range(most):
            if client.leaving_reason:
                return done
            try:
                line = client.next_line()
            except LineTooLong as error:
                self.counters.lines += 1
                client.take_token(now_s)
                self._refuse_invalid(client, None, str(error))
                continue
            if line is None:
                return done
            self.counters.lines += 1
            client.heard_s = now_s
            if client.take_token(now_s):
                self._handle(client, line, now_s, control)
            else:
                self.counters.over_rate += 1
                client.resume_s = now_s + PAUSE_S * sum(other.open for other in self._clients)
                self._answer(client, self._id_of(line), "refused", "rate")
        return most

    def _handle(self, client: Connection, line: memoryview, now_s: float, control: PanelControl) -> None:
        try:
            request = self._requests.decode(line)
        except UnicodeDecodeError:
            self._refuse_invalid(client, self._id_of(line), "not UTF-8")
            return
        except (msgspec.DecodeError, RecursionError) as error:
            self._refuse_invalid(client, self._id_of(line), str(error)[:REASON_CHARACTERS])
            return
        if isinstance(request, Play):
            self._play(client, request, now_s, control)
        else:
            self._do(client, request, now_s, control)

    def _play(self, client: Connection, play: Play, now_s: float, control: PanelControl) -> None:
        amplitude = self._max_amplitude if play.amplitude is None else play.amplitude
        reason = self._why_not(play, amplitude)
        if reason:
            self._refuse_invalid(client, play.id, reason)
            return
        ticket = self._ticket(client, play.id)
        if ticket == FULL:
            return
        x_m, y_m = (play.x_mm or 0.0) * 1e-3, (play.y_mm or 0.0) * 1e-3
        try:
            control.play(ticket, play.effect, x_m, y_m, play.finger, amplitude, now_s)
        except ControllerError as error:
            self._answer_ticket(ticket, "refused", reason=str(error))

    def _why_not(self, play: Play, amplitude: float) -> str:
        """What is wrong with a command to play; empty if nothing is."""
        if not LEAST_AMPLITUDE <= amplitude <= self._max_amplitude:
            return f"amplitude = {amplitude:g} is not {LEAST_AMPLITUDE:g} to {self._max_amplitude:g}"
        if play.finger is not None:
            return "" if play.x_mm is None and play.y_mm is None else "either x_mm and y_mm, or finger"
        if play.x_mm is None or play.y_mm is None:
            return "either x_mm and y_mm, or finger"
        plate = self._board.plate
        if not 0.0 <= play.x_mm <= plate.length_mm:
            return f"x_mm = {play.x_mm:g} is off the plate (0 to {plate.length_mm:g})"
        if not 0.0 <= play.y_mm <= plate.width_mm:
            return f"y_mm = {play.y_mm:g} is off the plate (0 to {plate.width_mm:g})"
        return ""

    def _do(self, client: Connection, request: AnyRequest, now_s: float, control: PanelControl) -> None:
        """All but `Play`."""
        match request:
            case messages.Arm() | messages.Disarm() | messages.LoadScene() if "operate" not in client.rights:
                self.counters.not_allowed += 1
                self._answer(client, request.id, "refused", self._rights.why_not(client.peer, "operate"))
            case messages.Arm() | messages.Disarm():
                on = isinstance(request, messages.Arm)
                tell(f"{self._rights.called(client.peer)} {'arms' if on else 'disarms'} the panel")
                control.switch(on)
                self._remember(on)
                self._answer(client, request.id, "done")
            case messages.AskState(id=number):
                self._tell(client, self._state(number))
            case messages.LoadScene(id=number, name=name):
                ticket = self._ticket(client, number)
                if ticket == FULL:
                    return
                try:
                    control.load_scene(ticket, name)
                except ControllerError as error:
                    self.loaded(ticket, str(error))
                else:
                    tell(f"{self._rights.called(client.peer)} loads the scene {name!r}")
            case messages.AskFigures(id=number):
                if now_s >= self._figures_until_s:
                    self._figures, self._figures_until_s = control.figures(), now_s + FIGURES_S
                figures = self._figures | {
                    "state": self.condition.state.value,
                    "cause": self.condition.cause,
                    "application_socket": asdict(self.counters),
                }
                self._tell(client, messages.Figures(id=number, figures=figures))
            case messages.Hello(id=number):
                self._tell(
                    client,
                    messages.Greeting(
                        id=number,
                        version=__version__,
                        board=self._board.name,
                        length_mm=self._board.plate.length_mm,
                        width_mm=self._board.plate.width_mm,
                        max_amplitude=self._max_amplitude,
                        effects=control.effects(),
                        rights=client.rights,
                    ),
                )
            case messages.Subscribe(to=to):
                self._subscribe(client, client.subscribed or "touches" in to)
                self._answer(client, request.id, "done")
                if "state" in to:
                    client.informed = True
                    client.put(self._state(None))
            case messages.Unsubscribe():
                self._unsubscribe(client)
                self._answer(client, request.id, "done")

    def _remember(self, on: bool) -> None:
        """Beside the socket, for a service that has to take the place of this one."""
        try:
            if on:
                self._disarmed.unlink(missing_ok=True)
            else:
                self._disarmed.touch(mode=0o600)
        except OSError as error:
            tell(f"{self._disarmed}: {error.strerror}: a restart would not know that the panel was switched", Priority.WARNING)

    def _state(self, number: Id) -> messages.State:
        now = self.condition
        return messages.State(
            id=number,
            state=now.state.value,
            cause=now.cause,
            outputs_on=now.outputs_on,
            panel_present=now.panel_present,
            temperature_c=now.temperature_c,
        )

    def _tell(self, client: Connection, message: messages.Figures | messages.Greeting | messages.State) -> None:
        """Answer by what was asked for."""
        try:
            client.put(message)
        except MessageTooLong as error:
            self._answer(client, message.id, "refused", str(error))
        else:
            self._count("done")

    def _subscribe(self, client: Connection, wanted: bool) -> None:
        self._subscribers += wanted - client.subscribed
        client.subscribed = wanted

    def _unsubscribe(self, client: Connection) -> None:
        self._subscribe(client, False)
        client.informed = False

    def _ticket(self, client: Connection, number: Id) -> int:
        """A ticket for a command; FULL if it had to be refused."""
        uid = client.peer.uid
        waiting = self._waiting_of[uid]
        full = client.waiting >= WAITING_PER_CLIENT or waiting >= self._share
        ticket = FULL if full else self._tickets.take(Waiting(client.serial, number, uid))
        if ticket == FULL:
            most = max(client.waiting, waiting)
            self._answer(client, number, "refused", f"{most} commands wait for their outcome already")
        else:
            client.waiting += 1
            self._waiting_of[uid] = waiting + 1
        return ticket

    def _share_anew(self) -> None:
        """Where there are several users, what those of one have waiting never pushes out what another has on the plate."""
        users = len({client.peer.uid for client in self._clients if client.open})
        self._share = math.inf if users < 2 else max(MOST_WAITING // users, 1)

    def _answer_ticket(self, ticket: int, outcome: messages.Outcome, *, age_ms: float | None = None, reason: str = "") -> None:
        holder = self._tickets.give_back(ticket)
        if holder is None:
            self.counters.stray_outcomes += 1
            return
        self._waiting_of[holder.uid] -= 1
        if not self._waiting_of[holder.uid]:
            del self._waiting_of[holder.uid]
        self._count(outcome)
        client = next((client for client in self._clients if client.serial == holder.serial), None)
        if client is None:
            self.counters.unanswered += 1
            return
        client.waiting -= 1
        client.put(messages.Answer(id=holder.id, outcome=outcome, age_ms=age_ms, reason=reason))
        self._send(client)

    def _refuse_invalid(self, client: Connection, number: Id, reason: str) -> None:
        self.counters.not_valid += 1
        self._answer(client, number, "refused", reason)

    def _answer(self, client: Connection, number: Id, outcome: messages.Outcome, reason: str = "") -> None:
        self._count(outcome)
        client.put(messages.Answer(id=number, outcome=outcome, reason=reason))

    def _count(self, outcome: messages.Outcome) -> None:
        setattr(self.counters, outcome, getattr(self.counters, outcome) + 1)

    @property
    def waiting(self) -> int:
        """Commands without an outcome yet."""
        return self._tickets.waiting

    def _id_of(self, line: memoryview) -> Id:
        """The id of a line that is refused, if it can be told."""
        try:
            return self._numbers.decode(line).id
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return None

    def _send(self, client: Connection) -> None:
        """Send what is queued, and see to the rest in the next turn."""
        client.flush()
        if client.unsent or client.deaf or client.ended or client.leaving_reason:
            self._next_s = NOW

    def _settle(self, client: Connection, now_s: float) -> float:
        """After a client's lines: send, watch for what can come next, or let it go; when to look again without an event."""
        client.flush()
        if client.leaving_reason and client.leave_s == NEVER:
            self.counters.told_to_go += 1
            self._unsubscribe(client)
            client.leave_s = now_s + LEAVE_S
        has_line = client.has_line and not client.leaving_reason
        over = client.ended and not has_line and not client.waiting and not client.subscribed and not client.informed
        if (
            (client.leaving_reason and not client.unsent)
            or client.leave_s <= now_s
            or (client.ended and client.deaf and not has_line)
            or (over and not client.unsent)
        ):
            self._let_go(client)
            return NEVER
        paused = client.resume_s > now_s
        wanted = UNWATCHED if paused else _events(client)
        if wanted != client.watched:
            self._watch(client, wanted)
        if paused:
            return min(client.resume_s, client.leave_s)
        return NOW if has_line else client.leave_s

    def _watch(self, client: Connection, wanted: int) -> None:
        if client.watched == UNWATCHED:
            self._epoll.register(client.fd, wanted)
        elif wanted == UNWATCHED:
            self._epoll.unregister(client.fd)
        else:
            self._epoll.modify(client.fd, wanted)
        client.watched = wanted

    def _let_go(self, client: Connection) -> None:
        if client.watched != UNWATCHED:
            self._epoll.unregister(client.fd)
        self._unsubscribe(client)
        client.close()
        self._share_anew()


def _send_away(accepted: socket.socket, reason: str, lacks: Right | None = None) -> None:
    """Tell a client why it has to go at once."""
    with accepted, contextlib.suppress(OSError):
        accepted.send(msgspec.json.encode(messages.Farewell(reason=reason, lacks=lacks)) + b"\n")


def _events(client: Connection) -> int:
    """What to wait for; that a client hangs up is told in any case, with 0 too."""
    reading = select.EPOLLIN if not client.ended and not client.leaving_reason else 0
    return reading | (select.EPOLLOUT if client.unsent else 0)
