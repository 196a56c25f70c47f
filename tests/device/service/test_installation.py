"""What is said of a package that cannot be imported."""

import sys
from importlib.util import find_spec

from controller.device.service import installation
from controller.device.service.installation import missing_package


def test_in_a_checkout_the_line_that_installs_the_extra():
    assert "-m pip install" in missing_package("scipy.linalg")
    assert missing_package("another") is None


def test_a_release_is_not_advised_to_install_what_no_release_has(tmp_path, monkeypatch):
    (tmp_path / "release.json").write_text("{}")
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "venv"))
    said = missing_package("scipy")
    assert "one of the offline tools that this needs: use a computer with a checkout" in said
    assert "pip install" in missing_package("spidev")


def test_a_room_that_was_left_out_is_named_and_a_module_that_never_was_is_not():
    assert missing_package("controller.device.rooftop.view") == (
        "this needs controller/device/rooftop, which this installation does not have: install all of it again"
    )
    assert missing_package("controller.device.bank.misspelled") is None
    assert missing_package("controller.misspelled") is None


def test_without_the_workshop_nothing_that_only_it_needs_is_to_be_installed(monkeypatch):
    monkeypatch.setattr(installation, "find_spec", lambda name: None if name == "controller.workshop" else find_spec(name))
    said = "this needs the workshop, which this installation does not have: use a computer with a checkout"
    for name in ("controller.workshop", "controller.workshop.physics.plate", "scipy.linalg", "sounddevice", "cyclonedx"):
        assert missing_package(name).startswith(said), name
    assert "pip install" in missing_package("tuf")
