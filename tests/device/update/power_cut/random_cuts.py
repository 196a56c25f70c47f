"""A kernel under an ext4 that updates is killed at random moments, and started again: as root, with Debian's user-mode-linux.

usage: random_cuts.py CUTS [--seed N] [--break NAME]      exit code 0 if nothing was wrong after any cut; ends where something was

What only the killed kernel's memory had is lost; what it had written is there. Moments are of wall-clock time, so that runs differ.
"""

import argparse
import collections
import contextlib
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from mounting import loop_device, mount, own_mounts, unmount
from power_cuts import BROKEN, DISK_BYTES, OPTIONS
from small_releases import publish
from story import Truth, tree_of
from updated_device import Device

INIT = """#!/bin/sh
export PATH=/usr/sbin:/usr/bin:/sbin:/bin OPENBLAS_NUM_THREADS=1
mount -t proc proc /proc; mount -t devtmpfs dev /dev 2>/dev/null; mount -t tmpfs tmpfs {work}/tools
if mount -t ext4 -o {options} /dev/ubda {work}/device
then {python} {here}/guest_update.py {work} "$(cat {work}/truth)" {broken} 2>&1
else echo "FAULT brick: the file system cannot be mounted"; fi
echo ENDED
exec sleep 1000
"""


def end(process):
    """SIGKILL to a user-mode Linux with all its processes."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)


def prepare(work, versions, broken=""):
    """A disk with the first release, and what each release's files are."""
    for folder in ("repositories", "device", "tools"):
        (work / folder).mkdir()
    publish(work / "repositories", versions)
    disk = work / "disk.img"
    with disk.open("wb") as file:
        file.truncate(DISK_BYTES)
    subprocess.run(["mkfs.ext4", "-q", "-F", "-b", "4096", disk], check=True)
    device, trees = Device(work / "device", work / "tools", work / "repositories"), {}
    with loop_device(disk) as block:
        for version in [*versions[1:], versions[0]]:  # the first one stays
            subprocess.run(["mkfs.ext4", "-q", "-F", "-b", "4096", block], check=True)
            mount(block, device.root, OPTIONS)
            device.new(version)
            trees[version] = tree_of(device.root / "releases" / version)
            unmount(device.root)
    (work / "trees").write_text(json.dumps(trees))
    (work / "truth").write_text(str(Truth("first", (versions[0],))))
    init = work / "init"
    init.write_text(INIT.format(work=work, options=OPTIONS, python=sys.executable, here=Path(__file__).parent, broken=broken))
    init.chmod(0o755)


def live(work, cut_s=None):
    """Start the kernel, and kill it so long after it was found well, else after its first update.

    Returns the phase that was cut, the faults, and how long the first update took, in s.
    """
    command = ["/usr/bin/linux.uml", "mem=256M", f"ubd0={work}/disk.img", "con=null", "con0=null,fd:1", "root=/dev/root"]
    command += ["rootfstype=hostfs", "rootflags=/", "ro", "quiet", f"init={work}/init"]
    environment = os.environ | {"TMPDIR": "/dev/shm"}
    faults, output, checked_s, updated_s, timer = [], [], None, None, None
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment, start_new_session=True
    ) as machine:
        for line in machine.stdout:
            text = line.decode(errors="replace").rstrip("\r\n")
            output.append(text)
            word, _, rest = text.partition(" ")
            if word == "REPORTED":
                (work / "truth").write_text(rest)
                if cut_s is None and rest.startswith("promoted"):
                    updated_s = time.monotonic() - checked_s
                    end(machine)
            elif word == "FAULT":
                faults.append(rest)
            elif word == "CHECKED":
                checked_s = time.monotonic()
                if cut_s is not None:
                    timer = threading.Timer(cut_s, end, (machine,))
                    timer.start()
            elif word == "ENDED":
                faults.append("the update ended by itself: " + " / ".join(output[-5:]))
                end(machine)
        if timer:
            timer.cancel()
        end(machine)
    if checked_s is None:
        faults.append("brick: " + " / ".join(output[-5:]))
    return Truth.read((work / "truth").read_text()).phase, faults, updated_s


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("cuts", type=int, metavar="CUTS")
    parser.add_argument("--seed", type=int, default=14, metavar="N")
    parser.add_argument("--break", dest="broken", choices=BROKEN, default="", help="get it wrong")
    options = parser.parse_args()
    own_mounts()
    draw, phases = random.Random(options.seed), collections.Counter()
    with tempfile.TemporaryDirectory() as folder:  # not below /dev, which is the guest's own
        work = Path(folder)
        prepare(work, [f"{number}.0" for number in range(1, 4 + options.cuts)], options.broken)  # more than are taken
        _, _, update_s = live(work)
        for cut in range(options.cuts + 1):  # the last start only looks
            phase, faults, _ = live(work, draw.uniform(0, 1.2 * update_s) if cut < options.cuts else 0.0)
            for fault in faults:
                print(f"after cut {cut}: {fault}", flush=True)
            if faults:
                break
            if cut < options.cuts:
                phases[phase] += 1
    print(f"{phases.total()} cuts with nothing wrong behind them, by the phase that was cut: {dict(phases)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
