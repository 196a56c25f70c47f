"""Which waveform each slot of the FPGA holds: the one played longest ago gives way, unless it is pinned."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable

from controller.bank.selection import NEAR_M, Key

Lone = tuple[float, float, int]  # x and y in m, amplitude in steps below full

FEWEST_FREE = 2  # slots that are never pinned: one sounds, one is being filled


class SlotCache:
    """Slots by the key of what they hold, least recently used first.

    Parameters
    ----------
    slots : int
        Of the FPGA.
    lone : callable
        Place of the one focus of a key, x and y in m, and its amplitude; None where there are several.
    near_m : float
        What is resident for a place at most this far away serves as well, if it is as strong.

    Attributes
    ----------
    slots : int
    """

    def __init__(self, slots: int, lone: Callable[[Key], Lone | None], near_m: float = NEAR_M) -> None:
        self.slots = slots
        self._lone = lone
        self._near_m2 = near_m**2
        self._slot_of: OrderedDict[Key | str, int] = OrderedDict()
        self._lone_of: dict[int, tuple[Key, Lone]] = {}  # what a slot holds, if that is one focus
        self._pinned: set[Key] = set()
        self.forget()

    def find(self, key: Key) -> Key | None:
        """Key under which a waveform that serves is resident; None: it has to be uploaded."""
        if key in self._slot_of:
            return key
        wanted = self._lone(key)
        if wanted is None:
            return None
        x_m, y_m, step = wanted
        for resident, (there_x_m, there_y_m, there_step) in self._lone_of.values():
            if (x_m - there_x_m) ** 2 + (y_m - there_y_m) ** 2 <= self._near_m2 and step == there_step:
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
                slot = self._slot_of.pop(key)
                break
        else:
            slot = self._slot_of.popitem(last=False)[1]
        self._lone_of.pop(slot, None)
        return slot

    def keep(self, key: Key, slot: int) -> None:
        """The slot that was taken holds this waveform now."""
        self._slot_of[key] = slot
        lone = self._lone(key)
        if lone is not None:
            self._lone_of[slot] = key, lone

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
        self._lone_of.clear()
        self._slot_of.update((_empty(slot), slot) for slot in range(self.slots))


def _empty(slot: int) -> str:
    return f"empty {slot}"
