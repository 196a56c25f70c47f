"""Reports of chips on I2C that begin with the number of their contacts: a first read has two of them, a longer one the others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from controller.device.touch.drivers.contact_events import MAX_CONTACTS, ReportedContact
from controller.device.touch.drivers.i2c_bus import I2cBus, Transfer, unless_refused

SHORT_POINTS: Final = 2  # read at once; the rest only when there are more contacts
COUNT_BITS: Final = 0x0F

Report = Sequence[int]


@dataclass(frozen=True)
class CountedReport:
    """Layout of a report in registers that are read from `register` on."""

    register: bytes
    count_at: int  # byte whose bits 3:0 are the number of contacts
    first_point: int
    point_bytes: int
    decode: Callable[[Report, int], ReportedContact | None]  # of the point that begins there; None: no contact

    def contacts(self, report: Report, warnings: Counter[str], *, in_part: bool = False) -> list[ReportedContact] | None:
        """Contacts of a report, as far as read; counts `ghost_points`.

        Returns None if it has more contacts than were read, unless what there is of it is wanted (`in_part`). Raises ValueError if
        it has more than `MAX_CONTACTS` contacts.
        """
        count = report[self.count_at] & COUNT_BITS
        if count > MAX_CONTACTS:
            raise ValueError(f"{count} contacts")
        if len(report) < self.bytes_of(count):
            if not in_part:
                return None
            count = (len(report) - self.first_point) // self.point_bytes
        starts = range(self.first_point, self.bytes_of(count), self.point_bytes)
        return contacts_at(report, starts, self.decode, warnings)

    def bytes_of(self, count: int) -> int:
        """Length of a report of this many contacts."""
        return self.first_point + count * self.point_bytes


def contacts_at(
    report: Report, starts: range, decode: Callable[[Report, int], ReportedContact | None], warnings: Counter[str]
) -> list[ReportedContact]:
    """Contacts of the points that begin at `starts`; those at the corner (0, 0) are counted as `ghost_points` and left out."""
    contacts = []
    for contact in (decode(report, start) for start in starts):
        if contact is None or contact.number >= MAX_CONTACTS:
            continue
        if contact.x == 0 and contact.y == 0:
            warnings["ghost_points"] += 1
        else:
            contacts.append(contact)
    return contacts


def used_without(refused: Sequence[str], bus: str) -> str:
    """Remark on a chip that refuses registers, given in hex; empty if it refuses none."""
    registers = ", ".join(f"0x{register}" for register in refused)
    return f"the touch panel on {bus} refuses registers {registers}: it is used without them" if refused else ""


class CountedReads:
    """Transfers of such reports of the chip at an address; counts `ghost_points` and `points_refused`."""

    def __init__(self, layout: CountedReport, address: int, warnings: Counter[str]) -> None:
        lengths = [layout.bytes_of(count) for count in range(SHORT_POINTS, MAX_CONTACTS + 1)]
        self.short, *self._longer = [Transfer(address, layout.register, length) for length in lengths]
        self._layout, self._warnings = layout, warnings

    def contacts(self, bus: I2cBus) -> list[ReportedContact] | None:
        """All contacts of the report whose beginning is in `short`; of a chip that refuses the others those in it."""
        report = self.short.data
        contacts = self._layout.contacts(report, self._warnings)
        if contacts is not None:
            return contacts
        longer = self._longer[(report[self._layout.count_at] & COUNT_BITS) - SHORT_POINTS - 1]
        with unless_refused():
            bus.fetch(longer)
            return self._layout.contacts(longer.data, self._warnings, in_part=True)  # a contact may have come in between
        self._warnings["points_refused"] += 1
        return self._layout.contacts(report, self._warnings, in_part=True)
