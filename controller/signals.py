"""Signals that wake a selector."""

from __future__ import annotations

import contextlib
import selectors
import signal
import socket
from collections.abc import Callable, Iterator, Mapping


class Wakeup:
    """The socket, non-blocking, that each signal makes readable."""

    def __init__(self, woken: socket.socket) -> None:
        self._woken = woken

    def clear(self) -> None:
        """Read what the signals wrote; until then the socket stays readable."""
        with contextlib.suppress(BlockingIOError):
            self._woken.recv(64)


@contextlib.contextmanager
def handled_signals(handlers: Mapping[signal.Signals, Callable[[], None]], selector: selectors.BaseSelector) -> Iterator[Wakeup]:
    """Signals call their handlers and wake the selector; on exit the handlers and the wakeup file of before are set again.

    The wakeup socket is registered with the selector for reading.
    """
    woken, wakes = socket.socketpair()
    woken.setblocking(False)
    wakes.setblocking(False)
    selector.register(woken, selectors.EVENT_READ)
    old_fd = signal.set_wakeup_fd(wakes.fileno(), warn_on_full_buffer=False)
    old = {number: signal.signal(number, _without_arguments(handler)) for number, handler in handlers.items()}
    try:
        yield Wakeup(woken)
    finally:
        for number, handler in old.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(old_fd)
        selector.unregister(woken)
        woken.close()
        wakes.close()


def _without_arguments(handler: Callable[[], None]) -> Callable[..., None]:
    return lambda *_: handler()
