"""Every line of a client is answered exactly once: at once, or under a ticket when its outcome is known; and counted."""

from __future__ import annotations

from collections.abc import Callable

from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import Connection, MessageTooLong
from controller.device.application_socket.counters import SocketCounters
from controller.device.application_socket.protocol import panel_messages
from controller.device.application_socket.protocol.client_messages import Id, Right
from controller.device.application_socket.requests.pending_commands import PendingCommands
from controller.device.application_socket.requests.tickets import FULL
from controller.device.loop.preparation import AcceptedLayer, LayerResult
from controller.errors import ControllerError

REASON_CHARACTERS = 250


class Answers:
    """Answers to clients, and the tickets of those that are not known yet."""

    def __init__(self, clients: Clients, pending: PendingCommands, counters: SocketCounters) -> None:
        self.counters = counters  # of every line by its outcome
        self._clients = clients
        self._pending = pending

    def answer(self, client: Connection, number: Id, outcome: panel_messages.Outcome, reason: str = "") -> None:
        """Answer the request with id `number`."""
        self.counters.count(outcome)
        client.put(panel_messages.Answer(id=number, outcome=outcome, reason=reason))

    def data(self, client: Connection, message: panel_messages.Data) -> None:
        """Answer with data; a message that is too long for the client's buffer is refused."""
        try:
            client.put(message)
        except MessageTooLong as error:
            self.answer(client, message.id, "refused", str(error))
        else:
            self.counters.count("done")

    def invalid(self, client: Connection, number: Id, reason: str) -> None:
        """Refuse what is no request, or impossible on this board."""
        self.counters.not_valid += 1
        self.answer(client, number, "refused", reason[:REASON_CHARACTERS])

    def over_rate(self, client: Connection, number: Id) -> None:
        """Refuse what a client sends too soon."""
        self.counters.over_rate += 1
        self.answer(client, number, "refused", "rate")

    def not_allowed(self, client: Connection, number: Id, right: Right) -> None:
        """Refuse what a client has no right to."""
        self.counters.not_allowed += 1
        self.answer(client, number, "refused", self._clients.rights.why_not(client.peer, right))

    def ticket(self, client: Connection, number: Id) -> int:
        """A ticket for a command; FULL if the command was refused because too many are pending."""
        ticket = self._pending.take(client, number)
        if ticket == FULL:
            most = max(client.waiting, self._pending.of_user[client.peer.uid])
            self.answer(client, number, "refused", f"{most} commands wait for their outcome already")
        return ticket

    def begin(self, client: Connection, number: Id, order: Callable[[int], None]) -> bool:
        """Give an order under a ticket, by which its outcome will be answered; whether it was taken: a refusal is answered now."""
        ticket = self.ticket(client, number)
        if ticket == FULL:
            return False
        try:
            order(ticket)
        except ControllerError as error:
            self.outcome(ticket, "refused", reason=str(error))
            return False
        return True

    def outcome(self, ticket: int, outcome: panel_messages.Outcome, *, age_ms: float | None = None, reason: str = "") -> None:
        """Answer the command that took a ticket, and send the answer.

        `age_ms` is from the command to its outcome; `reason` is that of a refusal.
        """
        found = self._take_back(ticket, outcome)
        if found is not None:
            self._send(found[1], panel_messages.Answer(id=found[0], outcome=outcome, age_ms=age_ms, reason=reason))

    def loaded(self, ticket: int, reason: str) -> None:
        """Answer a command to load or save a scene; an empty reason: the scene is in force, or saved."""
        self.outcome(ticket, "refused" if reason else "done", reason=reason)

    def layered(self, ticket: int, result: LayerResult) -> None:
        """Answer a command that replaces a client's regions."""
        layer = result.accepted
        if layer is None:
            self.outcome(ticket, "refused" if result.reason else "merged", reason=result.reason)
            return
        found = self._take_back(ticket, "done")
        if found is not None:
            self._send(found[1], _layer_answer(found[0], layer, result.age_s))

    def _take_back(self, ticket: int, outcome: panel_messages.Outcome) -> tuple[Id, Connection] | None:
        """Take back a ticket; the request's id and the client to answer, or None if it has disconnected."""
        found = self._pending.give_back(ticket)
        if found is None:
            self.counters.stray_outcomes += 1
            return None
        self.counters.count(outcome)
        holder, client = found
        if client is None:
            self.counters.unanswered += 1
            return None
        return holder.id, client

    def _send(self, client: Connection, message: panel_messages.Answer | panel_messages.LayerAnswer) -> None:
        client.put(message)
        self._clients.send(client)


def _layer_answer(number: Id, layer: AcceptedLayer, age_s: float) -> panel_messages.LayerAnswer:
    """Answer to the request with id `number`: its layer is in force."""
    return panel_messages.LayerAnswer(
        id=number,
        regions=len(layer.regions),
        off_plate=layer.off_plate,
        age_ms=round(age_s * 1e3, 3),
        refused=layer.refused,
        refused_count=layer.refused_count,
    )
