"""`haptic-panel update check`: what the repository offers this device."""

import argparse
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from controller.commands.common.output import show
from controller.device.update.identity import refuse_root
from controller.device.update.layout import Layout
from controller.device.update.settings import UpdateSettings, load_settings
from controller.errors import UpdateError

ALARM_AFTER_S = 30.0  # when the source's own limit has not ended it: a server that sends a header for ever


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    declare_source(step)
    step.set_defaults(command=check)


def declare_source(step: argparse.ArgumentParser) -> None:
    """Declare --from."""
    step.add_argument(
        "--from", dest="source", default="", metavar="URL|FOLDER", help="the repository (default: `source` of update.toml)"
    )


@contextmanager
def at_work() -> Iterator[tuple[Layout, UpdateSettings]]:
    """Layout and settings of this device; what is done within is not done by root, and ends in time.

    Raises UpdateError or ConfigError.
    """
    layout, settings = Layout.from_environment(), load_settings()
    refuse_root(layout)
    said = f"not done within {settings.total_s:g} s (total_s of update.toml): what came is kept for the next try"
    with ends_within(settings.total_s + ALARM_AFTER_S, said):
        yield layout, settings


@contextmanager
def ends_within(limit_s: float, said: str) -> Iterator[None]:
    """End what is done within by an error, whatever it waits for; raises UpdateError, saying this, when the time is over."""

    def too_long(_: int, __: FrameType | None) -> None:
        raise UpdateError(said)

    before = signal.signal(signal.SIGALRM, too_long)
    signal.setitimer(signal.ITIMER_REAL, limit_s)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def nothing_to_do(options: argparse.Namespace, why: UpdateError) -> int:
    """Say why the release that is offered is not taken yet."""
    show(options, {"version": None, "new": False, "waits": str(why)}, lambda said: f"{said['waits']}: nothing to do")
    return 0


def check(options: argparse.Namespace) -> int:
    """Print what is offered; 1 if it is refused."""
    from controller.device.update.download.fetch import check

    with at_work() as (layout, settings):
        offer, missing_bytes = check(layout, settings, options.source)
    figures: dict[str, Any] = {
        "channel": offer.channel,
        "platform": offer.platform,
        "installed": offer.installed.version if offer.installed else None,
        "offered": offer.manifest.version if offer.manifest else None,
        "counter": offer.manifest.counter if offer.manifest else None,
        "new": offer.is_new,
        "release_bytes": offer.manifest.total_bytes if offer.manifest else 0,
        "missing_bytes": missing_bytes,
        "refused": offer.refused,
        "waits": offer.waits,
    }
    show(options, figures, _table)
    return 1 if offer.refused else 0


def _table(figures: dict[str, Any]) -> str:
    installed = figures["installed"] or "no release"
    if figures["refused"]:
        return f"REFUSED {figures['refused']}; {installed} stays"
    if figures["waits"]:
        return f"{figures['waits']}; {installed} stays: nothing to do"
    if not figures["new"]:
        return f"{installed} is what channel {figures['channel']} offers: nothing to do"
    return (
        f"channel {figures['channel']} offers {figures['offered']} (counter {figures['counter']}); in use: {installed}\n"
        f"at most {figures['missing_bytes']:,} of {figures['release_bytes']:,} bytes to fetch: haptic-panel update download"
    )
