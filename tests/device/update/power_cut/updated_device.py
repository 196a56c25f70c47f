"""A device as far as updates know it: a folder at $HAPTIC_PANEL_ROOT, the fall-back script, and the commands of `update`."""

import hashlib
import os
import re
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from controller.device.update.layout import Layout
from controller.device.update.requests import ask

PROJECT = Path(__file__).resolve().parents[4]
FALL_BACK = PROJECT / "systemd/fall-back"
FOLDERS = ("releases", "store", "state", "requests", "download")
NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z._+-]{0,63}")
WORDS = ("current", "previous", "trial")  # of the fall-back script's state: names of releases

# What the service does at its start, as far as files matter: its own interpreter imports what it is made of. Prints the versions.
START = """
import glob, sys
versions = set()
for folder in sys.path:
    versions.update(path.removesuffix(".dist-info").split("-")[1] for path in glob.glob("*.dist-info", root_dir=folder))
    for path in glob.glob(f"{folder}/*/table.py"):
        versions.update(__import__(f"{path.split('/')[-2]}.table", fromlist=["TABLE"]).TABLE)
print(*sorted(versions))
"""


class Refused(RuntimeError):
    """A command that ended with another code than 0."""


class Killed(RuntimeError):
    """A command that was ended by SIGKILL."""


@dataclass
class Device:
    """
    Attributes
    ----------
    root : Path
    tools : Path
        Folder of its own, not on the device's disk; commands in it come before all others.
    repositories : Path
        Of `small_releases.publish`.
    fall_back : Path
        The script.
    environment_more : dict
        Of all commands from now on.
    """

    root: Path
    tools: Path
    repositories: Path
    fall_back: Path = FALL_BACK
    environment_more: dict = field(default_factory=dict)

    def __post_init__(self):
        self.tools.mkdir(exist_ok=True)
        self.tool("systemctl", "case $1 in show) echo active ;; esac")

    def tool(self, name, script):
        """A command that everything finds before the system's."""
        (self.tools / name).write_text(f"#!/bin/sh\n{script}\n")
        (self.tools / name).chmod(0o755)

    def run(self, *command):
        """What a command prints; Refused if it fails."""
        environment = {
            "PATH": f"{self.tools}:{os.defpath}:/usr/sbin:/sbin",
            "HAPTIC_PANEL_ROOT": str(self.root),
            "HAPTIC_PANEL_TRUSTED_ROOT": str(self.repositories / "root.json"),
            "HOME": str(self.tools),
            "TMPDIR": str(self.tools),
            "PYTHONPATH": str(PROJECT),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        done = subprocess.run(
            command, env=environment | self.environment_more, capture_output=True, text=True, check=False, start_new_session=True
        )
        if done.returncode == -signal.SIGKILL:
            raise Killed(" ".join(map(str, command)))
        if done.returncode:
            words = " ".join(map(str, command))
            raise Refused(f"{words}: exit {done.returncode}: {done.stdout[-800:]}{done.stderr[-800:]}")
        return done.stdout

    def update(self, *words):
        """A command of `haptic-panel update`."""
        self.run(sys.executable, "-m", "controller", "update", *words)

    def new(self, version):
        """A fresh device with its first release."""
        for folder in FOLDERS:
            (self.root / folder).mkdir()
        self.download(version)
        self.install(version)
        for request in (self.root / "requests").iterdir():
            request.unlink()
        self.run(self.fall_back, "adopt", version)
        self.boot()
        os.sync()

    def download(self, version):
        """Fetch the release that is offered at that time."""
        self.update("download", "--from", self.repositories / version)

    def install(self, version):
        """Install what was fetched, and ask for its trial."""
        self.update("install", "--from", self.repositories / version)

    def judge(self, *states):
        """Judge the release on trial by states of the panel."""
        self.run(sys.executable, Path(__file__).with_name("judge_program.py"), self.tools / "status.json", *states)

    def ask(self, what, version):
        """Ask the fall-back script."""
        ask(Layout(self.root), what, version)

    def answer(self):
        """What systemd does when there are requests."""
        self.run(self.fall_back, "requests")

    def boot(self):
        """What systemd does before each start of the service; the release that was chosen."""
        self.run(self.fall_back, "boot")
        return self.chosen()

    def chosen(self):
        """The release in use."""
        target = str((self.root / "current").readlink())
        folder, _, version = target.partition("/")
        if folder != "releases" or not NAME.fullmatch(version):
            raise Refused(f"current points to {target!r}")
        return version

    def start(self):
        """Versions of all that the chosen release's own interpreter imports."""
        return self.run((self.root / "current").resolve() / "venv/bin/python", "-I", "-c", START).split()

    def word(self, name):
        """A word of the fall-back script's state; empty without one."""
        try:
            return (self.root / "state" / name).read_text().strip()
        except FileNotFoundError:
            return ""

    def failed(self):
        """Releases that are remembered as bad."""
        return self.word("failed").split()


def tree_of(folder):
    """Every file of a release: its content's digest, or where a link points."""
    tree = {}
    for path in sorted(folder.rglob("*")):
        if path.is_symlink():
            tree[str(path.relative_to(folder))] = f"-> {path.readlink()}"
        elif path.is_file():
            tree[str(path.relative_to(folder))] = hashlib.sha256(path.read_bytes()).hexdigest()
    return tree
