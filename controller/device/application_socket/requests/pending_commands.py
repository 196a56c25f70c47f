"""Commands without an outcome yet: how many a client and a user may have, and who is answered."""

from __future__ import annotations

import math
from collections import Counter

from controller.device.application_socket.connections.clients import Clients
from controller.device.application_socket.connections.connection import Connection
from controller.device.application_socket.protocol.client_messages import Id
from controller.device.application_socket.requests.tickets import FULL, Tickets, Waiting
from controller.device.loop.playing.due_emissions import MAX_WAITING_COMMANDS

WAITING_PER_CLIENT = 64


class PendingCommands:
    """Tickets of commands without an outcome, with a limit for each of `max_clients` clients and for each user."""

    def __init__(self, clients: Clients, max_clients: int) -> None:
        self.of_user: Counter[int] = Counter()  # pending commands by uid; only users with any
        self._clients = clients
        self._tickets = Tickets(WAITING_PER_CLIENT * max_clients)

    def __len__(self) -> int:
        return self._tickets.waiting

    def take(self, client: Connection, number: Id) -> int:
        """Ticket for a client's command; FULL if the client or its user has too many pending."""
        uid = client.peer.uid
        if client.waiting >= WAITING_PER_CLIENT or self.of_user[uid] >= self._share:
            return FULL
        ticket = self._tickets.take(Waiting(client.serial, number, uid))
        if ticket != FULL:
            client.waiting += 1
            self.of_user[uid] += 1
        return ticket

    def give_back(self, ticket: int) -> tuple[Waiting, Connection | None] | None:
        """Who is to be answered, and its connection unless it has disconnected; None if nobody holds this ticket."""
        holder = self._tickets.give_back(ticket)
        if holder is None:
            return None
        self.of_user[holder.uid] -= 1
        if not self.of_user[holder.uid]:
            del self.of_user[holder.uid]
        client = self._clients.with_serial(holder.serial)
        if client is not None:
            client.waiting -= 1
        return holder, client

    @property
    def _share(self) -> float:
        """Most pending commands of one user.

        With several users connected, each has an equal share of what the scheduler holds: the commands of one never displace
        those of another.
        """
        users = self._clients.users
        return math.inf if users < 2 else max(MAX_WAITING_COMMANDS // users, 1)
