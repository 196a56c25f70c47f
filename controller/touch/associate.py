"""Which contact of protocol A is which: by tracking id where the device sends one, else by where each was going.

Without tracking ids all contacts of a report are assigned at once: the pairing with the smallest sum of squared distances
between where each contact would be by its velocity, and where one is. Nearest first would swap fingers that pass each
other within a few mm.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from controller.touch.axes import Axes

FIRST_SERIAL = 1 << 32  # identities given here, above every tracking id (32 bits signed)
MAX_STEP_M = 0.03  # between two reports, 3 m/s at 100 Hz: farther off, it is another finger
SHORTEST_STEP_S, PAUSE_S = 2e-3, 50e-3  # no panel reports faster; after a pause nothing is known of a velocity
VELOCITY_SHARE = 0.7  # of the last step, in the velocity


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
    x_m: float = 0.0  # of its last sample
    y_m: float = 0.0
    size: int = 0  # ABS_MT_TOUCH_MAJOR
    size_m: float = 0.0
    at_x_m: float = 0.0  # without a tracking id: at its last report, and its velocity in m/s
    at_y_m: float = 0.0
    vx: float = 0.0
    vy: float = 0.0


def associate(old: dict[int, Contact], new: list[Contact], axes: Axes, serials: Iterator[int], step_s: float) -> dict[int, Contact]:
    """Carry what is known of the contacts of the last report over to those of a new one.

    Parameters
    ----------
    old : dict
        Contacts of the last report by identity.
    new : list of Contact
        Contacts of this report, each with both positions and the device's tracking id, negative without one.
    axes : Axes
        Gives places on the plate.
    serials : iterator of int
        Identities for new contacts without tracking id, from FIRST_SERIAL on.
    step_s : float
        From the last report to this one.

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
            contact.at_x_m, contact.at_y_m = axes.place_m(*axes.clamp(contact.x or 0, contact.y or 0))
            unnamed.append(contact)
        elif contact.identity not in now:
            now[contact.identity] = _moved(old.get(contact.identity), contact)
    strangers = [was for was in old.values() if was.identity >= FIRST_SERIAL]
    partners = _partners(strangers, unnamed, step_s)
    for contact, partner in zip(unnamed, partners, strict=True):
        if partner is None:
            contact.identity = next(serials)
        else:
            _drive(partner, contact, step_s)
        same = _moved(partner, contact)
        now[same.identity] = same
    return now


def assignment(costs: Sequence[Sequence[float]]) -> list[int]:
    """Column of each row, another for each, with the smallest sum of costs.

    Shortest augmenting paths (Jonker and Volgenant, Computing 38, 1987); a row whose cheapest column nobody else wants
    costs one look.

    Parameters
    ----------
    costs : (row, column) sequences of float
        At least as many columns as rows; inf where a pair cannot be, at least one cost of a row finite.
    """
    rows, columns = range(len(costs)), range(len(costs[0]) if costs else 0)
    row_of = [-1 for _ in columns]
    column_of = [-1 for _ in rows]
    price = [min(row) for row in costs]
    discount = [0.0 for _ in columns]
    for i in rows:
        j = costs[i].index(price[i])
        if row_of[j] < 0:
            row_of[j], column_of[i] = i, j
    for start in rows:
        if column_of[start] >= 0:
            continue
        away = [costs[start][j] - price[start] - discount[j] for j in columns]
        came_from = [start for _ in columns]
        tied: list[int] = []
        untied = list(columns)
        while True:
            end = min(untied, key=away.__getitem__)
            if row_of[end] < 0:
                break
            untied.remove(end)
            tied.append(end)
            i = row_of[end]
            for j in untied:
                through = away[end] + costs[i][j] - price[i] - discount[j]
                if through < away[j]:
                    away[j], came_from[j] = through, i
        price[start] += away[end]
        for j in tied:
            price[row_of[j]] += away[end] - away[j]
            discount[j] -= away[end] - away[j]
        j = end
        while True:  # along the path, each row takes the next column
            i = came_from[j]
            row_of[j], column_of[i], j = i, j, column_of[i]
            if i == start:
                break
    return column_of


def _partners(old: Sequence[Contact], new: Sequence[Contact], step_s: float) -> list[Contact | None]:
    """The old contact that each new one is; one that has gone costs as much as the farthest step."""
    partners: list[Contact | None] = [None] * len(new)
    if not old or not new:
        return partners
    ahead_s = step_s if 0.0 < step_s <= PAUSE_S else 0.0
    farthest = MAX_STEP_M * MAX_STEP_M
    gone = [farthest] * len(old)
    costs = []
    for was in old:
        x_m, y_m = was.at_x_m + was.vx * ahead_s, was.at_y_m + was.vy * ahead_s
        squares = [(x_m - is_now.at_x_m) ** 2 + (y_m - is_now.at_y_m) ** 2 for is_now in new]
        costs.append([square if square <= farthest else math.inf for square in squares] + gone)
    for was, column in zip(old, assignment(costs), strict=True):
        if column < len(new):
            partners[column] = was
    return partners


def _drive(was: Contact, is_now: Contact, step_s: float) -> None:
    """Take the velocity of a contact from its last step."""
    if step_s > PAUSE_S:
        was.vx = was.vy = 0.0
    elif step_s > 0.0:
        share_hz = VELOCITY_SHARE / max(step_s, SHORTEST_STEP_S)
        was.vx += share_hz * (is_now.at_x_m - was.at_x_m) - VELOCITY_SHARE * was.vx
        was.vy += share_hz * (is_now.at_y_m - was.at_y_m) - VELOCITY_SHARE * was.vy
    was.at_x_m, was.at_y_m = is_now.at_x_m, is_now.at_y_m


def _moved(was: Contact | None, is_now: Contact) -> Contact:
    if was is None:
        return is_now
    was.moved = (was.x, was.y) != (is_now.x, is_now.y)
    was.x, was.y, was.palm, was.size = is_now.x, is_now.y, is_now.palm, is_now.size
    return was
