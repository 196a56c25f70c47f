"""What the pins did, evaluated by the limits that the gateware was built with, whatever the host asked for.

One fault adds edges of its own: the change that trips a limit, and the drop of the outputs. It may add them once in a window, as
the stages rest for one then.
"""

from itertools import pairwise

import numpy as np

FAULT_EDGES = 2  # of one channel
FAULT_TICKS = 3  # from a change to the outputs low
DECIDED_TICKS = 36  # from an edge of a channel that is too many to its cause, at most: there may be more of them meanwhile
DUTY_SLACK_TICKS = 40  # what moves on the pins, and what the gateware calls active


def broken_limits(capture, parameters, word_ticks):
    """Sentences, one for each limit that was exceeded; changes so far apart at most, or nearer, are one activity."""
    ticks = capture.ticks.astype(np.int64)
    words, hv = capture.words, capture.hv
    changes = words ^ np.concatenate([[np.uint32(0)], words[:-1]])
    found = []
    if (words & np.uint32(~parameters.channel_mask_max & 0xFFFFFFFF)).any():
        found.append("a channel moved that has no stage")
    if words[hv == 0].any():
        found.append("a channel is high without the high voltage")
    for on, settled in settles(ticks, words, hv):
        if settled - on < parameters.hv_settle_ticks:
            found.append(f"the first edge came {settled - on} ticks behind hv_enable")
    off = ticks[(hv == 0) & (np.concatenate([[0], hv[:-1]]) == 1)]
    for channel in range(32):
        edges = ticks[(changes >> np.uint32(channel) & 1) == 1]
        short = edges[1:][np.diff(edges) < parameters.pulse_ticks_min]
        if not all(np.any((off >= tick) & (off <= tick + FAULT_TICKS)) for tick in short):
            found.append(f"channel {channel} had a short pulse that was not the last")
        most = parameters.channel_edges_max + FAULT_EDGES + DECIDED_TICKS // parameters.pulse_ticks_min
        if most_within(edges, parameters.edge_window_ticks) > most:
            found.append(f"channel {channel} had {most_within(edges, parameters.edge_window_ticks)} edges in a window")
    every = np.repeat(ticks, ones(changes))
    if most_within(every, parameters.edge_window_ticks) > parameters.total_edges_max + 32 * FAULT_EDGES:
        found.append(f"all channels had {most_within(every, parameters.edge_window_ticks)} edges in a window")
    level = highest_level(ticks[changes != 0], parameters.duty_share_max / 65536, word_ticks)
    if level > parameters.duty_ticks_max + DUTY_SLACK_TICKS:
        found.append(f"{level:.0f} ticks of activity ran ahead of the duty")
    return found


def settles(ticks, words, hv):
    """(tick of hv_enable, tick of the first high channel behind it) of each time that it rose."""
    rises = [index for index in range(len(hv)) if hv[index] and (index == 0 or not hv[index - 1])]
    for first, last in pairwise([*rises, len(hv)]):
        moved = np.flatnonzero(words[first:last])
        if moved.size:
            yield ticks[first], ticks[first + moved[0]]


def most_within(ticks, window_ticks):
    """Most of these ticks in any interval of this many."""
    return int((np.searchsorted(ticks, ticks + window_ticks) - np.arange(len(ticks))).max(initial=0))


def ones(words):
    """Bits set in each word."""
    return np.unpackbits(words.view(np.uint8)).reshape(-1, 32).sum(axis=1, dtype=np.int64)


def highest_level(ticks, share, gap_ticks):
    """Most that was ever in a bucket that fills while the pins change every this many ticks, and leaks `share`."""
    level = highest = 0.0
    for gap in np.diff(ticks).tolist():
        level = level + gap * (1 - share) if gap <= gap_ticks else max(level - gap * share, 0.0)
        highest = max(highest, level)
    return highest
