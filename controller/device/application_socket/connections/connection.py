"""One client's connection: received lines and queued answers, in two buffers of fixed size."""

from __future__ import annotations

import math
import socket

import msgspec

from controller.device.application_socket.connections.peers import Peer
from controller.device.application_socket.protocol.client_messages import LINE_BYTES, Right, Topic
from controller.device.application_socket.protocol.panel_messages import AnyMessage, Farewell
from controller.device.application_socket.token_bucket import TokenBucket
from controller.device.scene.effects.clips import ClientEffect

QUEUE_BYTES = 65536  # messages that the client has not read yet
LAYER_BURST = 5  # times that a client may replace its regions at once
FAREWELL_BYTES = 512  # reserved behind them for the farewell
CLOSED = -1
UNWATCHED = -1
NEWLINE = 10
NOBODY = Peer(-1, -1, frozenset())


class LineTooLong(ValueError):
    """A line that does not fit the buffer; the rest of it is discarded."""


class MessageTooLong(ValueError):
    """An answer that does not fit an empty queue."""


class Connection:
    """A place for one client at a time; the next client gets the same buffers.

    A client may send `rate_hz` lines a second in the long run, and `burst` at once; likewise replace its regions `layers_hz`
    times. Its longest line is `longest_bytes` if it has the right to regions, else LINE_BYTES.
    """

    def __init__(self, rate_hz: float, burst: int, longest_bytes: int = LINE_BYTES, layers_hz: float = 1.0) -> None:
        self.fd = CLOSED
        self.serial = -1
        self.watched = UNWATCHED  # events that epoll watches for; it reports hanging up in any case
        self.peer = NOBODY
        self.rights: tuple[Right, ...] = ()
        self.heard_s = -math.inf  # when its last line arrived, in s of the host's clock
        self.topics: set[Topic] = set()  # that it has subscribed to
        self.lines_sent = 0  # of the log, for a subscriber to it
        self.ended = False  # the client sends no more
        self.deaf = False  # the client reads no more
        self.leaving_reason = ""
        self.leave_s = math.inf  # when it is disconnected even if it has not read its farewell
        self.resume_s = -math.inf  # when it is read again, after exceeding its rate
        self.waiting = 0  # commands without an outcome yet
        self.layered = False  # has sent regions
        self.clips: dict[str, ClientEffect] = {}  # that it has sent under a name
        self.rate = TokenBucket(rate_hz, burst)
        self.layer_rate = TokenBucket(layers_hz, LAYER_BURST)
        self._socket: socket.socket | None = None
        self._received = bytearray(longest_bytes)
        self._received_view = memoryview(self._received)
        self._start = self._end = 0
        self._longest = LINE_BYTES
        self._skipping = False  # the rest of a line that was too long
        self._queue = memoryview(bytearray(QUEUE_BYTES + FAREWELL_BYTES))
        self._sent = self._queued = 0
        self._encoder = msgspec.json.Encoder()
        self._line = bytearray()

    def begin(self, client: socket.socket, serial: int, now_s: float, peer: Peer = NOBODY, rights: tuple[Right, ...] = ()) -> None:
        """Serve a new client on a connected, non-blocking socket; no other client has had this serial number."""
        self._socket = client
        self.peer, self.rights, self.heard_s = peer, rights, now_s
        self.fd = client.fileno()
        self.serial = serial
        self.topics.clear()
        self.ended = self.deaf = self.layered = self._skipping = False
        self.leaving_reason = ""
        self.leave_s, self.resume_s = math.inf, -math.inf
        self.watched, self.waiting = UNWATCHED, 0
        self._start = self._end = self._sent = self._queued = 0
        self.clips = {}
        self._longest = len(self._received) if "regions" in rights else LINE_BYTES
        self.rate.fill(now_s)
        self.layer_rate.fill(now_s)

    def close(self) -> None:
        """Close the socket; the place is free."""
        if self._socket is not None:
            self._socket.close()
        self._socket = None
        self.fd = CLOSED
        self.serial = -1

    @property
    def open(self) -> bool:
        """Whether a client is connected."""
        return self.fd != CLOSED

    @property
    def silent(self) -> bool:
        """Whether it has no subscription, no regions, no pending command, no unanswered line and no farewell."""
        return not (self.topics or self.layered or self.waiting or self.has_line or self.leaving_reason)

    @property
    def unsent(self) -> bool:
        """Whether queued bytes were not handed to the kernel yet."""
        return self._sent < self._queued

    def receive(self) -> None:
        """Read what has arrived, as far as it fits the buffer; does not block."""
        assert self._socket is not None
        if self._start:
            rest = self._end - self._start
            self._received_view[:rest] = self._received_view[self._start : self._end]
            self._start, self._end = 0, rest
        if self._end == self._longest:
            return
        try:
            count = self._socket.recv_into(self._received_view[self._end : self._longest])
        except BlockingIOError:
            return
        except OSError:  # reset: nothing more will come, and nobody will read
            count = 0
            self.deaf = True
        self._end += count
        self.ended = count == 0

    def next_line(self) -> memoryview | None:
        """The next complete line without its newline; None if there is none. The view is valid until the next `receive`.

        Raises LineTooLong once for a line that does not fit.
        """
        at = self._received.find(NEWLINE, self._start, self._end)
        if at >= 0 and self._skipping:
            self._skipping = False
            self._start = at + 1
            at = self._received.find(NEWLINE, self._start, self._end)
        if at >= 0:
            line = self._received_view[self._start : at]
            self._start = at + 1
            return line
        if self._skipping:
            self._start = self._end = 0
        elif self._end - self._start == self._longest:
            self._skipping = True
            self._start = self._end = 0
            raise LineTooLong(f"a line is at most {self._longest} bytes")
        return None

    def peek(self, into: bytearray) -> int:
        """Copy what it has sent and `next_line` has not returned, the kernel's part too, as far as it fits; returns the length."""
        if self._socket is None or self._skipping:
            return 0
        have = min(self._end - self._start, len(into))
        into[:have] = self._received_view[self._start : self._start + have]
        try:
            return have + self._socket.recv_into(memoryview(into)[have:], 0, socket.MSG_PEEK)
        except OSError:
            return have

    @property
    def has_line(self) -> bool:
        """Whether `next_line` would return a line or raise."""
        return self._end - self._start == self._longest or self._received.find(NEWLINE, self._start, self._end) >= 0

    def put(self, message: AnyMessage) -> None:
        """Queue one message; if the queue is full, queue a farewell instead, after which the client gets nothing more.

        Raises MessageTooLong if it would not even fit an empty queue.
        """
        if self.deaf or self.leaving_reason:
            return
        line = self._line
        self._encoder.encode_into(message, line)
        line.append(NEWLINE)
        if len(line) > QUEUE_BYTES:
            raise MessageTooLong(f"the answer has {len(line)} bytes, more than {QUEUE_BYTES}")
        if self._queued + len(line) > QUEUE_BYTES:
            self._compact()
            if self._queued + len(line) > QUEUE_BYTES:
                self.leave("it does not read what it is sent")
                return
        self._append(line)

    def leave(self, reason: str) -> None:
        """Queue a farewell; nothing is queued after it."""
        if not self.leaving_reason:
            self.leaving_reason = reason
            self._compact()
            self._encoder.encode_into(Farewell(reason=reason), self._line)
            self._line.append(NEWLINE)
            self._append(self._line)

    def flush(self) -> None:
        """Hand queued bytes to the kernel; does not block."""
        if self._socket is None or self._sent == self._queued:
            return
        try:
            self._sent += self._socket.send(self._queue[self._sent : self._queued])
        except BlockingIOError:
            return
        except OSError:  # it has closed: its commands are still carried out, its answers discarded
            self.deaf = True
            self._sent = self._queued
        if self._sent == self._queued:
            self._sent = self._queued = 0

    def _append(self, line: bytearray) -> None:
        self._queue[self._queued : self._queued + len(line)] = line
        self._queued += len(line)

    def _compact(self) -> None:
        left = self._queued - self._sent
        self._queue[:left] = self._queue[self._sent : self._queued]
        self._sent, self._queued = 0, left
