"""Identities of the contacts of protocol A: by tracking id if the device sends one, else by predicted position.

Contacts without tracking ids are assigned all at once: the assignment with the smallest sum of squared distances between the
predicted position of each old contact and a new one. Assigning the nearest first would swap fingers that pass each other
within a few mm.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from controller.device.touch.axes import PanelAxes

# Values of Contact.identity besides the tracking ids of the device, which are never negative
NO_CONTACT: Final = -1
UNKNOWN: Final = -2  # no identity yet, as a finger may have been down before the stream began: with a position, one is down

# Values of Contact.settled
ASK, DOWN, UP = 0, 1, 2

FIRST_SERIAL = 1 << 32  # identities assigned here, above every tracking id (32 bits signed)
MAX_SPEED = 3.0  # m/s from one report to the next; farther away it is another finger
MIN_STEP_M = 0.03  # so far at least, however soon the next report comes
MIN_INTERVAL_S, MAX_INTERVAL_S = 2e-3, 50e-3  # no panel reports faster; after a longer pause the velocity is unknown
VELOCITY_GAIN = 0.7  # weight of the last step in the velocity


@dataclass(slots=True, eq=False)
class Contact:
    """State of one contact, or of one slot."""

    identity: int  # tracking id, serial number from `FIRST_SERIAL` on, or `NO_CONTACT`, `UNKNOWN`
    finger: int | None = None  # number in the samples; None while it is not played
    x_m: float = 0.0  # x_m, y_m, size_m: of its last sample
    y_m: float = 0.0
    size_m: float = 0.0
    x: int | None = None  # x, y: raw position; None before the first one
    y: int | None = None
    width_m: float = 0.0  # as it is reported now; 0: not at all
    moved: bool = False  # the position has changed since the last sample
    settled: int = ASK  # whether it is down and no palm, or is not, as was decided once and is so while only its position changes
    hovers: bool = False  # hovers, tool_palm: as the device reports it
    tool_palm: bool = False
    palm: bool = False  # it has been a palm since it began
    counted: bool = False  # it is among the contacts counted
    refused: bool = False  # it began while ten fingers were played
    silent: bool = False  # its panel has fallen silent: it is no finger until the panel reports it again
    at_x_m: float = 0.0  # without a tracking id: position of its last report, and velocity in m/s
    at_y_m: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    stepped: int = 0  # number of the report of its last sample
    held: int = 0  # number of the report whose position waits for the next one; 0: none does
    held_x_m: float = 0.0  # that position, NaN if it is no place of a finger
    held_y_m: float = 0.0
    held_s: float = 0.0  # time of the last report before
    step_vx: float = math.nan  # velocity in m/s of the last step between two samples; NaN before the first
    step_vy: float = math.nan


def associate(
    old: dict[int, Contact], new: list[Contact], axes: PanelAxes, serials: Iterator[int], step_s: float
) -> dict[int, Contact]:
    """Carry the state of the contacts of the last report over to those of a new one.

    `old` holds contacts by identity; each of `new` has both positions and the device's tracking id, negative without one. `serials`
    gives identities for new contacts without one, from FIRST_SERIAL on; `step_s` has passed since the last report. Returns the
    contacts of this report by identity, the old ones updated in place; of two contacts with one tracking id the first counts.
    """
    now: dict[int, Contact] = {}
    untracked = []
    for contact in new:
        if contact.identity < 0:
            contact.at_x_m, contact.at_y_m = axes.position_m(*axes.clamp(contact.x or 0, contact.y or 0))
            untracked.append(contact)
        elif contact.identity not in now:
            now[contact.identity] = _carried_over(old.get(contact.identity), contact)
    old_untracked = [contact for contact in old.values() if contact.identity >= FIRST_SERIAL]
    partners = _partners(old_untracked, untracked, step_s)
    for contact, partner in zip(untracked, partners, strict=True):
        if partner is None:
            contact.identity = next(serials)
        else:
            _update_velocity(partner, contact, step_s)
        same = _carried_over(partner, contact)
        now[same.identity] = same
    return now


def assignment(costs: Sequence[Sequence[float]]) -> list[int]:
    """Assign a column to each row, each column at most once, with the smallest sum of costs.

    Shortest augmenting paths (Jonker and Volgenant, Computing 38, 1987); a row whose cheapest column no other row prefers is
    assigned at once.

    `costs` has at least as many columns as rows, inf for an impossible pair, and at least one finite cost in each row. Returns the
    column of each row.
    """
    rows, columns = range(len(costs)), range(len(costs[0]) if costs else 0)
    row_of = [-1 for _ in columns]
    column_of = [-1 for _ in rows]
    row_dual = [min(row) for row in costs]
    column_dual = [0.0 for _ in columns]
    for i in rows:
        j = costs[i].index(row_dual[i])
        if row_of[j] < 0:
            row_of[j], column_of[i] = i, j
    for start in rows:
        if column_of[start] >= 0:
            continue
        distance = [costs[start][j] - row_dual[start] - column_dual[j] for j in columns]
        came_from = [start for _ in columns]
        scanned: list[int] = []
        unscanned = list(columns)
        while True:
            end = min(unscanned, key=distance.__getitem__)
            if row_of[end] < 0:
                break
            unscanned.remove(end)
            scanned.append(end)
            i = row_of[end]
            for j in unscanned:
                through = distance[end] + costs[i][j] - row_dual[i] - column_dual[j]
                if through < distance[j]:
                    distance[j], came_from[j] = through, i
        row_dual[start] += distance[end]
        for j in scanned:
            row_dual[row_of[j]] += distance[end] - distance[j]
            column_dual[j] -= distance[end] - distance[j]
        j = end
        while True:  # along the path, each row takes the next column
            i = came_from[j]
            row_of[j], column_of[i], j = i, j, column_of[i]
            if i == start:
                break
    return column_of


def _partners(old: Sequence[Contact], new: Sequence[Contact], step_s: float) -> list[Contact | None]:
    """Old contact of each new one, None for a new finger; a released contact costs as much as the farthest step."""
    partners: list[Contact | None] = [None] * len(new)
    if not old or not new:
        return partners
    ahead_s = step_s if 0.0 < step_s <= MAX_INTERVAL_S else 0.0
    farthest = max(MIN_STEP_M, MAX_SPEED * min(step_s, MAX_INTERVAL_S)) ** 2
    released = [farthest] * len(old)
    costs = []
    for contact in old:
        if contact.held:  # its last report may have been an error
            x_m, y_m = contact.x_m, contact.y_m
        else:
            x_m, y_m = contact.at_x_m + contact.vx * ahead_s, contact.at_y_m + contact.vy * ahead_s
        squares = [(x_m - other.at_x_m) ** 2 + (y_m - other.at_y_m) ** 2 for other in new]
        costs.append([square if square <= farthest else math.inf for square in squares] + released)
    for contact, column in zip(old, assignment(costs), strict=True):
        if column < len(new):
            partners[column] = contact
    return partners


def _update_velocity(old: Contact, new: Contact, step_s: float) -> None:
    """Update the velocity of a contact with its last step."""
    if step_s > MAX_INTERVAL_S or old.held:
        old.vx = old.vy = 0.0
    elif step_s > 0.0:
        gain_hz = VELOCITY_GAIN / max(step_s, MIN_INTERVAL_S)
        old.vx += gain_hz * (new.at_x_m - old.at_x_m) - VELOCITY_GAIN * old.vx
        old.vy += gain_hz * (new.at_y_m - old.at_y_m) - VELOCITY_GAIN * old.vy
    old.at_x_m, old.at_y_m = new.at_x_m, new.at_y_m


def _carried_over(old: Contact | None, new: Contact) -> Contact:
    if old is None:
        return new
    old.moved = (old.x, old.y) != (new.x, new.y)
    old.x, old.y, old.tool_palm, old.width_m, old.settled = new.x, new.y, new.tool_palm, new.width_m, ASK
    return old
