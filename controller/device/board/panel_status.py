"""State of a running panel, in a file: `/run/haptic-panel/status.json`, which the service replaces about once a second.

Readers are of any release, that of the service or another: they ignore what they do not know.
"""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Final

import msgspec
from msgspec import Meta

from controller.device.board.panel_state import PanelState
from controller.device.board.validation import NO_JSON
from controller.errors import ControllerError
from controller.regular_file import open_regular

FOLDER: Final = Path("/run/haptic-panel")  # RuntimeDirectory= of the unit
NAME: Final = "status.json"
BOOT_ID: Final = Path("/proc/sys/kernel/random/boot_id")
FORMAT: Final = 1
BYTES_MAX: Final = 65_536
STALE_S: Final = 5.0  # a loop that is silent for 3 s is ended by the service manager; a busy one writes at least every 2 s
SERVES: Final = frozenset({PanelState.ARMED, PanelState.PLAYING, PanelState.IDLE, PanelState.DISARMED, PanelState.RAMPING})

Count = Annotated[int, Meta(ge=0)]
Microseconds = Annotated[float, Meta(ge=0)]


class LatencyStatus(msgspec.Struct, frozen=True):
    """The host's own work for emissions of one kind, since the start."""

    count: Count = 0
    p50_us: Microseconds = 0.0  # p50_us, p99_us, worst_us: 0 without records
    p99_us: Microseconds = 0.0
    worst_us: Microseconds = 0.0


class PanelStatus(msgspec.Struct, frozen=True, kw_only=True):
    """State of a running panel."""

    release: str  # version of the release that runs; "checkout" outside of a release
    board: str
    pid: Annotated[int, Meta(gt=0)]  # process of the service
    boot: str  # boot id of the kernel: times are of this boot. Empty: unknown
    started_s: float  # started_s, written_s: CLOCK_MONOTONIC
    written_s: float
    state: PanelState  # state, cause, outputs_on, panel_present, temperature_c: as `Condition` has them
    cause: str
    outputs_on: bool
    panel_present: bool
    temperature_c: float | None
    # heartbeats, due, foci, emissions, uploads, late, idled, host_silent, stall_pauses, outages: as `Counters` has them, since
    # the start
    heartbeats: Count
    due: Count
    foci: Count
    emissions: Count
    uploads: Count
    late: Count
    idled: Count
    host_silent: Count
    outages: Count
    skipped: Count  # emissions that were due and not played
    waiting: Count  # emissions that are due now
    log_lines_lost: Count  # log_lines_lost, statuses_lost: lines that the log, and statuses that this file did not take
    statuses_lost: Count
    upload: LatencyStatus  # upload, resident: of emissions with an upload, and of those whose waveform was resident
    resident: LatencyStatus
    # touch_points, touch_points_refused: positions that the touch panel has reported, and those of them that were no finger's
    # (`device/touch/plausibility.py`)
    touch_points: Count = 0
    touch_points_refused: Count = 0
    left_out: dict[str, Count] = {}  # touches outside of regions, emissions not played, by cause (`service/unfelt.py`)
    outage_causes: dict[str, Count] = {}  # how often the FPGA named each fault; LINK: it was lost or reset
    stall_pauses: Count = 0
    touch_warnings: dict[str, Count] = {}  # anomalies of the touch panel since the start, by kind
    touch_remark: str = ""  # what its device lacks and works without; empty: nothing
    ended: bool = False  # the service has ended; state and counters are its last
    format: Annotated[int, Meta(ge=FORMAT, le=FORMAT)] = FORMAT

    @property
    def uptime_s(self) -> float:
        """From the start to when this was written."""
        return self.written_s - self.started_s

    @property
    def serves(self) -> bool:
        """Whether it does what is asked of it: it plays, or would as soon as it is touched or armed."""
        return self.state in SERVES

    def why_old(self, now_s: float, boot: str) -> str:
        """Why this does not tell the panel's present state; empty if it does."""
        if boot and self.boot and boot != self.boot:
            return "it was written before the computer was started"
        if self.ended:
            return "the service has ended"
        if now_s - self.written_s > STALE_S:
            return f"it was written {now_s - self.written_s:.0f} s ago: the service hangs, or was killed"
        return ""


def status_bytes(file: Path) -> bytes | None:
    """Content of a status file, its first `BYTES_MAX`; it belongs to who owns its folder. None if there is no file.

    Raises ControllerError if it cannot be read: it is no regular file, or another user's.
    """
    try:
        with os.fdopen(open_regular(file, owner=file.parent.stat().st_uid), "rb") as opened:
            return opened.read(BYTES_MAX)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise ControllerError(f"{file}: cannot be read ({error.strerror})") from error


def status_in(data: bytes, file: Path) -> PanelStatus:
    """The status that a file's content is; raises ControllerError if it is no status that this software knows."""
    try:
        return _decoder.decode(data)
    except NO_JSON as error:
        raise ControllerError(f"{file}: is no status of a panel that this software knows: {error}") from error


def read_status(file: Path) -> PanelStatus | None:
    """The status in a file; None if there is no file; raises ControllerError as `status_bytes` and `status_in`."""
    data = status_bytes(file)
    return None if data is None else status_in(data, file)


def boot_id(environment: Mapping[str, str] = os.environ) -> str:
    """The kernel's id of this boot, 32 digits: $HAPTIC_PANEL_BOOT, which the unit sets, as its sandbox hides the file; or empty."""
    try:
        return environment.get("HAPTIC_PANEL_BOOT") or BOOT_ID.read_text(encoding="ascii").strip().replace("-", "")
    except OSError:
        return ""


def is_running(pid: int) -> bool:
    """Whether there is a process of this number."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


def read_now(file: Path) -> tuple[PanelStatus | None, str]:
    """The status in a file, and why it does not tell the panel's present state; empty if it does.

    Raises ControllerError as `read_status`.
    """
    status = read_status(file)
    if status is None:
        return None, "there is none"
    return status, status.why_old(time.monotonic(), boot_id())


_decoder: Final = msgspec.json.Decoder(PanelStatus)
