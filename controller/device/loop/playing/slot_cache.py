"""Which waveform each slot of the FPGA holds; the least recently used one is replaced, unless it is pinned."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import Final

from controller.device.waveforms.selection import REUSE_RADIUS_M, Key

SingleFocus = tuple[float, float, int]  # x and y in m, amplitude in steps below full

MIN_UNPINNED: Final = 2  # slots: one plays, one is being filled


class _Resident:
    """A waveform of one focus that a slot holds."""

    __slots__ = ("key", "step", "x_m", "y_m")

    def __init__(self, key: Key, x_m: float, y_m: float, step: int) -> None:
        self.key: Final = key
        self.x_m: Final = x_m
        self.y_m: Final = y_m
        self.step: Final = step


class SlotCache:
    """Slots and the keys of the waveforms in them, least recently used first.

    Each slot holds one waveform or none, and no two slots hold the same one.

    `single_focus` gives x_m, y_m and amplitude step of a key with one focus, None for a key with several. A resident waveform for a
    place at most `near_m` away is used as well, if its amplitude is the same; negative: none is. Unless `reuses`, what a slot holds
    is never found, so that everything is uploaded each time (`loop.skips`).
    """

    def __init__(
        self, slots: int, single_focus: Callable[[Key], SingleFocus | None], near_m: float = REUSE_RADIUS_M, *, reuses: bool = True
    ) -> None:
        self.slots = slots
        self._reuses = reuses
        self._single_focus = single_focus
        self._near_m = near_m
        # every slot, the next one to be taken first, with the key of its waveform; None: it holds none
        self.held: OrderedDict[int, Key | None] = OrderedDict()
        self._slot_of: dict[Key, int] = {}
        self._single_foci: dict[int, _Resident] = {}  # what a slot holds, if that is one focus
        self._pinned: set[Key] = set()
        self.clear()

    def find(self, key: Key) -> Key | None:
        """Key of a resident waveform that can be played for `key`: the same, or one for a place near by; None if there is none."""
        if key in self._slot_of:
            return key
        wanted = self._single_focus(key) if isinstance(key, int) or len(key) == 1 else None
        if wanted is None:
            return None
        x_m, y_m, step = wanted
        near_m = self._near_m
        for resident in self._single_foci.values():
            if abs(x_m - resident.x_m) <= near_m and step == resident.step:
                off_x_m, off_y_m = x_m - resident.x_m, y_m - resident.y_m
                if off_x_m * off_x_m + off_y_m * off_y_m <= near_m * near_m:
                    return resident.key
        return None

    def use(self, key: Key) -> int:
        """Slot of a resident waveform, which becomes the most recently used one."""
        slot = self._slot_of[key]
        self.held.move_to_end(slot)
        return slot

    def take(self, spared: int | None = None) -> int:
        """Empty the least recently used slot; until `keep` it is the next one to be taken.

        The slot `spared` is taken only if there is no other.
        """
        chosen = None
        for slot, key in self.held.items():
            if slot == spared:
                continue
            if key not in self._pinned:
                chosen = slot
                break
            if chosen is None:  # if all are pinned
                chosen = slot
        taken = next(iter(self.held)) if chosen is None else chosen
        self.drop(taken)
        return taken

    def keep(self, key: Key, slot: int) -> None:
        """Take note that a slot holds the waveform of `key`; it is the most recently used one."""
        if key in self._slot_of:
            self.drop(self._slot_of[key])
        if self.held[slot] is not None:
            self.drop(slot)
        self.held[slot] = key
        self.held.move_to_end(slot)
        if not self._reuses:
            return
        self._slot_of[key] = slot
        focus = self._single_focus(key) if isinstance(key, int) or len(key) == 1 else None
        if focus is not None:
            self._single_foci[slot] = _Resident(key, *focus)

    def drop(self, slot: int) -> None:
        """Take note that what a slot holds cannot be played; it is the next one to be taken."""
        key = self.held[slot]
        if key is not None:
            self._slot_of.pop(key, None)
            self._single_foci.pop(slot, None)
            self.held[slot] = None
        self.held.move_to_end(slot, last=False)

    def pin(self, keys: Iterable[Key]) -> None:
        """Let the waveforms of these keys stay once they are resident: the first ones, as far as `MIN_UNPINNED` slots are left."""
        self._pinned = set(list(keys)[: max(self.slots - MIN_UNPINNED, 0)])

    def clear(self) -> None:
        """Take note that the FPGA holds nothing: at the start, and after a fault."""
        self._slot_of.clear()
        self._single_foci.clear()
        self.held.clear()
        self.held.update(dict.fromkeys(range(self.slots)))
