"""Signals as the event loop takes them: a handler of ours, and a selector that wakes."""

from __future__ import annotations

import contextlib
import selectors
import signal
import socket
from collections.abc import Callable, Iterator, Mapping


class Wakeup:
    """The file that signals make readable."""

    def __init__(self, woken: socket.socket) -> None:
        self._woken = woken

    def clear(self) -> None:
        """Take note: it stays readable otherwise."""
        with contextlib.suppress(BlockingIOError):
            self._woken.recv(64)


@contextlib.contextmanager
def signals(handlers: Mapping[signal.Signals, Callable[[], None]], selector: selectors.BaseSelector) -> Iterator[Wakeup]:
    """Have signals call their handlers and wake the selector; everything is as before afterwards."""
    woken, wakes = socket.socketpair()
    woken.setblocking(False)
    wakes.setblocking(False)
    selector.register(woken, selectors.EVENT_READ)
    old_fd = signal.set_wakeup_fd(wakes.fileno(), warn_on_full_buffer=False)
    old = {number: signal.signal(number, _calling(handler)) for number, handler in handlers.items()}
    try:
        yield Wakeup(woken)
    finally:
        for number, handler in old.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(old_fd)
        selector.unregister(woken)
        woken.close()
        wakes.close()


def _calling(handler: Callable[[], None]) -> Callable[..., None]:
    return lambda *_: handler()
