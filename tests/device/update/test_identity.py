"""Root does not work on a device's releases: its commands become another user before this code runs (test_as_user.py)."""

import os

import pytest

from controller.device.update.identity import refuse_root
from controller.device.update.layout import Layout
from controller.errors import UpdateError


def test_root_is_refused_on_a_devices_releases(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    with pytest.raises(UpdateError, match="belongs to the user haptic-update: call /usr/bin/haptic-panel"):
        refuse_root(Layout())


def test_elsewhere_and_for_others_nothing_is_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    refuse_root(Layout(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    refuse_root(Layout())
