"""Who does the work of an update: the user `haptic-update`, also when root asks for it."""

from __future__ import annotations

import os
import pwd
from typing import Final

from controller.errors import UpdateError
from controller.update.layout import ROOT, Layout

USER: Final = "haptic-update"


def become_update_user(layout: Layout) -> None:
    """Give up root for good; of nobody else, and for releases elsewhere ($HAPTIC_PANEL_ROOT), nothing changes.

    Raises
    ------
    UpdateError
        If there is no such user.
    """
    if os.geteuid() != 0 or layout.root != ROOT:
        return
    try:
        user = pwd.getpwnam(USER)
    except KeyError as error:
        raise UpdateError(f"{layout.root}: there is no user {USER}: install the Debian package haptic-panel") from error
    os.initgroups(USER, user.pw_gid)
    os.setresgid(user.pw_gid, user.pw_gid, user.pw_gid)
    os.setresuid(user.pw_uid, user.pw_uid, user.pw_uid)
    os.environ["HOME"] = user.pw_dir
    os.environ["USER"] = os.environ["LOGNAME"] = USER
    os.umask(0o022)
