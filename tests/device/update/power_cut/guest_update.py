"""In a user-mode Linux: looks at what the last power cut left, and then updates until the next one.

usage: guest_update.py WORK TRUTH [BREAK]      prints `REPORTED truth` before and after each step, `FAULT …`, and `CHECKED` once
"""

import json
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from power_cuts import broken
from story import Story, Truth, faults
from updated_device import Device


def main(work, truth, how=""):
    device = Device(work / "device", work / "tools", work / "repositories")
    broken(device, how)
    for fault in faults(device, Truth.read(truth), json.loads((work / "trees").read_text())):
        print(f"FAULT {fault}", flush=True)
    story = Story(device, tell=lambda reported: print(f"REPORTED {reported}", flush=True), failed=device.failed())
    current, trial = device.word("current"), device.word("trial")
    story.now("resumed", *filter(None, (current, trial)))
    print("CHECKED", flush=True)
    if trial:
        device.judge("armed")
        device.answer()
    while True:
        old = device.word("current")
        story.now("resumed", old)
        later = [path.name for path in device.repositories.iterdir() if path.name[0].isdigit() and path.name not in story.failed]
        new = min((float(version) for version in later if float(version) > float(old)), default=None)
        if new is None:
            return
        story.good(old, str(new))


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
