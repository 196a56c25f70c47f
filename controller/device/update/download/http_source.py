"""A repository at an http(s) address: limits of time and bandwidth, ranges, and a line for each way to fail."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final
from urllib.parse import urlsplit

import urllib3
from tuf.api.exceptions import DownloadError, DownloadHTTPError, DownloadLengthMismatchError, SlowRetrievalError

from controller.device.update.download.source import CHUNK_BYTES, NoRanges, Source
from controller.errors import UpdateError

GAP_S: Final = 20.0  # longest silence of a server
RETRIES: Final = 2
CONTENT_RANGE: Final = re.compile(r"bytes (\d{1,15})-(\d{1,15})/(\d{1,15}|\*)")


class Broken(DownloadError):
    """A connection that ended too early."""


class HttpSource(Source):
    """A repository at an http(s) address; whatever is not this address's own answer is refused."""

    def __init__(
        self,
        address: str,
        total_s: float,  # longest time of everything that is read by this object, in s
        bytes_per_s: float = 0.0,  # most that is read in a second; 0: no limit
        *,
        gap_s: float = GAP_S,  # longest silence of the server, in s
        retries: int = RETRIES,
        now_s: Callable[[], float] = time.monotonic,  # now_s, wait_s: monotonic time in s; waits for some seconds
        wait_s: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(address)
        self._total_s, self._bytes_per_s, self._gap_s = total_s, bytes_per_s, gap_s
        self._now_s, self._wait_s = now_s, wait_s
        self._begun_s = self._free_s = now_s()
        retry = urllib3.Retry(retries, redirect=0, status=0, backoff_factor=0.5, raise_on_redirect=False, raise_on_status=False)
        headers = {"User-Agent": "haptic-panel", "Accept-Encoding": "identity"}
        self._http = urllib3.PoolManager(num_pools=1, timeout=urllib3.Timeout(gap_s), retries=retry, headers=headers)

    def look(self) -> None:
        """Check that the address is one."""
        try:
            parts = urlsplit(self.address)
            is_one = parts.scheme in {"http", "https"} and bool(parts.hostname) and parts.port != 0
        except ValueError:
            is_one = False
        if not is_one:
            raise UpdateError(f"{self.address}: is no http(s) address: set `source` in update.toml, or give --from URL or FOLDER")

    def open(self, url: str, start: int = 0, length: int | None = None) -> Iterator[bytes]:
        """Ask for a file, or a range of it; where the connection breaks after a while, ask for the rest."""
        read = begun = 0
        while length is None or read < length:
            try:
                for chunk in self._asked(url, start + read, None if length is None else length - read):
                    read += len(chunk)
                    yield chunk
                return
            except Broken:
                if length is None or read - begun < CHUNK_BYTES:
                    raise
                begun = read
            except NoRanges as error:
                if begun:
                    raise Broken(f"{url}: the connection broke, and the server sends whole files only: try again") from error
                raise

    def _asked(self, url: str, start: int, length: int | None) -> Iterator[bytes]:
        """What comes of one request; a part of a file is refused unless it is exactly what was asked for."""
        headers = {**self._http.headers}
        if start or length is not None:
            headers["Range"] = f"bytes={start}-" + ("" if length is None else f"{start + length - 1}")
        self._within_time(url)
        with _reported(url, self._gap_s):
            answer = self._http.request("GET", url, headers=headers, preload_content=False, redirect=False)
        try:
            self._check(answer, url, start, length)
            yield from self._body(answer, url, length)
            if not answer.length_remaining:
                answer.release_conn()
        finally:
            answer.close()

    def _check(self, answer: urllib3.BaseHTTPResponse, url: str, start: int, length: int | None) -> None:
        status = answer.status
        if 300 <= status < 400:
            where = answer.headers.get("Location", "elsewhere")
            raise DownloadError(f"{url}: leads to {where[:200]}: redirects are not followed; give the repository's own address")
        if status >= 400:
            raise DownloadHTTPError(f"{url}: the server answers {status}", status)
        if answer.headers.get("Content-Type", "").startswith("text/html"):
            raise DownloadError(f"{url}: a web page came instead of it: does this network ask for a login?")
        if status == 200:
            if start:
                raise NoRanges(f"{url}: the server sends no ranges")
            reported = answer.headers.get("Content-Length", "")
            if length is not None and reported.isdecimal() and len(reported) < 16 and int(reported) != length:
                raise DownloadLengthMismatchError(f"{url}: {int(reported):,} bytes, not the {length:,} that were signed")
        elif status != 206 or not answers_range(answer.headers.get("Content-Range", ""), start, length):
            raise NoRanges(f"{url}: the server answers {status} with another range than was asked for")

    def _body(self, answer: urllib3.BaseHTTPResponse, url: str, length: int | None) -> Iterator[bytes]:
        read = 0
        while length is None or read < length:
            wanted = CHUNK_BYTES if length is None else min(CHUNK_BYTES, length - read)
            with _reported(url, self._gap_s):  # what has come, without waiting for more: a trickle is seen
                chunk = answer.read1(wanted, decode_content=False)
            if not chunk:
                break
            read += len(chunk)
            self._pace(len(chunk))
            self._within_time(url)
            yield chunk
        if length is not None and read < length:
            raise Broken(f"{url}: ended after {read:,} of {length:,} bytes")

    def _pace(self, count: int) -> None:
        """Wait until the bytes that were read are due."""
        self.fetched_bytes += count
        if self._bytes_per_s:
            now_s = self._now_s()
            self._free_s = max(self._free_s, now_s) + count / self._bytes_per_s
            self._wait_s(max(0.0, self._free_s - now_s))

    def _within_time(self, url: str) -> None:
        if self._now_s() - self._begun_s > self._total_s:
            raise SlowRetrievalError(f"{url}: not done within {self._total_s:g} s (total_s): what came is kept for the next try")


def answers_range(header: str, start: int, length: int | None) -> bool:
    """Whether a Content-Range is that of bytes from `start` on, `length` of them or all to the file's end."""
    found = CONTENT_RANGE.fullmatch(header)
    if not found:
        return False
    first, last = int(found[1]), int(found[2])
    if length is None:
        return first == start <= last and (found[3] == "*" or last + 1 == int(found[3]))
    return first == start and last == start + length - 1 and (found[3] == "*" or last < int(found[3]))


@contextmanager
def _reported(url: str, gap_s: float) -> Iterator[None]:
    """Errors of urllib3 as one line each; it counts a refused connection among those that are too slow."""
    try:
        yield
    except urllib3.exceptions.HTTPError as error:
        cause: object = getattr(error, "reason", None) or error
        causes = [cause, getattr(cause, "__cause__", None), getattr(cause, "__context__", None)]
        if any(isinstance(one, ConnectionRefusedError) for one in causes):
            raise DownloadError(f"{url}: the connection was refused: is the server running, and the address right?") from error
        if isinstance(cause, urllib3.exceptions.NameResolutionError):
            raise DownloadError(f"{url}: this server is not known: is there a network, and the address right?") from error
        if isinstance(cause, urllib3.exceptions.SSLError):
            raise DownloadError(f"{url}: its certificate is not accepted ({cause}): is the clock right?") from error
        if isinstance(cause, urllib3.exceptions.TimeoutError) and not isinstance(cause, urllib3.exceptions.NewConnectionError):
            raise SlowRetrievalError(f"{url}: the server said nothing for {gap_s:g} s: try again; what came is kept") from error
        raise Broken(f"{url}: the connection broke ({cause}): try again; what came is kept") from error
    except (ValueError, OSError) as error:
        raise DownloadError(f"{url}: cannot be asked for ({error}): is the address right?") from error
