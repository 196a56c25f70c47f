"""Where a board's own bank lies: in the state folder of the service, else in the user's cache."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs


def bank_path(board_name: str, scene_name: str) -> Path:
    """File of the bank that serves one scene of one board."""
    state = os.environ.get("STATE_DIRECTORY")  # set by systemd's StateDirectory=
    folder = Path(state.split(":")[0]) if state else platformdirs.user_cache_path("haptic-panel")
    return folder / "banks" / f"{board_name}-{scene_name}.bank"
