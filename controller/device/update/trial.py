"""The trial of a release: its service's status is read every second until it is evaluated, and the fall-back script is asked."""

from __future__ import annotations

import time
from collections.abc import Callable
from datetime import UTC, datetime
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from controller.device.board.panel_status import FOLDER, NAME, PanelStatus, boot_id, read_status, status_bytes, status_in
from controller.device.update.judge import Evaluation, Rules, Verdict, judge
from controller.device.update.layout import Layout
from controller.device.update.requests import ask
from controller.durable import write_durably
from controller.errors import ControllerError, UpdateError
from controller.log import log

STATUS: Final = FOLDER / NAME
BEFORE: Final = "before.json"  # in `Layout.download`
LOOK_S: Final = 1.0
NEEDED: Final = ("download.fetch", "install")  # beside trust and source: what fetches and installs the next release


def keep_before(layout: Layout, status_file: Path = STATUS) -> None:
    """Keep the state of the release in use, when another one is asked for: its faults are not held against the other.

    Raises UpdateError if it cannot be kept.
    """
    kept = layout.download / BEFORE
    try:
        data = status_bytes(status_file)
        status = status_in(data, status_file) if data is not None else None
    except ControllerError:
        data = status = None
    try:
        if data is None or status is None or status.why_old(time.monotonic(), boot_id()):
            kept.unlink(missing_ok=True)
        else:
            write_durably(kept, data)
    except OSError as error:
        raise UpdateError(f"{kept}: cannot be written ({error.strerror})") from error


def why_no_updater(layout: Layout) -> str:
    """Why this release could not fetch and install the next one; empty if it could: its modules load, and know the owner's root."""
    try:
        trust, source, *_ = (
            import_module(f"controller.device.update.{name}") for name in ("trust.trust", "download.source", *NEEDED)
        )
        with TemporaryDirectory() as folder:
            trust.DeviceUpdater(
                Path(folder), source.FolderSource(folder), layout.trusted_root.read_bytes(), datetime(1970, 1, 1, tzinfo=UTC)
            )
    except Exception as error:  # whatever an import or python-tuf raises
        return f"it could not update again: {type(error).__name__}: {' '.join(str(error).split())}"
    return ""


def judge_trial(
    layout: Layout,
    healthy_s: float,  # for how long it must serve
    reported: Callable[[str], None],  # called with the state of the trial at each look, about once a second
    status_file: Path = STATUS,  # of the service
    now_s: Callable[[], float] = time.monotonic,  # now_s, pause: clock of the statuses, and what waits on it
    pause: Callable[[float], None] = time.sleep,
) -> Verdict:
    """Judge the release on trial, and ask the fall-back script for what follows; to be run by that release itself.

    Raises UpdateError if a verdict cannot be handed over.
    """
    version = layout.word("trial")
    why = why_no_updater(layout)
    known = Evaluation(Verdict.BAD, why) if why else Evaluation()
    rules = Rules(version, healthy_s, boot_id(), _read(layout.download / BEFORE))
    asked, said = False, ""
    while known.verdict is Verdict.NOT_YET:
        if layout.word("trial") != version:
            return Verdict.NOT_YET
        known = judge(known, now_s(), _read(status_file), rules)
        words = f"release {version} is on trial: {known.why or 'it serves'}"
        reported(words)
        if words != said:
            said = words
            log(words)
        if known.stands and not asked:
            ask(layout, "stands", version)
        asked = known.stands
        if known.verdict is Verdict.NOT_YET:
            pause(LOOK_S)
    log(f"release {version} is {known.verdict.value}: {known.why or f'it served for {healthy_s:g} s'}")
    ask(layout, "good" if known.verdict is Verdict.GOOD else "bad", version)
    return known.verdict


def _read(file: Path) -> PanelStatus | None:
    """A status; None if there is none that can be read."""
    try:
        return read_status(file)
    except ControllerError:
        return None
