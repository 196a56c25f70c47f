"""What is said of a package that cannot be imported."""

import sys

from controller.service.installation import missing_package


def test_in_a_checkout_the_line_that_installs_the_extra():
    assert "-m pip install" in missing_package("scipy.linalg")
    assert missing_package("another") is None


def test_a_release_is_not_told_to_install_what_no_release_has(tmp_path, monkeypatch):
    (tmp_path / "release.json").write_text("{}")
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "venv"))
    assert (
        missing_package("scipy")
        == "scipy is missing, one of the offline tools, which no release has: use a checkout, set_up.sh offline"
    )
    assert "pip install" in missing_package("spidev")
