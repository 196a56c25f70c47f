"""Which contact of protocol A is which: by tracking id where the device sends one, else by distance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from controller.touch.axes import Axes

FIRST_SERIAL = 1 << 32  # identities given here, above every tracking id (32 bits signed)
MAX_STEP_M = 0.03  # between two reports, 3 m/s at 100 Hz: farther off, it is another finger


@dataclass(slots=True, eq=False)
class Contact:
    """What is known of one contact, or of one slot."""

    identity: int
    x: int | None = None
    y: int | None = None
    moved: bool = False
    hovers: bool = False
    palm: bool = False
    counted: bool = False
    refused: bool = False
    finger: int | None = None
    x_m: float = 0.0
    y_m: float = 0.0
    size: int = 0  # ABS_MT_TOUCH_MAJOR
    size_m: float = 0.0


def associate(old: dict[int, Contact], new: list[Contact], axes: Axes, serials: Iterator[int]) -> dict[int, Contact]:
    """Carry what is known of the contacts of the last report over to those of a new one.

    Parameters
    ----------
    old : dict
        Contacts of the last report by identity.
    new : list of Contact
        Contacts of this report, each with both positions and the device's tracking id, negative without one.
    axes : Axes
        Gives distances on the plate.
    serials : iterator of int
        Identities for new contacts without tracking id, from FIRST_SERIAL on.

    Returns
    -------
    dict
        Contacts of this report by identity, the old ones updated in place. Of two with the same
        tracking id the first counts.
    """
    now: dict[int, Contact] = {}
    unnamed = []
    for contact in new:
        if contact.identity < 0:
            unnamed.append(contact)
        elif contact.identity not in now:
            now[contact.identity] = _moved(old.get(contact.identity), contact)
    strangers = [was for was in old.values() if was.identity >= FIRST_SERIAL]
    pairs = sorted((_distance_m(was, is_now, axes), i, j) for i, was in enumerate(strangers) for j, is_now in enumerate(unnamed))
    partner: dict[int, Contact] = {}
    taken = set()
    for distance_m, i, j in pairs:
        if distance_m <= MAX_STEP_M and i not in taken and j not in partner:
            partner[j] = strangers[i]
            taken.add(i)
    for j, contact in enumerate(unnamed):
        if j not in partner:
            contact.identity = next(serials)
        same = _moved(partner.get(j), contact)
        now[same.identity] = same
    return now


def _moved(was: Contact | None, is_now: Contact) -> Contact:
    if was is None:
        return is_now
    was.moved = (was.x, was.y) != (is_now.x, is_now.y)
    was.x, was.y, was.palm, was.size = is_now.x, is_now.y, is_now.palm, is_now.size
    return was


def _distance_m(was: Contact, is_now: Contact, axes: Axes) -> float:
    return math.dist(_place_m(was, axes), _place_m(is_now, axes))


def _place_m(contact: Contact, axes: Axes) -> tuple[float, float]:
    return axes.place_m(*axes.clamp(contact.x or 0, contact.y or 0))
