"""`haptic-panel update download`: fetch the release that is offered into the store, without installing it."""

import argparse
from dataclasses import asdict
from typing import Any

from controller.commands.common.output import progress_bar, show
from controller.commands.update.check import at_work, declare_source, nothing_to_do


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    declare_source(step)
    step.set_defaults(command=download)


def download(options: argparse.Namespace) -> int:
    """Fetch the release; raises if it is refused."""
    from controller.device.update.download.fetch import TransferStatistics, fetch
    from controller.device.update.trust.offer import NotYetError

    figures = TransferStatistics()
    with at_work() as (layout, settings):
        try:
            manifest = fetch(layout, settings, options.source, progress_bar("bytes"), figures=figures)
        except NotYetError as why:
            return nothing_to_do(options, why)
    show(options, {"version": manifest.version, "counter": manifest.counter, **asdict(figures)}, _table)
    return 0


def _table(figures: dict[str, Any]) -> str:
    if not figures["release_bytes"]:
        return f"{figures['version']} is in use: nothing to fetch"
    return (
        f"{figures['version']} is here: {figures['fetched_bytes']:,} bytes fetched for {figures['release_bytes']:,};"
        f" {figures['kept_bytes']:,} were here, {figures['reused_bytes']:,} came from older banks"
    )
