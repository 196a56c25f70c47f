"""Runs in a Debian container, as root, under a systemd of its own: the Debian package, from its installation to its purge."""

from the_package import done


def test_dpkg_is_this_machines_own():
    assert done("dpkg", "--audit") == ""
    assert "is not installed" in done("dpkg", "-s", "haptic-panel", code=1)
