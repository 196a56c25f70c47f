"""Messages to the service manager: readiness, state and watchdog.

The protocol is that of sd_notify(3): datagrams of VARIABLE=value lines to the socket that $NOTIFY_SOCKET names.
"""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Mapping
from typing import Self

PINGS_PER_TIMEOUT = 3  # sd_watchdog_enabled(3) recommends every half of it; one may be late


class Notifier:
    """Reports the service's state to the service manager; does nothing without one.

    It does not block: messages that find the manager's queue full are kept and sent in order by later calls.

    `address` is $NOTIFY_SOCKET: a path, or a name in the abstract namespace with @ in front; empty: there is no manager.
    """

    def __init__(self, address: str) -> None:
        self._address = b"\0" + os.fsencode(address[1:]) if address.startswith("@") else os.fsencode(address)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) if address else None
        self._owed: list[bytes] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the socket; nothing is sent any more."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    @classmethod
    def from_environment(cls, environment: Mapping[str, str] = os.environ) -> Self:
        """Notifier for the socket that $NOTIFY_SOCKET names."""
        return cls(environment.get("NOTIFY_SOCKET", ""))

    def ready(self, status: str) -> None:
        """The service is ready, at the start or again after `reloading`."""
        self._tell(f"READY=1\nSTATUS={_line(status)}")

    def reloading(self, status: str) -> None:
        """The service prepares another scene; `ready` follows, whether the scene is loaded or refused."""
        self._tell(f"RELOADING=1\nMONOTONIC_USEC={time.monotonic_ns() // 1000}\nSTATUS={_line(status)}")

    def stopping(self, status: str) -> None:
        """The outputs are being switched off and the process ends."""
        self._tell(f"STOPPING=1\nSTATUS={_line(status)}")

    def status(self, status: str) -> None:
        """Set the line that `systemctl status` shows."""
        self._tell(f"STATUS={_line(status)}")

    def alive(self) -> None:
        """Reset the watchdog; allocates nothing while the manager reads."""
        if self._owed:
            self._settle()
        self._send(b"WATCHDOG=1")

    def _tell(self, message: str) -> None:
        self._owed.append(message.encode())
        self._settle()

    def _settle(self) -> None:
        while self._owed and self._send(self._owed[0]):
            del self._owed[0]

    def _send(self, message: bytes) -> bool:
        """Whether it is dealt with: sent, or there is nobody who would ever take it."""
        if self._socket is None:
            return True
        try:
            self._socket.sendto(message, socket.MSG_DONTWAIT, self._address)
        except BlockingIOError:
            return False
        except OSError:  # the manager is gone: none of the panel's business
            return True
        return True


class Watchdog:
    """Resets the service manager's watchdog while the loop turns; the manager kills a service whose loop hangs.

    After a silence of `timeout_s` the service is killed; inf: there is no watchdog.
    """

    def __init__(self, notifier: Notifier, timeout_s: float) -> None:
        self._notifier = notifier
        self._period_s = timeout_s / PINGS_PER_TIMEOUT
        self._due_s = float("inf") if timeout_s == float("inf") else float("-inf")

    @classmethod
    def from_environment(cls, notifier: Notifier, environment: Mapping[str, str] = os.environ) -> Self:
        """Watchdog with the timeout of $WATCHDOG_USEC, provided that $WATCHDOG_PID is this process or not set."""
        microseconds = environment.get("WATCHDOG_USEC", "")
        ours = environment.get("WATCHDOG_PID", str(os.getpid())) == str(os.getpid())
        return cls(notifier, int(microseconds) * 1e-6 if ours and microseconds.isdecimal() and int(microseconds) else float("inf"))

    def progress(self, now_s: float) -> None:
        """Call in each turn of the loop; sends at most one message every third of the timeout."""
        if now_s >= self._due_s:
            self._due_s = now_s + self._period_s
            self._notifier.alive()


def _line(text: str) -> str:
    return " ".join(text.split())
