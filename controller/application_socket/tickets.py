"""Commands that wait for their outcome: who is to be answered, in memory that never grows."""

from __future__ import annotations

from typing import NamedTuple

FULL = 0  # never a ticket: to the loop it means that nobody waits
NONE = -1


class Waiting(NamedTuple):
    """Where the answer to a ticket goes: the client, as its `serial`, and the id that it chose; and whose share it takes."""

    serial: int
    id: int | str | None
    uid: int = -1


NOBODY = Waiting(-1, None)


class Tickets:
    """A fixed number of tickets; each is taken, and given back once.

    A ticket is its place plus a multiple of the capacity, from 1 on, another one each time it is taken: an outcome
    that comes twice finds nobody. The free places are a list linked through an array, so that nothing is
    ever moved or resized.

    Parameters
    ----------
    capacity : int
        Commands that can wait at a time.
    """

    def __init__(self, capacity: int) -> None:
        self.waiting = 0
        self._capacity = capacity
        self._ticket = list(range(capacity, 2 * capacity))
        self._holder = [NOBODY] * capacity
        self._next_free = [*range(1, capacity), NONE]
        self._free = 0

    def take(self, holder: Waiting) -> int:
        """A ticket for a command, or FULL."""
        place = self._free
        if place == NONE:
            return FULL
        self._free = self._next_free[place]
        self._holder[place] = holder
        self.waiting += 1
        return self._ticket[place]

    def give_back(self, ticket: int) -> Waiting | None:
        """Who took a ticket; None if it is not out, such as one that was given back before."""
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
