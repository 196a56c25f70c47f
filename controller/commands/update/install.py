"""`haptic-panel update install`: fetch the release that is offered, build it beside the one in use, and ask for its trial."""

import argparse
from typing import Any

from controller.commands.common.output import progress_bar, show
from controller.commands.update.check import at_work, check, declare_source, ends_within, nothing_to_do
from controller.commands.update.download import download
from controller.errors import UpdateError
from controller.log import Event, log

INSTALL_S = 2700.0  # on the slowest card; it and a download fit into TimeoutStartSec= of haptic-panel-update.service


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    declare_source(step)
    step.add_argument("--automatic", action="store_true", help="do what `automatic` of update.toml says (for the timer)")
    step.set_defaults(command=install)


def install(options: argparse.Namespace) -> int:
    """Install the release; raises if it is refused."""
    from controller.device.update.download.fetch import TransferStatistics, fetch
    from controller.device.update.failed_install import failed_install, is_due
    from controller.device.update.install import install, prune
    from controller.device.update.requests import ask
    from controller.device.update.trial import keep_before
    from controller.device.update.trust.offer import NotYetError

    figures = TransferStatistics()
    with at_work() as (layout, settings):
        if options.automatic and not settings.source:
            show(options, {"version": None, "why": "no source is set"}, lambda _: "update.toml names no source: nothing to do")
            return 0
        if options.automatic and settings.automatic != "install":
            return {"check": check, "download": download}[settings.automatic](options)
        trial = layout.word("trial")
        if trial and options.automatic:  # it may wait for its permit for weeks
            show(options, {"version": trial, "new": False}, lambda _: f"{trial} is on trial: nothing to do")
            return 0
        if trial:
            raise UpdateError(f"{layout.state / 'trial'}: release {trial} is on trial: wait until it is decided (update status)")
        try:
            manifest = fetch(layout, settings, options.source, progress_bar("bytes"), figures=figures)
        except NotYetError as why:
            return nothing_to_do(options, why)
    reported: dict[str, Any] = {"version": manifest.version, "new": True, "fetched_bytes": figures.fetched_bytes}
    reported["release_bytes"] = manifest.total_bytes
    if layout.current.is_symlink() and layout.current.readlink().name == manifest.version:
        show(options, reported | {"new": False}, lambda _: f"{manifest.version} is in use: nothing to do")
        return 0
    if options.automatic and not is_due(layout, manifest) and (failed := failed_install(layout)):
        show(options, reported | {"new": False}, lambda _: f"{failed.in_words}; it is not tried at each look")
        return 0
    with ends_within(INSTALL_S, f"release {manifest.version}: not installed within {INSTALL_S:g} s; nothing of it is left"):
        prune(layout, manifest)
        install(layout, manifest, progress_bar("steps of the installation"))
        keep_before(layout)
        ask(layout, "trial", manifest.version)
    if options.automatic:
        log(_table(reported), Event.RELEASE_INSTALLED)
    else:
        show(options, reported, _table)
    return 0


def _table(figures: dict[str, Any]) -> str:
    fetched = f"{figures['fetched_bytes']:,} bytes fetched for {figures['release_bytes']:,}"
    return f"{figures['version']} is installed ({fetched}), and is tried now: haptic-panel update status"
