"""Which waveform each slot of the FPGA holds: the one played longest ago gives way, unless it is pinned."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable

from controller.waveforms.selection import REUSE_RADIUS_M, Key

SingleFocus = tuple[float, float, int]  # x and y in m, amplitude in steps below full

MIN_UNPINNED = 2  # slots that are never pinned: one sounds, one is being filled


class SlotCache:
    """Slots and the keys of what they hold, least recently used first.

    Each slot holds one waveform or none, and no two hold the same: `keep` sees to it, whatever it is told.

    Parameters
    ----------
    slots : int
        Of the FPGA.
    single_focus : callable
        Place of the one focus of a key, x and y in m, and its amplitude; None where there are several.
    near_m : float
        What is resident for a place at most this far away serves as well, if it is as strong.

    Attributes
    ----------
    slots : int
    """

    def __init__(self, slots: int, single_focus: Callable[[Key], SingleFocus | None], near_m: float = REUSE_RADIUS_M) -> None:
        self.slots = slots
        self._single_focus = single_focus
        self._near_m2 = near_m**2
        self._held: OrderedDict[int, Key | None] = OrderedDict()  # every slot, always; None: holds nothing
        self._slot_of: dict[Key, int] = {}
        self._single_focus_of: dict[int, tuple[Key, SingleFocus]] = {}  # what a slot holds, if that is one focus
        self._pinned: set[Key] = set()
        self.forget()

    def find(self, key: Key) -> Key | None:
        """Key under which a waveform that serves is resident; None: it has to be uploaded."""
        if key in self._slot_of:
            return key
        wanted = self._focus_of(key)
        if wanted is None:
            return None
        x_m, y_m, step = wanted
        for resident, (there_x_m, there_y_m, there_step) in self._single_focus_of.values():
            if (x_m - there_x_m) ** 2 + (y_m - there_y_m) ** 2 <= self._near_m2 and step == there_step:
                return resident
        return None

    def use(self, key: Key) -> int:
        """Slot of a resident waveform, which counts as played now."""
        slot = self._slot_of[key]
        self._held.move_to_end(slot)
        return slot

    def take(self, spared: int | None = None) -> int:
        """Free the slot that was used longest ago: it holds nothing until `keep`, and is the next to be taken.

        Parameters
        ----------
        spared : int, optional
            A slot that is taken only if it is the only one.
        """
        chosen = None
        for slot, key in self._held.items():
            if slot == spared:
                continue
            if key not in self._pinned:
                chosen = slot
                break
            if chosen is None:  # should all be pinned
                chosen = slot
        taken = next(iter(self._held)) if chosen is None else chosen
        self.drop(taken)
        return taken

    def keep(self, key: Key, slot: int) -> None:
        """A slot holds this waveform now, which counts as played."""
        if key in self._slot_of:
            self.drop(self._slot_of[key])
        self.drop(slot)
        self._held[slot] = key
        self._held.move_to_end(slot)
        self._slot_of[key] = slot
        focus = self._focus_of(key)
        if focus is not None:
            self._single_focus_of[slot] = key, focus

    def drop(self, slot: int) -> None:
        """A slot holds nothing that could be played; it is the next to be taken."""
        key = self._held[slot]
        if key is not None:
            del self._slot_of[key]
            self._single_focus_of.pop(slot, None)
            self._held[slot] = None
        self._held.move_to_end(slot, last=False)

    def pin(self, keys: Iterable[Key]) -> None:
        """Waveforms that stay once they are resident: the first ones, as long as enough slots are left for others."""
        self._pinned = set(list(keys)[: max(self.slots - MIN_UNPINNED, 0)])

    def forget(self) -> None:
        """Take it that the FPGA holds nothing: at the start, and after a fault."""
        self._slot_of.clear()
        self._single_focus_of.clear()
        self._held.clear()
        self._held.update(dict.fromkeys(range(self.slots)))

    def residents(self) -> tuple[tuple[int, Key | None], ...]:
        """Every slot with the key of what it holds, the next to be taken first."""
        return tuple(self._held.items())

    def _focus_of(self, key: Key) -> SingleFocus | None:
        return None if isinstance(key, tuple) and len(key) > 1 else self._single_focus(key)
