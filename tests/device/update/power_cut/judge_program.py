"""The judge of a trial, with statuses made here and a clock of its own: usage: judge_program.py STATUS STATE...

A state is that of the panel at each look, the last one from then on.
"""

import os
import sys
from pathlib import Path

import msgspec

from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.update.layout import Layout
from controller.device.update.trial import judge_trial

HEALTHY_S = 3.0
COUNTS = ("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped", "waiting")


def main(status_file, *states):
    layout, now_s, states = Layout.from_environment(), 500.0, list(states)

    def write(seconds):
        nonlocal now_s
        now_s += seconds
        status = PanelStatus(
            **dict.fromkeys(COUNTS, 0) | {"log_lines_lost": 0, "statuses_lost": 0},
            upload=LatencyStatus(),
            resident=LatencyStatus(),
            release=layout.word("trial"),
            board="panel",
            pid=os.getpid(),
            boot="",
            started_s=0.0,
            written_s=now_s,
            state=PanelState(states.pop(0) if len(states) > 1 else states[0]),
            cause="",
            outputs_on=False,
            panel_present=True,
            temperature_c=None,
        )
        status_file.write_bytes(msgspec.json.encode(status))

    write(0.0)
    judge_trial(layout, HEALTHY_S, lambda _: None, status_file, lambda: now_s, write)


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
