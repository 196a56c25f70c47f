"""Who does the work of an update: the user `haptic-update`, and never root."""

from __future__ import annotations

import os

from controller.device.update.layout import ROOT, Layout
from controller.errors import UpdateError


def refuse_root(layout: Layout) -> None:
    """Refuse to work on this device's releases as root: /usr/bin/haptic-panel becomes another user before this runs.

    It keeps a checkout's command from leaving files of root's among those of `haptic-update`. What protects root from a release is
    that script: code that a less trusted user owns cannot be trusted to give up rights.

    Raises UpdateError if this is root, and the releases are not elsewhere ($HAPTIC_PANEL_ROOT).
    """
    if os.geteuid() == 0 and layout.root == ROOT:
        raise UpdateError(
            f"{layout.root}: belongs to the user haptic-update: call /usr/bin/haptic-panel, which becomes that user, or use"
            " /usr/lib/haptic-panel/as-user haptic-update"
        )
