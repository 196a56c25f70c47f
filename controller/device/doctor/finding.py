"""Result of one check of `haptic-panel doctor`."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Finding:
    """Result of a check.

    Attributes
    ----------
    about : str
        What was checked.
    good : bool
        Whether it works.
    said : str
        What was found, or what to do.
    warns : bool
        Whether it works and is still not as one would expect.
    """

    about: str
    good: bool
    said: str
    warns: bool = False
