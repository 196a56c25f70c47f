"""Files that wake the selector; a source may close its file and open another one at any time."""

from __future__ import annotations

import contextlib
import selectors


class WatchedFiles:
    """Registrations of a selector, by name.

    Parameters
    ----------
    selector : BaseSelector
    """

    def __init__(self, selector: selectors.BaseSelector) -> None:
        self._selector = selector
        self._registered: dict[str, int] = {}

    def watch(self, name: str, fileno: int | None) -> None:
        """Register a file for reading in place of the one known by this name; None: there is none now."""
        before = self._registered.get(name)
        if before == fileno:
            return
        if before is not None:
            with contextlib.suppress(KeyError, ValueError, OSError):  # a file that was closed has left the selector
                self._selector.unregister(before)
            del self._registered[name]
        if fileno is not None:
            self._selector.register(fileno, selectors.EVENT_READ)
            self._registered[name] = fileno
