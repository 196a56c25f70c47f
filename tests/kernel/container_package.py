"""Runs in a Debian container, as root, under a systemd of its own: the Debian package, from its installation to its purge."""

import contextlib
import grp
import json
import os
import pwd
import re
import shutil
import signal
import subprocess
import time
import urllib.request
from pathlib import Path

from serial_finger import SerialPanel
from slow_form import slow
from the_package import ENVIRONMENT, PACKAGES, done, install, package
from the_service import CHECKOUT, UNIT, journal, main_pid, shown, wait_for
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from controller.device.application_socket.client import PanelClient

ROOT = Path("/opt/haptic-panel")
BOARD = Path("/etc/haptic-panel/boards/mine")
PANEL = SerialPanel()
SHARED_GROUPS = ("spi", "i2c", "gpio")  # Raspberry Pi OS has them too: they stay
NOT_THE_PACKAGES = re.compile(
    "/(dev|proc|sys|run|tmp|checkout|packages|opt/packages)(/|$)|/var/(lib/(dpkg|apt|systemd)|cache|log|tmp)/|/etc/.*-$|/etc/ld.so.cache$|/root/"
)


def files():
    """All files of this machine, but for those that dpkg, systemd and these tests keep."""
    found = done("find", "/", "-xdev", "-not", "-path", "/proc/*").splitlines()
    return {path for path in found if not NOT_THE_PACKAGES.match(path)}


def accounts():
    """Names of users and groups."""
    return {line.split(":")[0] for name in ("passwd", "group") for line in Path("/etc", name).read_text().splitlines()}


BEFORE, ACCOUNTS_BEFORE = files(), accounts()


def in_use():
    """The version in use."""
    return str((ROOT / "current").readlink()).removeprefix("releases/") if (ROOT / "current").is_symlink() else ""


def owner(path):
    """Owner, group and mode."""
    status = path.lstat()
    user, group = pwd.getpwuid(status.st_uid).pw_name, grp.getgrgid(status.st_gid).gr_name  # Path.owner() follows links
    return f"{user}:{group} {status.st_mode & 0o7777:o}"


def emissions():
    """What the running panel has played."""
    with PanelClient("/run/haptic-panel/panel.sock") as panel:
        panel.play("click", at_mm=(100, 70))
        return panel.figures()["emissions"]


def plays():
    """Whether the service plays what a client asks for."""
    before = emissions()
    return wait_for("an emission", lambda: emissions() > before)


def same_service(pid):
    """Whether the service was not restarted."""
    return main_pid() == pid and shown("ActiveState") == "active"


def repacked(version, revision, change):
    """Path of a package with another revision, in whose files something was changed."""
    folder, path = Path("/tmp/repacked"), f"/tmp/haptic-panel_{version}-{revision}.deb"
    done("dpkg-deb", "-R", package(version), str(folder))
    control = folder / "DEBIAN/control"
    control.write_text(control.read_text().replace(f"Version: {version}-1\n", f"Version: {version}-{revision}\n"))
    change(folder)
    done("dpkg-deb", "-Zgzip", "-b", str(folder), path)
    shutil.rmtree(folder)
    return path


def test_it_is_installed_by_the_first_line_of_the_readme_without_a_network():
    text = (CHECKOUT / "systemd/README.md").read_text()
    line, then = re.search(r"^## Install\n.*?^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)[1].splitlines()
    assert then == f"systemctl enable --now {UNIT}", "which another test does"
    said = done("sh", "-c", f"cd {PACKAGES} && exec {line}")
    assert "rror" not in said.replace("libgpg-error0", ""), said
    assert in_use() == "1.0"
    assert done("dpkg", "-V", "haptic-panel") == ""
    assert done("haptic-panel", "--version").strip()


def test_each_folder_has_its_owner():
    owners = {path.name: owner(path) for path in (ROOT, *ROOT.iterdir())}
    assert owners == {
        "haptic-panel": "root:root 755",
        ".lock": "root:root 600",
        "current": "root:root 777",
        "state": "root:root 755",
        "releases": "haptic-update:haptic-update 755",
        "store": "haptic-update:haptic-update 755",
        "requests": "haptic-update:root 775",
        "download": "haptic-update:haptic-update 755",
    }, owners
    assert done("find", str(ROOT / "releases"), str(ROOT / "store"), "!", "-user", "haptic-update") == ""
    assert done("find", str(ROOT), "-perm", "/6000", "-o", "-perm", "/002", "!", "-type", "l") == "", "nobody else may write"
    groups = set(done("id", "-nG", UNIT).split())
    assert groups == {UNIT, *SHARED_GROUPS, "input", "dialout", "haptic-play"}
    assert done("id", "-nG", "haptic-update").split() == ["haptic-update"], "who installs releases has no devices"


def test_what_plays_is_started_by_the_owner_and_what_watches_by_the_package():
    assert (shown("UnitFileState"), shown("ActiveState")) == ("disabled", "inactive")
    for unit in ("haptic-panel-requests.path", "haptic-panel-update.timer"):
        assert done("systemctl", "is-enabled", unit) == "enabled\n"
        assert done("systemctl", "is-active", unit) == "active\n"
    assert done("systemd-analyze", "verify", "--man=no", f"/lib/systemd/system/{UNIT}.service") == ""


def test_the_service_starts_and_plays_on_the_board_of_the_release():
    Path("/run/touch").symlink_to(PANEL.device)
    PANEL.belongs_to("dialout")
    done("systemctl", "enable", "--now", UNIT)
    wait_for("the socket", Path("/run/haptic-panel/panel.sock").exists)
    assert plays()


@contextlib.contextmanager
def page(origin="http://127.0.0.1:8750"):
    """A page of the bridge, as a browser would open it: a function that sends a message and returns its answer."""
    with connect("ws://127.0.0.1:8750/panel", origin=origin, open_timeout=120) as socket:
        assert json.loads(socket.recv(timeout=120))["kind"] == "page"

        def ask(**message):
            socket.send(json.dumps({**message, "id": "asked"}))
            while (answer := json.loads(socket.recv(timeout=120))).get("id") != "asked":
                pass
            return answer

        yield ask


def bridge_is_there():
    """Whether a page can be fetched."""
    with contextlib.suppress(OSError), urllib.request.urlopen("http://127.0.0.1:8750/") as answer:
        return b"Haptic panel" in answer.read()
    return False


def test_a_page_of_the_bridge_lays_regions_plays_and_stops_the_panel():
    text = (CHECKOUT / "systemd/README.md").read_text()
    for line in re.search(r"^## Web pages\n.*?^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)[1].splitlines():
        done("sh", "-c", line)
    wait_for("the live page", bridge_is_there)
    assert set(done("id", "-nG", "haptic-page").split()) == {"haptic-page", "haptic-play"}
    with page() as ask:
        region = {"name": "ok", "shape": "rectangle", "x_mm": 20, "y_mm": 30, "width_mm": 40, "height_mm": 12, "effects": ["click"]}
        laid = ask(kind="regions", regions=[region])
        assert (laid["kind"], laid["regions"]) == ("layer", 1), laid
        wait_for("a click", lambda: ask(kind="play", effect="click", x_mm=100, y_mm=70)["outcome"] == "played")
        assert "may not arm" in ask(kind="arm")["reason"]
        assert ask(kind="stop")["outcome"] == "done"
        wait_for("outputs that are off", lambda: not ask(kind="state")["outputs_on"])
        assert "haptic-page" in ask(kind="state")["cause"]
    status = 101
    try:
        with page("http://elsewhere.example"):
            pass
    except InvalidStatus as refused:
        status = refused.response.status_code
    assert status == 403, "a page of another origin"
    with PanelClient("/run/haptic-panel/panel.sock") as panel:
        panel.arm()
        wait_for("outputs that are on", lambda: panel.state().outputs_on)
    assert plays()


def greeting():
    """What a page of the bridge is told first; None if no page can be opened."""
    with contextlib.suppress(OSError), connect("ws://127.0.0.1:8750/panel", origin="http://127.0.0.1:8750") as socket:
        return json.loads(socket.recv(timeout=120))
    return None


def test_a_scene_that_an_operator_saves_and_the_screen_of_a_page_outlive_both_services():
    place = {"x_mm_from_pixels": [0.1, 0.0, 0.0], "y_mm_from_pixels": [0.0, -0.1, 148.0]}
    Path("/etc/haptic-panel/page.toml").write_text('[origins]\nself = ["play", "screen"]\n')
    done("systemctl", "restart", "haptic-panel-page")
    wait_for("the live page", bridge_is_there)
    with page() as ask:
        assert ask(kind="screen", **place)["outcome"] == "done"
        assert "may not save_scene" in ask(kind="save_scene", name="mine", toml="")["reason"]
    with PanelClient("/run/haptic-panel/panel.sock") as panel:
        panel.save_scene("kept", '[[regions]]\nname = "all"\nshape = "plate"\neffects = ["click"]\n')
    (kept,) = Path("/var/lib/haptic-panel/scenes").glob("*/kept.toml")
    assert kept.owner() == "haptic-panel"
    assert Path("/var/lib/haptic-page/screen.json").owner() == "haptic-page"
    done("systemctl", "restart", UNIT, "haptic-panel-page")
    screen = wait_for("a page", greeting)
    assert {key: screen[key] for key in place} == place
    wait_for("the socket", Path("/run/haptic-panel/panel.sock").exists)
    with PanelClient("/run/haptic-panel/panel.sock") as panel:
        panel.load_scene("kept")
        assert [region.name for region in panel.describe().regions] == ["all"]
    done("systemctl", "disable", "--now", "haptic-panel-page")
    done("systemctl", "restart", UNIT)
    assert plays()


def test_the_same_package_again_changes_nothing_and_the_panel_plays_on():
    pid = main_pid()
    release = ROOT / "releases/1.0"
    made = release.stat().st_ino
    done("apt-get", "install", "-y", "--reinstall", package("1.0"))
    assert same_service(pid)
    assert release.stat().st_ino == made
    assert done("dpkg", "-V", "haptic-panel") == ""


def change_unit(folder):
    """Another unit in a package."""
    unit = folder / f"lib/systemd/system/{UNIT}.service"
    unit.write_text(unit.read_text() + f"# changed by {time.time_ns()}\n")


def test_a_changed_unit_is_started_after_the_old_one_has_ended():
    pid = main_pid()
    done("dpkg", "-i", repacked("1.0", 2, change_unit))
    wait_for("a new process", lambda: main_pid() not in {0, pid} and shown("ActiveState") == "active")
    assert f"Stopped {UNIT}.service" in journal()
    assert plays()


def test_an_upgrade_brings_the_newer_release_on_trial():
    settings = Path("/etc/haptic-panel/update.toml")
    settings.write_text(settings.read_text() + "healthy_s = 1.0\n")
    assert "release 2.0 is tried" in done("dpkg", "-i", repacked("2.0", 2, change_unit))
    wait_for("release 2.0", lambda: in_use() == "2.0" and shown("ActiveState") == "active")
    wait_for("the verdict", lambda: "release 2.0 serves, and stays" in journal())
    assert "release 2.0 is on trial, start 1 of 3" in journal()
    assert "release 2.0 is on trial, start 2 of 3" not in journal(), "the new unit is started with the trial, not after it"
    assert shown("NeedDaemonReload") == "no"
    assert plays()
    assert (ROOT / "releases/1.0/.complete").exists(), "what it would go back to"
    assert settings.read_text().endswith("healthy_s = 1.0\n"), "settings are the owner's"


def test_an_older_package_leaves_the_newer_release_in_use():
    pid = main_pid()
    assert "release 2.0 stays in use: it is not older than 1.0" in done(
        "apt-get", "install", "-y", "--allow-downgrades", package("1.0")
    )
    assert in_use() == "2.0"
    assert same_service(pid) or shown("NeedDaemonReload") == "no"
    install("2.0")


def test_removed_it_has_stopped_and_releases_and_settings_stay():
    done("apt-get", "remove", "-y", "haptic-panel")
    assert main_pid() == 0
    assert shown("LoadState") in {"not-found", "masked"}
    assert not Path("/usr/bin/haptic-panel").exists()
    assert in_use() == "2.0"
    assert (ROOT / "releases/2.0/.complete").exists()


def test_installed_again_it_goes_on_with_the_release_of_before():
    made = (ROOT / "releases/2.0").stat().st_ino
    install("2.0")
    assert in_use() == "2.0"
    assert (ROOT / "releases/2.0").stat().st_ino == made
    done("systemctl", "enable", "--now", UNIT)
    wait_for("the socket", Path("/run/haptic-panel/panel.sock").exists)
    assert plays()


def purge():
    """Purge it."""
    return done("apt-get", "purge", "-y", "haptic-panel")


def test_purged_nothing_of_it_is_left_but_the_owners_board():
    BOARD.mkdir()
    purge()
    assert main_pid() == 0
    left = {path for path in files() - BEFORE if not path.startswith(str(BOARD))}
    assert left == {"/etc/haptic-panel", "/etc/haptic-panel/boards"}, "the owner's board stays where it was"
    assert accounts() - ACCOUNTS_BEFORE == set(SHARED_GROUPS)
    assert "not-found" in done("systemctl", "show", "-p", "LoadState", UNIT)
    shutil.rmtree("/etc/haptic-panel")


def configure_and_kill(step, made):
    """Let dpkg configure the package, and kill it and all it has started once one of these paths was made."""
    began_ns = time.time_ns()
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    dpkg = subprocess.Popen(["dpkg", "--configure", "haptic-panel"], env=ENVIRONMENT, start_new_session=True, **quiet)

    def is_new(path):
        with contextlib.suppress(FileNotFoundError):
            return path.lstat().st_ctime_ns >= began_ns
        return False

    def is_made():
        with contextlib.suppress(FileNotFoundError):  # what the one before has left is removed meanwhile
            return any(map(is_new, ROOT.glob(made)))
        return False

    while not is_made():
        assert dpkg.poll() is None, f"{step}: dpkg ended before"
    os.killpg(dpkg.pid, signal.SIGKILL)
    dpkg.wait()


STEPS = {  # of an installation, and what is there once each was begun
    "folders": "requests",
    "installer": "download/installer/pyvenv.cfg",
    "its wheels": "download/installer/lib/python3*/site-packages/controller/cli.py",
    "store": "store/*",
    "release": "releases/1.0/venv/pyvenv.cfg",
    "release's wheels": "releases/1.0/venv/lib/python3*/site-packages/controller/cli.py",
    "complete": "releases/1.0/.complete",
    "adopted": "current",
}


def installation_killed_at(*steps):
    """dpkg, killed at one step after the other, ends the installation when it is called again."""
    done("dpkg", "--unpack", package("1.0"))
    for step in steps:
        configure_and_kill(step, STEPS[step])
    done("dpkg", "--configure", "-a")
    assert in_use() == "1.0"
    assert (ROOT / "releases/1.0/.complete").exists()
    assert done("haptic-panel", "--version").strip()
    assert list((ROOT / "download").glob("installer*")) == []
    assert done("dpkg", "-V", "haptic-panel") == ""
    assert done("dpkg", "--audit") == ""
    purge()
    assert files() - BEFORE == set()


def test_killed_among_the_wheels_of_the_installer_and_of_the_release_dpkg_ends_the_installation_when_called_again():
    installation_killed_at("its wheels", "release's wheels")


@slow
def test_killed_at_one_step_after_the_other_dpkg_ends_the_installation_when_called_again():
    installation_killed_at(*STEPS)


def old_layout():
    """The files of an installation from before the package, with a service that runs."""
    for name in ("bin", "lib/python3.11", "include", "share"):
        (ROOT / name).mkdir(parents=True)
    (ROOT / "lib64").symlink_to("lib")
    program = ROOT / "bin/haptic-panel"
    program.write_text("#!/bin/sh\nexec sleep infinity\n")
    program.chmod(0o755)
    (ROOT / "pyvenv.cfg").write_text("home = /usr/bin\n")
    Path("/etc/systemd/system/haptic-panel.service").write_text(
        f"[Service]\nExecStart={program} run --board panel\nRuntimeDirectory=haptic-panel\n[Install]\nWantedBy=multi-user.target\n"
    )
    done("systemctl", "daemon-reload")
    done("systemctl", "enable", "--now", UNIT)


def test_an_environment_of_before_is_kept_aside_and_its_service_goes_on_with_the_release():
    old_layout()
    pid = main_pid()
    install("1.0")
    assert in_use() == "1.0"
    kept = ROOT / "before-package.1"
    assert {path.name for path in kept.iterdir()} == {"bin", "lib", "lib64", "include", "share", "pyvenv.cfg", "etc", "whole"}
    assert (kept / "etc/systemd/system/haptic-panel.service").exists()
    assert {path.name for path in ROOT.iterdir()} == {
        ".lock", "before-package.1", "current", "state", "releases", "store", "requests", "download",
    }  # fmt: skip
    assert shown("UnitFileState") == "enabled"
    assert shown("FragmentPath") == f"/lib/systemd/system/{UNIT}.service"
    assert main_pid() not in {0, pid}
    assert plays()
    purge()
    assert files() - BEFORE == set()


@slow
def test_an_environment_that_was_moved_in_part_is_moved_whole():
    old_layout()
    kept = ROOT / "before-package.1"
    kept.mkdir()
    for name in ("bin", "lib"):
        (ROOT / name).rename(kept / name)
    install("1.0")
    assert in_use() == "1.0"
    assert {path.name for path in kept.iterdir()} >= {"bin", "lib", "lib64", "include", "share", "pyvenv.cfg"}
    purge()
    assert files() - BEFORE == set()


def test_an_installation_from_a_checkout_makes_room_too():
    release = ROOT / "releases/checkout"
    (release / "venv/bin").mkdir(parents=True)
    (release / "venv/bin/python").symlink_to("/usr/bin/python3")
    (release / ".complete").touch()
    (ROOT / "current").symlink_to("releases/checkout")
    systemd = CHECKOUT / "systemd"
    for pattern, folder in {
        "*.service": "systemd/system",
        "*.timer": "systemd/system",
        "*.path": "systemd/system",
        "sysusers.d/*": "sysusers.d",
        "tmpfiles.d/*": "tmpfiles.d",
        "udev/*": "udev/rules.d",
    }.items():
        for path in systemd.glob(pattern):
            Path("/etc", folder).mkdir(parents=True, exist_ok=True)
            shutil.copy(path, Path("/etc", folder, path.name))
    done("systemctl", "daemon-reload")
    done("systemctl", "enable", UNIT)
    install("1.0")
    assert in_use() == "1.0"
    assert release.exists(), "what was in use before stays"
    assert shown("FragmentPath") == f"/lib/systemd/system/{UNIT}.service"
    assert (shown("UnitFileState"), shown("ActiveState")) == ("enabled", "inactive")
    kept = ROOT / "before-package.1/etc"
    assert {path.name for path in (kept / "systemd/system").iterdir()} >= {f"{UNIT}.service", "haptic-panel-update.timer"}
    assert list(Path("/etc").rglob("haptic-panel*.service")) == [
        Path(f"/etc/systemd/system/multi-user.target.wants/{UNIT}.service")
    ]
    purge()
    assert files() - BEFORE <= {"/etc/sysusers.d", "/etc/tmpfiles.d", "/etc/udev/rules.d"}, (
        "folders that the lines of the README made"
    )
