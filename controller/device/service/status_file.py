"""The status file: the panel's state, replaced about once a second between two turns of the loop that are apart enough."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final, Self

import msgspec

from controller.clocks import NEVER
from controller.device.board.lookup import running_release
from controller.device.board.panel_state import Condition
from controller.device.board.panel_status import FOLDER, NAME, LatencyStatus, PanelStatus, boot_id
from controller.device.loop.context import SpareTime
from controller.device.service.unfelt import left_out
from controller.device.touch.source import Counts
from controller.log import LOG, Priority, log
from controller.metrics import Counters, LatencyHistogram

PERIOD_S: Final = 1.0
APART_S: Final = 0.1  # between two statuses, however often the state changes
SPARE_S: Final = 2e-3  # to the next turn: a status takes 0.04 ms on a PC, a few tenths of a millisecond on the slowest board
PATIENCE_S: Final = 1.0  # for which such a gap is waited for
FRACTIONS: Final = (0.5, 0.99)
COUNTED: Final = (  # fields of `Counters` that a status has too
    *("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled"),
    *("host_silent", "stall_pauses", "outages", "outage_causes"),
)
FLAGS: Final = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC | os.O_NOFOLLOW


class StatusFile(SpareTime):
    """Writes the status of one run of the service.

    The folder lies in memory (tmpfs): nothing of it waits for a disk. A status that is not taken is counted and reported once.

    Without a folder nothing is written.
    """

    def __init__(self, folder: Path | None, board: str) -> None:
        super().__init__()
        self._lost = 0
        self._reported = False
        self._board = board
        release = running_release()
        self._release = "checkout" if release is None else release.name
        self._boot = boot_id()
        self._pid = os.getpid()
        self._started_s = self._written_s = time.monotonic()
        self._condition = Condition()
        self._counters = Counters()
        self._waiting: Callable[[], int] = int
        self._touch: Callable[[], tuple[Mapping[str, int], str]] = _untouched
        self._touches = Counts()
        self._encoder = msgspec.json.Encoder()
        self._bytes = bytearray(4096)
        self._folder = -1
        if folder is not None:
            try:
                self._folder = os.open(folder, os.O_PATH | os.O_DIRECTORY | os.O_CLOEXEC)
            except OSError as error:
                self._lose(error)

    @classmethod
    def from_environment(cls, board: str, environment: Mapping[str, str] = os.environ) -> Self:
        """File in the folder that $RUNTIME_DIRECTORY names (systemd.exec(5))."""
        named = environment.get("RUNTIME_DIRECTORY", "").partition(":")[0]
        return cls(Path(named) if named else None, board)

    def watch(
        self,
        counters: Counters,
        waiting: Callable[[], int],  # how many emissions are due now
        touches: Counts | None = None,  # what became of the positions that the touch panel reports
        # Anomalies of the touch panel by kind, and the remark of its device
        touch: Callable[[], tuple[Mapping[str, int], str]] | None = None,
    ) -> None:
        """Take what is reported; the first status follows the first condition."""
        self._counters = counters
        self._waiting = waiting
        self._touch = touch or _untouched
        self._touches = touches or self._touches

    def changed(self, condition: Condition) -> None:
        """Take the panel's new condition, which is written soon."""
        self._condition = condition
        if self._folder >= 0:
            self.due_s = min(self.due_s, self._written_s + APART_S)

    def use(self, now_s: float, next_s: float) -> None:
        """Write, if there is time before the next turn at `next_s`, or there was none for long."""
        if next_s - now_s >= SPARE_S or now_s - self.due_s >= PATIENCE_S:
            self._write(now_s)

    def close(self) -> None:
        """Say that the service has ended."""
        if self._folder >= 0:
            self._write(time.monotonic(), ended=True)
            os.close(self._folder)
            self._folder = -1
            self.due_s = NEVER

    def _write(self, now_s: float, *, ended: bool = False) -> None:
        self.due_s, self._written_s = now_s + PERIOD_S, now_s
        self._encoder.encode_into(self._status(now_s, ended=ended), self._bytes)
        new = f".{NAME}.new"
        try:
            file = os.open(new, FLAGS, 0o644, dir_fd=self._folder)
            try:
                os.fchmod(file, 0o644)  # whatever the umask: it holds no secrets
                written = os.write(file, self._bytes)
            finally:
                os.close(file)
            if written != len(self._bytes):
                raise OSError(0, "no space for all of it")
            os.rename(new, NAME, src_dir_fd=self._folder, dst_dir_fd=self._folder)
        except OSError as error:
            self._lose(error)
        else:
            self._reported = False

    def _lose(self, error: OSError) -> None:
        self._lost += 1
        if not self._reported:
            self._reported = True
            log(f"the status file cannot be written to {FOLDER} ({error.strerror}); the panel plays on", Priority.WARNING)

    def _status(self, now_s: float, *, ended: bool) -> PanelStatus:
        condition, counters, touches = self._condition, self._counters, self._touches
        warnings, remark = self._touch()
        return PanelStatus(
            release=self._release,
            board=self._board,
            pid=self._pid,
            boot=self._boot,
            started_s=self._started_s,
            written_s=now_s,
            ended=ended,
            state=condition.state,
            cause=condition.cause,
            outputs_on=condition.outputs_on and not ended,
            panel_present=condition.panel_present,
            temperature_c=condition.temperature_c,
            **{name: getattr(counters, name) for name in COUNTED},
            touch_warnings={kind: count for kind, count in warnings.items() if count},
            touch_remark=remark,
            skipped=counters.skipped.emissions,
            waiting=self._waiting(),
            touch_points=touches.points,
            touch_points_refused=touches.refused,
            left_out=left_out(counters.skipped),
            log_lines_lost=LOG.lost,
            statuses_lost=self._lost,
            upload=_latency(counters.upload_latency.host),
            resident=_latency(counters.resident_latency.host),
        )


def _untouched() -> tuple[Mapping[str, int], str]:
    return {}, ""


def _latency(histogram: LatencyHistogram) -> LatencyStatus:
    count = histogram.count
    if not count:
        return LatencyStatus()
    p50_ns, p99_ns = histogram.percentiles_ns(FRACTIONS)
    return LatencyStatus(count, p50_ns * 1e-3, p99_ns * 1e-3, histogram.worst_ns * 1e-3)
