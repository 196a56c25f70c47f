"""Runs in a Debian container, as root, under a systemd of its own: nothing of a release runs as root, whatever root calls.

The release is as an attacker leaves it who owns the user haptic-update: a file that its Python runs at each start notes who it is.
"""

import argparse
import os
import pwd
import re
import subprocess
from pathlib import Path

from slow_form import slow
from the_package import ENVIRONMENT, done, install, package
from the_service import CHECKOUT, UNIT, wait_for

from controller.cli import COMMANDS, parser

ROOT = Path("/opt/haptic-panel")
SEEN = Path("/var/tmp/seen")
IDS = "'-'.join(map(str, (*os.getresuid(), *os.getresgid())))"
PLANTED = (  # a unit may write nowhere but to the journal
    f"import os; ids = {IDS}; os.write(2, f'planted {{ids}}\\n'.encode()) if 'INVOCATION_ID' in os.environ else "
    f"open('{SEEN}/' + ids, 'a').write(open('/proc/self/cmdline').read() + '\\n')\n"
)
LASTS = {"run", "record", "calibrate-touch", "judge", "--listen"}  # until Ctrl-C, or a verdict: called for their help alone
DOCUMENTS = (
    "README.md",
    "systemd/README.md",
    "controller/README.md",
    "controller/device/update/README.md",
    "boards/README.md",
    "boards/raspberry_pi.md",
)


def plant():
    """Put the file into the release in use, as its owner."""
    (packages,) = (ROOT / "current").resolve().glob("venv/lib/python3*/site-packages")
    owner = pwd.getpwnam("haptic-update")
    assert packages.stat().st_uid == owner.pw_uid
    (packages / "planted.pth").write_text(PLANTED)
    os.chown(packages / "planted.pth", owner.pw_uid, owner.pw_gid)


def users():
    """Users as which the planted file has run since the last time, by what has started it."""
    found = {}
    for file in SEEN.iterdir():
        uids = set(map(int, file.name.split("-")))
        found[file.name] = file.read_text()
        assert 0 not in uids, f"it ran as root: {file.read_text()!r}"
        file.unlink()
    return {pwd.getpwuid(int(name.split("-")[0])).pw_name for name in found}


def leaves(commands, words=()):
    """Every command with its steps, as words of a command line."""
    for action in commands._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, step in action.choices.items():
                yield from leaves(step, (*words, name))
            return
    yield words


def said(*command):
    """What a command of root's says, whatever becomes of it."""
    ended = subprocess.run(
        ["timeout", "120", *command], env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, check=False, cwd="/root",
    )  # fmt: skip
    assert ended.returncode not in (124, 137), f"{command}: does not end"
    return ended.stdout


def test_the_package_installs_a_release_and_leaves_it_to_its_owner():
    install("1.0")
    SEEN.mkdir()
    SEEN.chmod(0o1777)
    plant()
    done("systemctl", "daemon-reload")


def test_the_planted_file_runs_at_each_start_of_a_releases_python():
    """Or the other tests would show nothing."""
    done("/usr/lib/haptic-panel/as-user", "nobody", str(ROOT / "current/venv/bin/python"), "-I", "-c", "")
    assert users() == {"nobody"}


def called_by_root(called):
    """Command lines with --help: each runs as the user of its command."""
    for words in called:
        text = said("haptic-panel", *words, "--help")
        assert "usage: haptic-panel " + " ".join(words) in text, text
        expected = "haptic-update" if words[0] == "update" else UNIT
        assert users() == {expected}, words


def test_every_command_called_by_root_runs_as_another_user():
    first_steps = {words[0]: words for words in reversed(list(leaves(parser(COMMANDS))))}
    assert first_steps.keys() == COMMANDS.keys()
    called_by_root(first_steps.values())


@slow
def test_every_step_of_a_command_called_by_root_runs_as_another_user():
    steps = list(leaves(parser(COMMANDS)))
    assert len(steps) > 30
    called_by_root(steps)


def test_lines_of_the_documents_called_by_root_run_as_another_user():
    """Those that look at a device, as they stand: with the processes that they start."""
    lines = set()
    for document in DOCUMENTS:
        lines |= set(
            re.findall(r"\bhaptic-panel ((?:[a-z-]+ )*[a-z-]+(?: --[a-z-]+(?: panel)?)*)", (CHECKOUT / document).read_text())
        )
    wanted = [line for line in sorted(lines) if line.split()[0] in COMMANDS and not LASTS & set(line.split())]
    for line in [
        "--version",
        "status",
        "doctor",
        "update status",
        "update check",
        "update rollback",
        "update install",
        "update judge",
        *wanted,
    ]:
        said("haptic-panel", *line.split())
        seen = users()
        assert seen <= {"haptic-update", UNIT}, line
        assert seen, line
    print(f"{len(wanted) + 8} lines")


def test_what_root_pipes_into_a_script_of_roots_changes_a_board():
    board = Path("/etc/haptic-panel/boards/mine")
    board.mkdir(parents=True)
    source = (CHECKOUT / "boards/ulx3s/board.toml").read_text()
    (board / "board.toml").write_text(source)
    assert "written to" in said("sh", "-c", "echo 'ghost_ms = 3.0' | /usr/lib/haptic-panel/set-touch mine")
    assert users() == set()
    assert "ghost_ms = 3.0" in (board / "board.toml").read_text()
    (board / "board.toml").unlink()
    board.rmdir()


def test_units_start_a_release_as_its_users():
    for unit in (
        "haptic-panel-update.service",
        "haptic-panel-metrics.service",
        "haptic-panel-requests.service",
        "haptic-panel-trial.service",
    ):
        said("systemctl", "start", unit)
    said("systemctl", "start", UNIT)
    wait_for("an end", lambda: "activating" not in said("systemctl", "show", "-p", "ActiveState", UNIT))
    said("systemctl", "reload", UNIT)
    said("systemctl", "stop", UNIT, "haptic-panel-metrics")
    reported = re.findall("^planted ([0-9-]+)$", done("journalctl", "-b", "-o", "cat", "-g", "^planted "), re.MULTILINE)
    uids = {int(uid) for ids in reported for uid in ids.split("-")[:3]}
    assert {pwd.getpwuid(uid).pw_name for uid in uids} == {"haptic-update", "haptic-metrics", UNIT}


def test_dpkg_installs_upgrades_removes_and_purges_without_running_a_release_as_root():
    done(
        "apt-get",
        "install",
        "-y",
        "--reinstall",
        "--allow-downgrades",
        package("1.0"),
    )
    install("2.0")
    assert users() <= {"haptic-update", UNIT}
    done("apt-get", "purge", "-y", "haptic-panel")
    assert users() <= {"haptic-update", UNIT}
