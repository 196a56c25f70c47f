"""Which disc each channel moves, from where a finger felt it: swapped wires between discs, and channels that move nothing.

A voltage on one channel bulges the glass most at its own quadrant, less at the others of its disc, and at any other disc by less
than a fifth of that: a finger tells the disc, not the quadrant.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from controller.device.board.board import Board
from controller.device.board.plate.patches import discs

Place = tuple[float, float]  # x and y on the plate


@dataclass(frozen=True, slots=True)
class ChannelMap:
    """Where channels were felt."""

    discs: list[list[int]]  # channels of each disc, by board.toml
    felt_at: dict[int, int | None]  # by channel, the number of the disc nearest to the finger; None: nothing was felt
    wrong: list[str]  # what is wrong, one line each


def channel_map(board: Board, places: Mapping[int, Place | None]) -> ChannelMap:
    """Evaluate where each channel was felt. `places` are where the finger was (x_m, y_m), by channel; None: nothing was felt."""
    groups = discs(board.actuators)
    centres = [(sum(one.x_mm for one in group) / len(group), sum(one.y_mm for one in group) / len(group)) for group in groups]
    channels = [sorted(one.channel for one in group) for group in groups]
    own = {channel: index for index, group in enumerate(channels) for channel in group}
    felt = {channel: None if place is None else _nearest(centres, place) for channel, place in places.items()}
    astray = {channel: at for channel, at in felt.items() if at is not None and at != own[channel]}
    wrong = [f"channel {channel}: nothing was felt: a dead stage, wire or patch" for channel, at in felt.items() if at is None]
    back = {
        channel: [other for other, its in astray.items() if own[other] == at and its == own[channel]]
        for channel, at in astray.items()
    }
    for channel, at in astray.items():
        if len(back[channel]) == 1 and back[back[channel][0]] == [channel]:
            if channel < (other := back[channel][0]):
                wrong.append(f"channels {channel} and {other} are swapped: swap their wires, or their `channel` in board.toml")
        else:
            where = ", ".join(map(str, channels[at]))
            wrong.append(f"channel {channel} moves the disc of channels {where}: look at its wire, or at the places in board.toml")
    return ChannelMap(channels, felt, wrong)


def _nearest(centres_mm: Sequence[Place], place: Place) -> int:
    at_mm = place[0] * 1e3, place[1] * 1e3
    return min(range(len(centres_mm)), key=lambda disc: math.dist(centres_mm[disc], at_mm))
