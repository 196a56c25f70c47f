"""The application socket as the event loop sees it: a `CommandSource` with bounded memory and bounded time per turn.

Whatever clients send, a turn reads each of them once, answers at most `LINES_A_TURN` lines and accepts at most
`clients.ACCEPTS_A_TURN` clients. The rest waits for later turns, between which the loop does its other work.
"""

from __future__ import annotations

import socket
from collections.abc import Callable, Sequence

from controller.application_socket.clients import Clients
from controller.application_socket.counters import SocketCounters
from controller.application_socket.notifications import Notifications
from controller.application_socket.peers import Peer, peer_of
from controller.application_socket.pending_commands import PendingCommands
from controller.application_socket.requests import Requests
from controller.application_socket.switched_off import SwitchedOff
from controller.board.board import Board
from controller.board.devices import ApplicationSocket
from controller.board.panel_state import Condition
from controller.loop.commands import Outcome, PanelControl
from controller.touch.source import TouchSample

LINES_A_TURN = 16  # of all clients
LINES_A_CLIENT = 8  # of these, of one client


class CommandSocket:
    """The application socket of a board.

    Parameters
    ----------
    board : Board
    settings : ApplicationSocket
        Path and access rights of the socket, and what each client may ask.
    peer_of : callable, optional
        Identifies the process at the other end of an accepted socket.

    Attributes
    ----------
    counters : SocketCounters

    Raises
    ------
    ConfigError, ControllerError
        If the socket cannot be created, or belongs to a running service.
    """

    def __init__(self, board: Board, settings: ApplicationSocket, peer_of: Callable[[socket.socket], Peer] = peer_of) -> None:
        self.counters = SocketCounters()
        self._clients = Clients(settings, self.counters, peer_of)
        self._pending = PendingCommands(self._clients, settings.max_clients)
        self._notifications = Notifications(self._clients)
        self._switched_off = SwitchedOff(settings.path)
        self._requests = Requests(
            board, settings.max_amplitude, self._clients, self._pending, self._notifications, self._switched_off, self.counters
        )

    @property
    def disarmed(self) -> bool:
        """Whether a client, of this service or of one before it that died, has disarmed the panel and none has armed it since."""
        return bool(self._switched_off)

    @property
    def waiting(self) -> int:
        """Commands without an outcome yet."""
        return len(self._pending)

    def fileno(self) -> int:
        """File to wait on for reading."""
        return self._clients.fileno()

    def next_time_s(self) -> float:
        """When to call `serve` although the file is not readable, in s of the host's clock; inf: never."""
        return self._clients.next_s

    def serve(self, now_s: float, control: PanelControl) -> None:
        """Read what clients sent, a bounded part of it, and answer what can be answered."""
        clients = self._clients
        clients.receive(now_s)
        clients.begin_turn()
        left, count = LINES_A_TURN, len(clients.places)
        for number in range(clients.first, clients.first + count):
            client = clients.places[number % count]
            if client.open:
                if left and client.resume_s <= now_s:
                    left -= self._requests.serve(client, min(left, LINES_A_CLIENT), now_s, control)
                    clients.first = (number + 1) % count  # the next turn begins with the client after the last one served
                clients.settle(client, now_s)

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Send the touch samples of one report to the clients that subscribed to touches."""
        self._notifications.touches(samples)

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Answer a command to play, `age_s` after it was given."""
        self._requests.answer_ticket(ticket, outcome.value, age_ms=round(age_s * 1e3, 3))

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load a scene; an empty reason: the scene is in force."""
        self._requests.loaded(ticket, reason)

    def changed(self, condition: Condition) -> None:
        """Keep the panel's new condition, and send it to the clients that subscribed to states."""
        self._notifications.changed(condition)

    def close(self) -> None:
        """Disconnect all clients, and remove the socket's file."""
        self._clients.close()
