"""Settings of updates on a device: /etc/haptic-panel/update.toml."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta

from controller.device.board.records import Positive, Record, load_toml
from controller.device.update.layout import SETTINGS


class UpdateSettings(Record, frozen=True):
    """Where updates come from, and what is done with them."""

    # http(s) address of the repository, or a folder (a stick); empty: nothing is fetched unless `--from` says origin
    source: str = ""
    channel: Annotated[str, Meta(pattern=r"^[0-9a-z-]{1,32}\Z")] = "stable"
    automatic: Literal["check", "download", "install"] = "install"  # what the timer does: check, download or install
    total_s: Positive = 3600.0  # longest time of one update over the network, in s
    bytes_per_s: Annotated[float, Meta(ge=0)] = 0.0  # most that is fetched, in bytes/s; 0: as much as there is
    healthy_s: Annotated[float, Meta(ge=1, le=600)] = 20.0  # for how long a trial must serve before it stays, in s


def load_settings(file: Path = SETTINGS) -> UpdateSettings:
    """The settings; those of an absent file are the defaults; raises ConfigError if the file is invalid."""
    return load_toml(file, UpdateSettings) if file.exists() else UpdateSettings()
