"""Root gives up its rights before it works on a device's releases."""

import os
import pwd
import subprocess
import sys
from pathlib import Path

import pytest

from controller.errors import UpdateError
from controller.update.identity import become_update_user
from controller.update.layout import Layout

AS_NOBODY = """
import os
from controller.update import identity
from controller.update.layout import Layout
identity.USER = "nobody"
identity.become_update_user(Layout())
print(os.getresuid(), os.getresgid(), os.getgroups())
try:
    os.setuid(0)
except PermissionError:
    print("for good")
"""


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give up root")
def test_root_is_given_up_for_good():
    done = subprocess.run(
        [sys.executable, "-c", AS_NOBODY], capture_output=True, text=True, check=True, cwd=Path(__file__).parents[2]
    )
    nobody = pwd.getpwnam("nobody")
    said = f"{(nobody.pw_uid,) * 3} {(nobody.pw_gid,) * 3} {[nobody.pw_gid]}\nfor good\n"
    assert done.stdout == said


def test_without_that_user_nothing_is_done(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr("controller.update.identity.USER", "no-such-user")
    with pytest.raises(UpdateError, match="there is no user no-such-user: install the Debian package"):
        become_update_user(Layout())


def test_elsewhere_and_for_others_nothing_changes(monkeypatch, tmp_path):
    before = os.getresuid()
    become_update_user(Layout(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    become_update_user(Layout())
    assert os.getresuid() == before
