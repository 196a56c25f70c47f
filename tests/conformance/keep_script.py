"""A script of these tests in a file, for `haptic-panel gateware waves --script FILE`.

.venv/bin/python tests/conformance/keep_script.py WHAT FILE     # a table of fpga_rtl/timing by its name, or a seed of random_script
"""

import sys
from pathlib import Path

import timing_case
from random_script import random_script

from controller.device.board.lookup import data_folder
from controller.workshop.gateware.timing_table import load_cases


def script_of(what):
    """The script that is meant; SystemExit with all names for one there is none of."""
    if what.isdigit():
        return random_script(int(what))
    cases = {case.name: case for case in load_cases(data_folder("fpga_rtl") / "timing")}
    if what not in cases:
        raise SystemExit(f"{what}: neither a seed nor one of {', '.join(cases)}")
    return timing_case.script_of(cases[what])[0]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    file = Path(sys.argv[2])
    file.parent.mkdir(parents=True, exist_ok=True)
    script_of(sys.argv[1]).kept().write(file)
