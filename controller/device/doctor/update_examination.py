"""Checks of releases and updates for `haptic-panel doctor`: what runs, what is asked for, and whether the next update can work."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Final

from controller.device.doctor.finding import Finding
from controller.device.service.installation import missing_package
from controller.device.update.installed import manifest_of, update_state
from controller.device.update.layout import COMPLETE, MANIFEST, SETTINGS, Layout
from controller.device.update.settings import load_settings
from controller.device.update.trust.validity import clock_reported, root_expiry
from controller.errors import ConfigError, ControllerError
from controller.programs import run_program

OWNERS: Final = {  # user and mode of each folder, as tmpfiles.d/haptic-panel.conf makes them
    "": ("root", 0o755),
    "state": ("root", 0o755),
    "releases": ("haptic-update", 0o755),
    "store": ("haptic-update", 0o755),
    "requests": ("haptic-update", 0o775),
    "download": ("haptic-update", 0o755),
}
RESERVE_BYTES: Final = 32_000_000  # that a download leaves free
UNITS: Final = ("haptic-panel-update.timer", "haptic-panel-requests.path")
ASK_S: Final = 10.0  # for an answer of systemd
BOOTED: Final = Path("/run/systemd/system")  # there where systemd runs the machine


def look_at_updates(layout: Layout, settings: Path = SETTINGS) -> list[Finding]:
    """Check releases and updates of this device; nothing where there are no releases, such as on a computer for development."""
    if not layout.releases.is_dir():
        return []
    if (layout.current / COMPLETE).exists() and not (layout.current / MANIFEST).exists():
        said = f"{layout.current.resolve().name} was installed by hand, without {MANIFEST}: updates are not looked at"
        return [Finding("release", True, said, warns=True)]
    checks: list[tuple[str, Callable[[], str | Finding]]] = [
        ("release", lambda: _release(layout)),
        ("failed releases", lambda: _failed(layout)),
        ("installations", lambda: _installations(layout)),
        ("update requests", lambda: _requests(layout)),
        ("update folders", lambda: _folders(layout)),
        ("update settings", lambda: _settings(settings)),
        ("trusted root", lambda: _of_its_time("trusted root", root_expiry(layout))),
        ("clock", lambda: _of_its_time("clock", clock_reported(layout))),
        ("free space", lambda: _space(layout)),
    ]
    if BOOTED.exists():
        checks.append(("update units", _units))
    return [_tried(about, check) for about, check in checks]


def _tried(about: str, check: Callable[[], str | Finding]) -> Finding:
    try:
        found = check()
    except (ControllerError, OSError) as error:
        return Finding(about, False, str(error))
    except ModuleNotFoundError as error:
        return Finding(about, False, missing_package(error.name) or str(error))
    return found if isinstance(found, Finding) else Finding(about, True, found)


def _release(layout: Layout) -> str | Finding:
    state = update_state(layout)
    if state.problems:
        raise ConfigError("; ".join(state.problems))
    if state.trial:
        said = f"{state.trial} is on trial, start {state.tries}; {state.stays or 'none'} is used again if it does not serve"
        return Finding("release", True, said, warns=True)
    before = f"; {state.previous} is the one before" if state.previous else ""
    return f"{state.in_use} is in use{before}"


def _failed(layout: Layout) -> str | Finding:
    failed = update_state(layout).failed
    if not failed:
        return "none"
    return Finding("failed releases", True, f"{', '.join(failed)} did not serve on this device: not tried again", warns=True)


def _installations(layout: Layout) -> str | Finding:
    failed = update_state(layout).not_installed
    if not failed:
        return "none has failed"
    return Finding("installations", True, f"{failed}: haptic-panel update install tries it again", warns=True)


def _requests(layout: Layout) -> str | Finding:
    asked = update_state(layout).requested
    if not asked:
        return "none"
    said = f"{', '.join(asked)}: not done yet; journalctl -u haptic-panel-requests says why"
    return Finding("update requests", True, said, warns=True)


def _folders(layout: Layout) -> str:
    wrong = []
    for name, (owner, mode) in OWNERS.items():
        folder = layout.root / name
        is_mode = folder.stat().st_mode & 0o7777
        try:
            is_owner = folder.owner()
        except KeyError:
            is_owner = "nobody known"
        if (is_owner, is_mode) != (owner, mode):
            wrong.append(f"{folder} is of {is_owner} with mode {is_mode:o}, not of {owner} with {mode:o}")
    if wrong:
        raise ConfigError(f"{'; '.join(wrong)}: systemd-tmpfiles --create haptic-panel.conf")
    return f"those below {layout.root} belong to whom they should"


def _settings(file: Path) -> str | Finding:
    settings = load_settings(file)
    if not settings.source:
        said = f"{file}: no source is set: updates come only from where `update install --from` says"
        return Finding("update settings", True, said, warns=True)
    return f"{settings.automatic} from {settings.source}, channel {settings.channel}"


def _of_its_time(about: str, reported: tuple[str, bool]) -> Finding:
    said, warns = reported
    return Finding(about, True, said, warns=warns)


def _space(layout: Layout) -> str | Finding:
    manifest = manifest_of(layout.current)
    free, needed = shutil.disk_usage(layout.root).free, RESERVE_BYTES + 2 * (manifest.total_bytes if manifest else 0)
    said = f"{free / 1e6:,.0f} MB are free on {layout.root}"
    if free < needed:
        said += f": a release as large as this one may need {needed / 1e6:,.0f} MB"
    return Finding("free space", True, said, warns=free < needed)


def _units() -> str | Finding:
    said = run_program(["systemctl", "is-active", *UNITS], ASK_S, attempts=2, good=range(5)).out  # 3, 4: one is not
    states = dict(zip(UNITS, said.split(), strict=False))
    off = [unit for unit in UNITS if states.get(unit) != "active"]
    if not off:
        return f"{' and '.join(UNITS)} are active"
    said = f"{' and '.join(off)}: not active, so updates wait: systemctl enable --now {' '.join(off)}"
    return Finding("update units", True, said, warns=True)
