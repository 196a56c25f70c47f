"""Files that wake the selector; a source may close its file and open another one at any time."""

from __future__ import annotations

import contextlib
import selectors


class NotingSelector(selectors.DefaultSelector):
    """A selector that keeps what it found."""

    # Files that were ready at the end of the last wait; None: nobody has waited since this was set to None. A look without a
    # wait does not count: simulated time jumps on behind it
    ready: set[int] | None = None

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Wait as `BaseSelector.select` does."""
        found = super().select(timeout)
        self.ready = None if timeout == 0 else {key.fd for key, _ in found}
        return found


class WatchedFiles:
    """Registrations of a selector, by name."""

    def __init__(self, selector: NotingSelector) -> None:
        self._selector = selector
        self._registered: dict[str, int] = {}

    def silent(self, name: str) -> bool:
        """Whether the selector, just waited on, has found that nothing came in the file known by this name."""
        ready, fileno = self._selector.ready, self._registered.get(name)
        return ready is not None and fileno is not None and fileno not in ready

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
