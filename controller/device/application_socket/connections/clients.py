"""The connected clients: who is accepted, who has to leave, and which of their sockets are watched for what."""

from __future__ import annotations

import contextlib
import errno
import math
import select
import socket
from collections.abc import Callable, Iterable, Iterator

import msgspec

from controller.device.application_socket.connections.connection import UNWATCHED, Connection
from controller.device.application_socket.connections.peers import Peer, Rights
from controller.device.application_socket.connections.places import offered
from controller.device.application_socket.connections.socket_file import SocketFile
from controller.device.application_socket.counters import SocketCounters
from controller.device.application_socket.protocol.client_messages import Right, Topic
from controller.device.application_socket.protocol.panel_messages import Farewell
from controller.device.board.devices import ApplicationSocket

NOW = -math.inf
NEVER = math.inf
MAX_EVENTS_A_TURN = 16
ACCEPTS_A_TURN = 2
PAUSE_S = 1e-3  # after an accept, until the listener is watched again; and per client, until one over its rate is read again
LEAVE_S = 1.0  # for a client that was commanded to leave, to read why


class Clients:
    """A fixed number of places for clients, each with the buffers of one `Connection`.

    Raises ConfigError or ControllerError if the socket cannot be created, or belongs to a running service.
    """

    def __init__(self, settings: ApplicationSocket, counters: SocketCounters, peer_of: Callable[[socket.socket], Peer]) -> None:
        self.rights = Rights(settings)
        self.next_s = NEVER  # when to serve although nothing is readable
        self.users = 0  # different ones among the clients that may play
        self.touch_subscribers = 0  # clients
        self.gone: list[int] = []  # serial numbers of clients that had sent regions; whoever removes those empties it
        self._counters = counters
        self._peer_of = peer_of
        self._settings = settings
        self._file = SocketFile(settings)
        self._listener_fd = self._file.listener.fileno()
        self._listen_s = NEVER  # when the listener is watched again
        self._epoll = select.epoll()
        self._epoll.register(self._listener_fd, select.EPOLLIN)
        self.places = [
            Connection(settings.commands_per_s, settings.burst, settings.layer_bytes, settings.layers_per_s)
            for _ in range(settings.max_clients)
        ]
        self.first = 0

    def __iter__(self) -> Iterator[Connection]:
        """Every connected client."""
        return (client for client in self.places if client.open)

    @property
    def connected(self) -> int:
        """How many clients are connected."""
        return sum(client.open for client in self.places)

    def fileno(self) -> int:
        """File that is readable when `receive` has something to do."""
        return self._epoll.fileno()

    def receive(self, now_s: float) -> None:
        """Read once from each client that has sent something, and accept new ones."""
        arrived = False
        for fd, events in self._epoll.poll(0, MAX_EVENTS_A_TURN):
            if fd == self._listener_fd:
                arrived = True
                continue
            client = next(client for client in self.places if client.fd == fd)
            if events & (select.EPOLLHUP | select.EPOLLERR):
                client.deaf = True  # both directions are shut: what it sent is still carried out
            if not client.ended:
                client.receive()
        if arrived:  # after the events: a client may have to give way
            self._accept(now_s)
        if self._listen_s <= now_s:
            self._listen_s = NEVER
            self._epoll.register(self._listener_fd, select.EPOLLIN)

    def begin_turn(self) -> None:
        """Forget when to serve next; each `settle` of the turn may bring that time forward."""
        self.next_s = self._listen_s

    def settle(self, client: Connection, now_s: float) -> None:
        """After a client's lines: send, then watch its socket for what can come next, or disconnect it."""
        client.flush()
        if client.leaving_reason and client.leave_s == NEVER:
            self._counters.slow_readers += 1
            self.unsubscribe(client)
            client.leave_s = now_s + LEAVE_S
        has_line = client.has_line and not client.leaving_reason
        over = client.ended and not has_line and not client.waiting and not client.topics
        if (
            (client.leaving_reason and not client.unsent)
            or client.leave_s <= now_s
            or (client.ended and client.deaf and not has_line)
            or (over and not client.unsent)
        ):
            self._disconnect(client)
            return
        paused = client.resume_s > now_s
        wanted = UNWATCHED if paused else _events(client)
        if wanted != client.watched:
            self._watch(client, wanted)
        self.next_s = min(self.next_s, client.leave_s, client.resume_s if paused else NOW if has_line else NEVER)

    def with_serial(self, serial: int) -> Connection | None:
        """The client with this serial number; None if it has disconnected."""
        return next((client for client in self.places if client.serial == serial), None)

    def pause(self, client: Connection, now_s: float) -> None:
        """Stop reading a client that sends too fast, for the longer the more clients there are."""
        client.resume_s = now_s + PAUSE_S * sum(1 for _ in self)

    def subscribers(self, topic: Topic) -> list[Connection]:
        """Clients that have subscribed to a topic."""
        return [client for client in self.places if topic in client.topics]

    def subscribe(self, client: Connection, topics: Iterable[Topic]) -> None:
        """Have a client receive what belongs to topics, too."""
        client.topics.update(topics)
        self.touch_subscribers = len(self.subscribers("touches"))

    def unsubscribe(self, client: Connection) -> None:
        """Have a client receive nothing but answers."""
        client.topics.clear()
        self.subscribe(client, ())

    def send(self, client: Connection) -> None:
        """Send what is queued for a client; what remains is left to the next turn."""
        client.flush()
        if client.unsent or client.deaf or client.ended or client.leaving_reason:
            self.next_s = NOW

    def close(self) -> None:
        """Disconnect all clients, and remove the socket's file."""
        for client in self:
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
            self._admit(accepted, now_s)
        self._epoll.unregister(self._listener_fd)
        self._listen_s = now_s + PAUSE_S

    def _admit(self, accepted: socket.socket, now_s: float) -> None:
        """Give a new client a place, or tell it why it gets none."""
        peer = self._peer_of(accepted)
        rights = self.rights.of(peer)
        if not rights:
            self._counters.without_right += 1
            _send_away(accepted, self.rights.why_not(peer, "play"), "play")
            return
        place, reason = offered(self.places, peer, rights, self.rights, self._settings, now_s)
        if place is None:
            self._counters.turned_away += 1
            _send_away(accepted, reason)
            return
        if place.open:
            self._counters.gave_way += 1
            place.leave("its place was needed, and it had been silent for longest")
            place.flush()
            self._disconnect(place)
        self._counters.clients_accepted += 1
        place.begin(accepted, self._counters.clients_accepted, now_s, peer, rights)
        self._watch(place, select.EPOLLIN)
        self._count_users()

    def _watch(self, client: Connection, wanted: int) -> None:
        if client.watched == UNWATCHED:
            self._epoll.register(client.fd, wanted)
        elif wanted == UNWATCHED:
            self._epoll.unregister(client.fd)
        else:
            self._epoll.modify(client.fd, wanted)
        client.watched = wanted

    def _disconnect(self, client: Connection) -> None:
        if client.watched != UNWATCHED:
            self._epoll.unregister(client.fd)
        self.unsubscribe(client)
        if client.layered:
            self.gone.append(client.serial)
        client.close()
        self._count_users()

    def _count_users(self) -> None:
        self.users = len({client.peer.uid for client in self if "play" in client.rights})


def _send_away(accepted: socket.socket, reason: str, lacks: Right | None = None) -> None:
    """Tell a client that gets no place why, and close its socket."""
    with accepted, contextlib.suppress(OSError):
        accepted.send(msgspec.json.encode(Farewell(reason=reason, lacks=lacks)) + b"\n")


def _events(client: Connection) -> int:
    """Events to wait for; epoll reports in any case, with 0 too, that a client hangs up."""
    reading = select.EPOLLIN if not client.ended and not client.leaving_reason else 0
    return reading | (select.EPOLLOUT if client.unsent else 0)
