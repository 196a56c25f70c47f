"""Which waveform each slot of the FPGA holds: the one played longest ago gives way, unless it is pinned."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable

from controller.bank.selection import Key

FEWEST_FREE = 2  # slots that are never pinned: one sounds, one is being filled


class SlotCache:
    """Slots by the key of what they hold, least recently used first.

    Parameters
    ----------
    slots : int
        Of the FPGA.
    serves : callable
        Whether what is resident under the second key may be played for the first.

    Attributes
    ----------
    slots : int
    """

    def __init__(self, slots: int, serves: Callable[[Key, Key], bool]) -> None:
        self.slots = slots
        self._serves = serves
        self._slot_of: OrderedDict[Key | str, int] = OrderedDict()
        self._pinned: set[Key] = set()
        self.forget()

    def find(self, key: Key) -> Key | None:
        """Key under which a waveform that serves is resident; None: it has to be uploaded."""
        if key in self._slot_of:
            return key
        for resident in reversed(self._slot_of):
            if not isinstance(resident, str) and self._serves(key, resident):
                return resident
        return None

    def use(self, key: Key) -> int:
        """Slot of a resident waveform, which counts as played now."""
        self._slot_of.move_to_end(key)
        return self._slot_of[key]

    def take(self) -> int:
        """Free the slot that was used longest ago; it holds nothing until `keep` or `empty` is called."""
        for key in self._slot_of:
            if key not in self._pinned:
                return self._slot_of.pop(key)
        return self._slot_of.popitem(last=False)[1]

    def keep(self, key: Key, slot: int) -> None:
        """The slot that was taken holds this waveform now."""
        self._slot_of[key] = slot

    def empty(self, slot: int) -> None:
        """The slot that was taken holds nothing; it is the next to be taken."""
        self._slot_of[_empty(slot)] = slot
        self._slot_of.move_to_end(_empty(slot), last=False)

    def pin(self, keys: Iterable[Key]) -> None:
        """Waveforms that stay once they are resident: the first ones, as long as enough slots are left for others."""
        self._pinned = set(list(keys)[: max(self.slots - FEWEST_FREE, 0)])

    def forget(self) -> None:
        """Take it that the FPGA holds nothing: at the start, and after a fault."""
        self._slot_of.clear()
        self._slot_of.update((_empty(slot), slot) for slot in range(self.slots))


def _empty(slot: int) -> str:
    return f"empty {slot}"
