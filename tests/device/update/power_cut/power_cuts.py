"""Records updates on a disk, and looks at every state in which a power cut could have left it: as root.

usage: power_cuts.py [--every N] [--subsets N] [--carry-on N] [--break NAME]      exit code 0 if no state is faulty

Prints how many different states there were in each phase, and what is wrong with which.
"""

import argparse
import collections
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))  # where the repository for tests is

from crash_states import crash_states
from mounting import errors_found, loop_device, memory_of, mount, own_mounts, recording_disk, require_unused, unmount
from recording_disk import read_log
from small_releases import publish
from story import LATER, Story, Truth, carry_on, faults, tree_of
from updated_device import Device

DISK_BYTES = 80 << 20
FIRST = str(Truth("first", ("1.0",)))  # mark: from here on the power may be cut
# POSIX only: without it ext4 forgives a file that is renamed over another before its content is synced.
OPTIONS = "noauto_da_alloc"


BROKEN = {  # ways to get it wrong, which must be found
    "sync": "nothing is synced by a command: script and installation",
    "install": "a release is called complete before it is synced",
    "in-place": "the script's state is written in place",
}


@dataclass
class Findings:
    """
    Attributes
    ----------
    points : set
        (phase, digest of the disk's content).
    faults : list of (str, str)
        Where, and what.
    """

    points: set = field(default_factory=set)
    faults: list = field(default_factory=list)


def record(work, live, options=OPTIONS):
    """The log of what `live` does with a fresh file system.

    Parameters
    ----------
    work : Path
        Folder; the device is at `work/device`.
    live : callable
        Takes a function that marks the log; what it does before the mark `FIRST` is not recorded as crash states.
    """
    log = work / "log"
    mnt = work / "device"
    mnt.mkdir(exist_ok=True)
    with recording_disk(work / "disk", DISK_BYTES, log) as (device, mark):
        subprocess.run(["mkfs.ext4", "-q", "-F", "-b", "4096", "-m", "0", "-E", "nodiscard,lazy_itable_init=0", device], check=True)
        mount(device, mnt, options)
        try:
            live(mark.write_text)
        finally:
            unmount(mnt)
    (work / "disk").rmdir()
    return read_log(log)


def replay(work, entries, examine, every=1, **how):
    """Mount the states after the mark `FIRST` and examine them.

    Parameters
    ----------
    work : Path
    entries : list
    examine : callable
        Takes a CrashState, mounted at `work/device`; returns faults.
    every : int
        Only each this many-th state.
    how
        Of `crash_states`.

    Returns
    -------
    Findings
    """
    findings = Findings()
    mnt = work / "device"
    with memory_of(work / "state.img", DISK_BYTES) as image, loop_device(work / "state.img") as device:
        for number, state in enumerate(crash_states(entries, DISK_BYTES, FIRST, **how)):
            if number % every:
                continue
            require_unused(device)
            state.write_to(image)
            try:
                mount(device, mnt, OPTIONS)
            except OSError as error:
                found = [f"brick: {error}"]
            else:
                try:
                    found = examine(state)
                finally:
                    unmount(mnt)
                if errors_found(image):
                    found.append(f"brick: the kernel found {errors_found(image)} errors in the file system")
            findings.points.add((state.marks[-1].split()[0], state.digest))
            where = f"state {number}, entry {state.entry}, {'prefix' if state.is_prefix else 'subset'}, {state.marks[-1]}"
            findings.faults += [(where, fault) for fault in found]
    return findings


def live(device, story, mark):
    """The recorded life of a device."""
    story.tell = lambda truth: mark(str(truth))
    device.new("1.0")
    story.trees["1.0"] = tree_of(device.root / "releases/1.0")
    mark(FIRST)
    story.good("1.0", "2.0")
    story.crashes("2.0", "3.0")
    story.evaluated_bad("2.0", "4.0")
    story.roll_back("2.0", "1.0")
    story.good("1.0", "5.0")


def broken(device, how):
    """A device that does it wrong."""
    if how == "sync":
        device.tool("sync", "")
    elif how == "install":
        device.tool("sync", 'case "$*" in *"/releases"*) exit ;; esac\nexec /usr/bin/sync "$@"')
    elif how == "in-place":
        script, changes = re.subn(r'>"\$state/\.\$name\.new" && .*', '>"$state/$name"', device.fall_back.read_text())
        if changes != 1:
            raise AssertionError("the script writes in another way now")
        device.fall_back = device.tools / "fall-back"
        device.tool("fall-back", script)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only each N-th state")
    parser.add_argument("--subsets", type=int, default=2, metavar="N", help="between two flushes")
    parser.add_argument("--carry-on", type=int, default=0, metavar="N", help="bring each N-th state to a later release")
    parser.add_argument("--break", dest="broken", choices=BROKEN, help="get it wrong")
    options = parser.parse_args()
    own_mounts()
    with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
        work = Path(folder)
        (work / "repositories").mkdir()
        publish(work / "repositories", ["1.0", "2.0", "3.0", "4.0", "5.0", LATER])
        device = Device(work / "device", work / "tools", work / "repositories")
        broken(device, options.broken)
        story = Story(device)
        entries = record(work, lambda mark: live(device, story, mark))
        examined = 0

        def examine(state):
            nonlocal examined
            examined += 1
            found = faults(device, Truth.read(state.marks[-1]), story.trees)
            if options.carry_on and examined % options.carry_on == 0 and not found:
                found = carry_on(device)
            return found

        findings = replay(work, entries, examine, options.every, subsets=options.subsets)
    phases = collections.Counter(phase for phase, _ in findings.points)
    for phase, count in phases.items():
        print(f"{phase}: {count} states")
    for where, fault in findings.faults:
        print(f"{where}: {fault}")
    kinds = collections.Counter(fault.partition(":")[0] for _, fault in findings.faults)
    print(f"{len({digest for _, digest in findings.points})} different crash points, {len(findings.faults)} faults {dict(kinds)}")
    return 1 if findings.faults else 0


if __name__ == "__main__":
    sys.exit(main())
