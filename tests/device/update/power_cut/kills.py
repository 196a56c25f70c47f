"""Kills the processes of an update with SIGKILL at chosen calls, does it again, and looks at what is there then.

usage: kills.py MOMENTS      exit code 0 if a device came to the new release each time, and has what one that was not disturbed has

A moment is before a call that changes a file, of script, download, installation (with pip) or judge, on this machine's own file
system; moments are spread evenly over all of them. A command and the programs that it started are killed, as by the
service manager.
"""

import collections
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))  # where the repository for tests is

from small_releases import publish
from story import tree_of
from updated_device import Device, Killed, Refused

OLD, NEW = "1.0", "2.0"
STEPS = {
    "download": lambda device: device.download(NEW),
    "install": lambda device: device.install(NEW),
    "switch": lambda device: device.answer(),
    "trial": lambda device: device.boot(),
    "judge": lambda device: device.judge(*["no permit"] * 5, "armed"),
    "promotion": lambda device: device.answer(),
    "start": lambda device: device.boot(),
}


def again(device):
    """What the machine does after a process was killed: the service is started, the timer updates, the judge judges."""
    device.boot()
    if device.word("current") != NEW:
        if device.word("trial") != NEW:
            device.install(NEW)
            device.answer()
        if device.boot() != NEW:
            raise Refused(f"{device.chosen()} is tried, not {NEW}")
        device.judge("armed")
        device.answer()
    device.boot()


def left(device):
    """Paths on a device, and what its release and its state are.

    How often was tried what is not on trial means nothing; nor does a `.NAME.new`, which the next write of NAME replaces.
    """
    paths = {str(path.relative_to(device.root)) for path in device.root.rglob("*") if not re.fullmatch(r"\..+\.new", path.name)}
    paths.discard("state/tries")
    states = {name: device.word(name) for name in ("current", "previous", "trial", "failed")}
    return {"paths": paths, "release": tree_of(device.root / "releases" / NEW), "state": states, "versions": device.start()}


def difference(found, wanted):
    """What is other than wanted, in words."""
    words = []
    for name in wanted:
        if found[name] != wanted[name]:
            if name == "paths":
                words.append(f"paths: {sorted(found[name] ^ wanted[name])[:5]}")
            else:
                words.append(f"{name}: {found[name] if name != 'release' else 'files are other ones'}")
    return words


class Killer:
    """Runs an update on copies of a device."""

    def __init__(self, work):
        self.work = work
        self.library = work / "kill_at.so"
        source = Path(__file__).with_name("kill_at.c")
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-Wall", "-Werror", "-o", self.library, source, "-ldl"], check=True)
        (work / "repositories").mkdir()
        publish(work / "repositories", [OLD, NEW])
        self.device = Device(work / "device", work / "tools", work / "repositories")
        self.device.root.mkdir()
        self.device.new(OLD)
        shutil.move(work / "device", work / "before")

    def update(self, at):
        """Update a fresh copy; kill it before a call. Calls by step, the step that was killed, and the device."""
        shutil.rmtree(self.work / "device", ignore_errors=True)
        subprocess.run(["cp", "-a", self.work / "before", self.work / "device"], check=True)
        count = self.work / "count"
        count.write_bytes(bytes(16))
        self.device.environment_more = {
            "LD_PRELOAD": str(self.library),
            "KILL_COUNT": str(count),
            "KILL_AT": str(at),
            "KILL_PARENT": str(os.getpid()),
        }
        calls, killed = {}, None
        for name, step in STEPS.items():
            before = int.from_bytes(count.read_bytes()[:8], "little")
            try:
                step(self.device)
            except Killed:
                killed = name
                break
            calls[name] = int.from_bytes(count.read_bytes()[:8], "little") - before
        self.device.environment_more = {}
        return calls, killed


def main(moments):
    with tempfile.TemporaryDirectory() as folder:
        killer = Killer(Path(folder))
        calls, _ = killer.update(0)
        again(killer.device)
        wanted, total = left(killer.device), sum(calls.values())
        print(f"{total} calls: {calls}")
        killed, wrong = collections.Counter(), 0
        for number in range(moments):
            at = 1 + (2 * number + 1) * total // (2 * moments)
            _, step = killer.update(at)
            try:
                again(killer.device)
                words = difference(left(killer.device), wanted)
            except (OSError, RuntimeError) as error:
                words = [str(error)]
            killed[step] += 1
            wrong += bool(words)
            for word in words:
                print(f"killed at call {at}, {step}: {word}", flush=True)
        print(f"{killed.total() - killed[None]} kills {dict(killed)}, {wrong} wrong")
    return 1 if wrong or killed[None] else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
