"""Result of one check of `haptic-panel doctor`."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Finding:
    """Result of a check."""

    about: str  # what was checked
    good: bool  # whether it works
    said: str  # what was found, or what to do
    warns: bool = False  # whether it works and is still not as one would expect
