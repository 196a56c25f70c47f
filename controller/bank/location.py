"""Where what this software makes lies: in the state folder of the service, else in the user's cache."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs


def state_folder() -> Path:
    """Folder that is the service's or the user's own; it need not exist yet."""
    state = os.environ.get("STATE_DIRECTORY")  # set by systemd's StateDirectory=
    return Path(state.split(":")[0]) if state else platformdirs.user_cache_path("haptic-panel")


def bank_path(board_name: str, scene_name: str) -> Path:
    """File of the bank that serves one scene of one board."""
    return state_folder() / "banks" / f"{board_name}-{scene_name}.bank"
