"""Counters of the application socket, as the `figures` command reports them."""

from __future__ import annotations

from dataclasses import dataclass

from controller.device.application_socket.protocol.panel_messages import Outcome


@dataclass(slots=True)
class SocketCounters:
    """What happened on the socket so far.

    Each of `lines` is counted in exactly one of `played`, `merged`, `skipped`, `refused` and `done`, or still waits.
    """

    clients_accepted: int = 0  # so far
    turned_away: int = 0  # no place left, for all clients or for those of one user
    without_right: int = 0  # clients that may not even play: they are informed and disconnected
    gave_way: int = 0  # silent clients disconnected because their place was needed
    slow_readers: int = 0  # disconnected because they did not read
    lines: int = 0  # received
    played: int = 0
    merged: int = 0
    skipped: int = 0
    refused: int = 0  # for any reason, `over_rate`, `not_allowed` and `not_valid` included
    done: int = 0  # commands other than play
    over_rate: int = 0
    not_allowed: int = 0  # commands that the client has no right to
    not_valid: int = 0  # malformed, or impossible on this board
    unanswered: int = 0  # outcomes of clients that had disconnected
    stray_outcomes: int = 0  # outcomes of tickets that nobody holds: an error of this program

    def count(self, outcome: Outcome) -> None:
        """Count one line by its outcome."""
        setattr(self, outcome, getattr(self, outcome) + 1)
