"""The application socket as the event loop sees it: a `CommandSource` with bounded memory and bounded time per turn.

Whatever clients send, a turn reads each of them once, answers at most `LINES_A_TURN` lines and accepts at most
`clients.ACCEPTS_A_TURN` clients. The rest waits for later turns, between which the loop does its other work.
"""

from __future__ import annotations

import socket
import time
from collections.abc import Callable, Sequence

from controller.device.application_socket.connections.clients import NOW, Clients
from controller.device.application_socket.connections.peers import Peer, peer_of
from controller.device.application_socket.counters import SocketCounters
from controller.device.application_socket.requests.answers import Answers
from controller.device.application_socket.requests.layer_requests import LayerRequests
from controller.device.application_socket.requests.operator_requests import OperatorRequests
from controller.device.application_socket.requests.pending_commands import PendingCommands
from controller.device.application_socket.requests.play_requests import PlayRequests
from controller.device.application_socket.requests.questions import Questions
from controller.device.application_socket.requests.requests import Requests
from controller.device.application_socket.subscriptions.emission_notices import EmissionNotices
from controller.device.application_socket.subscriptions.notifications import Notifications
from controller.device.application_socket.switched_off import SwitchedOff
from controller.device.board.board import Board
from controller.device.board.devices import ApplicationSocket
from controller.device.board.panel_state import Condition
from controller.device.loop.commands import Outcome
from controller.device.loop.control import PanelControl
from controller.device.loop.preparation import LayerResult
from controller.device.touch.source import TouchSample

LINES_A_TURN = 16  # of all clients
LINES_A_CLIENT = 8  # of these, of one client


class CommandSocket:
    """The application socket of a board.

    Raises ConfigError or ControllerError if the socket cannot be created, or belongs to a running service.
    """

    def __init__(
        self,
        board: Board,
        settings: ApplicationSocket,  # path and access rights of the socket, and what each client may ask
        peer_of: Callable[[socket.socket], Peer] = peer_of,  # identifies the process at the other end of an accepted socket
        clock_s: Callable[[], float] = time.monotonic,  # host time, of faults
    ) -> None:
        self.counters = SocketCounters()
        self._clients = Clients(settings, self.counters, peer_of)
        self._pending = PendingCommands(self._clients, settings.max_clients)
        self._notifications = Notifications(self._clients)
        self._emissions = EmissionNotices(self._clients)
        self._switched_off = SwitchedOff(settings.path)
        self._scene_changed = False
        self._clock_s = clock_s
        self._answers = Answers(self._clients, self._pending, self.counters)
        self._questions = Questions(board, settings, self._clients, self._answers, self._notifications, self._emissions)
        self._requests = Requests(
            self._clients,
            self._answers,
            PlayRequests(board, settings, self._answers),
            LayerRequests(settings, self._answers),
            OperatorRequests(board, self._clients.rights, self._answers, self._switched_off),
            self._questions,
        )

    @property
    def disarmed_by(self) -> str:
        """The client of this service, or of one before it that died, that switched the panel off; empty once it is armed."""
        return self._switched_off.by

    @property
    def waiting(self) -> int:
        """Commands without an outcome yet."""
        return len(self._pending)

    def fileno(self) -> int:
        """File to wait on for reading."""
        return self._clients.fileno()

    def next_time_s(self) -> float:
        """When to call `serve` although the file is not readable, in s of the host's clock; inf: never."""
        if self._notifications.has_lines:
            return NOW
        clients_s, emissions_s = self._clients.next_s, self._emissions.next_s()
        return clients_s if clients_s < emissions_s else emissions_s

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
        if self._scene_changed:
            self._scene_changed = False
            for client in clients.subscribers("description"):
                self._questions.describe_to(client, control)
                clients.send(client)
        self._emissions.serve(now_s, control, self._notifications.condition.temperature_c)
        self._notifications.lines()
        while clients.gone:
            control.drop_layer(clients.gone.pop(), now_s)

    def touches(self, samples: Sequence[TouchSample]) -> None:
        """Send the touch samples of one report to the clients that subscribed to touches."""
        self._notifications.touches(samples)
        self._emissions.stirred()

    def outcome(self, ticket: int, outcome: Outcome, age_s: float) -> None:
        """Answer a command to play, `age_s` after it was given."""
        self._answers.outcome(ticket, outcome.value, age_ms=round(age_s * 1e3, 3))
        self._emissions.stirred()

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load a scene; an empty reason: the scene is in force."""
        self._answers.loaded(ticket, reason)

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Answer a command that replaces a client's regions."""
        self._answers.layered(ticket, result)

    def changed(self, condition: Condition) -> None:
        """Keep the panel's new condition, and send it to the clients that subscribed to states."""
        self._notifications.changed(condition, self._clock_s())

    def scene_changed(self) -> None:
        """Describe the panel again, in the next turn, to the clients that subscribed to that."""
        self._scene_changed = True
        self._clients.next_s = NOW

    def close(self) -> None:
        """Disconnect all clients, and remove the socket's file."""
        self._clients.close()
