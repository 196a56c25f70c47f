"""Oddities of touch panels and recordings: handled, counted by kind, told once."""

from __future__ import annotations

from collections.abc import Mapping

KINDS = {
    "garbage_lines": "lines that are not evemu text were skipped",
    "not_utf8": "lines with bytes that are not UTF-8",
    "unknown_version": "version line of a newer evemu format: read as far as understood",
    "no_axis_lines": "axes without a usable range: the recording's own minimum and maximum taken",
    "time_backwards": "events earlier than the one before: their time was taken as the same",
    "time_absurd": "events with an impossible time: played at the time of the one before",
    "value_absurd": "event values beyond 32 bits were clamped",
    "outside_axes": "positions outside the axes were clamped",
    "slot_beyond_range": "contacts in slots that the device does not declare were decoded all the same",
    "slot_absurd": "slot numbers that no device has: their events were skipped",
    "contacts_absurd": "contacts beyond 256 in one report were skipped",
    "never_reported": "events after the last SYN_REPORT were not played",
    "dropped": "losses of events (SYN_DROPPED): fingers released or read again",
    "more_than_played": "contacts beyond the ten that are played were left out",
    "time_ahead": "reports from the future: their time was taken as now",
    "panel_lost": "times the touch panel was gone; fingers released until it came back",
    "bus_retried": "transfers on the touch panel's bus that failed and were tried again",
    "report_absurd": "reports of the touch panel that cannot be meant were skipped",
    "ghost_points": "points at (0, 0) that the touch panel made up were skipped",
    "stale_reports": "reports from before the touch panel was started were skipped",
    "contact_stuck": "contacts that the touch panel went silent about were released",
    "bytes_skipped": "bytes from the serial touch panel that were no packet",
    "still_down_at_end": "fingers still down at the end of the recording were released",
}


def in_words(warnings: Mapping[str, int]) -> list[str]:
    """One line for each kind, with its count."""
    return [f"{count} × {KINDS[kind]}" for kind, count in warnings.items() if count]
