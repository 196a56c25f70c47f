"""Tickets: numbers under which the event loop reports outcomes, and who is to be answered, in memory of fixed size."""

from __future__ import annotations

from typing import NamedTuple

FULL = 0  # never a ticket: to the loop it means that nobody waits for the outcome
NONE = -1


class Waiting(NamedTuple):
    """Holder of a ticket: serial number of the client, id of its request, and user whose share of commands it counts to."""

    serial: int
    id: int | str | None
    uid: int = -1


NOBODY = Waiting(-1, None)


class Tickets:
    """A fixed number of tickets; each is taken, then given back once.

    A ticket is the index of its place plus a multiple of the capacity that grows each time the place is taken: a second
    outcome for the same ticket finds no holder. Free places form a list linked through an array, so that nothing is moved or
    resized.
    """

    def __init__(self, capacity: int) -> None:
        self.waiting = 0
        self._capacity = capacity
        self._ticket = list(range(capacity, 2 * capacity))
        self._holder = [NOBODY] * capacity
        self._next_free = [*range(1, capacity), NONE]
        self._free = 0

    def take(self, holder: Waiting) -> int:
        """Take a ticket; FULL if all are taken."""
        place = self._free
        if place == NONE:
            return FULL
        self._free = self._next_free[place]
        self._holder[place] = holder
        self.waiting += 1
        return self._ticket[place]

    def give_back(self, ticket: int) -> Waiting | None:
        """Return a ticket; its holder, or None if it was not taken or was given back before."""
        place = ticket % self._capacity
        holder = self._holder[place]
        if holder is NOBODY or self._ticket[place] != ticket:
            return None
        self._holder[place] = NOBODY
        self._ticket[place] = ticket + self._capacity
        self._next_free[place] = self._free
        self._free = place
        self.waiting -= 1
        return holder
