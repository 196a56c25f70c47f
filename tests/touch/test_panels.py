"""The registry of panel drivers, and that a new kind of panel takes the places that the README of the room says, and no others."""

import os
import re
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import get_args, get_type_hints

import pytest

from controller.board.board import load_board
from controller.board.lookup import data_folder
from controller.board.touch_panels import RecordingTouch, Touch
from controller.errors import TouchError
from controller.service import drivers
from controller.touch.panels import PANELS, driver_of, open_panel

CONTROLLER = Path(drivers.__file__).parent.parent
BOARD = load_board(data_folder("boards") / "simulated")

RECORD = '''class MadeUpTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="made_up"):
    """A panel that does not exist."""

    device: Name


'''
DRIVER = '''"""A made-up panel: one finger at once, then nothing."""

from collections import Counter

from controller.touch import event_codes as ev
from controller.touch.event_reader import AxisInfo, DeviceDescription


class MadeUp:
    def __init__(self, device):
        self.warnings, self.present = Counter(), True
        self.description = DeviceDescription(device, axes=dict.fromkeys(ev.POSITIONS_SINGLE, AxisInfo(0, 100)))
        self._events = [(ev.EV_ABS, ev.ABS_X, 50, 0.0), (ev.EV_ABS, ev.ABS_Y, 50, 0.0)]
        self._events += [(ev.EV_KEY, ev.BTN_TOUCH, 1, 0.0), (ev.EV_SYN, ev.SYN_REPORT, 0, 0.0)]

    def fileno(self):
        return None

    def next_time_s(self):
        return None

    def read(self, now_s):
        events, self._events = self._events, []
        return events

    def close(self):
        pass


def open_panel(settings):
    return MadeUp(settings.device)
'''
PROGRAM = """
import select, sys
from pathlib import Path
from controller.board.board import load_board
from controller.cli import main
from controller.service.drivers import await_panel, open_panel
from controller.touch.live_source import LiveSource
from controller.touch.panel_process import PanelProcess

folder = Path(sys.argv[1])
board = load_board(folder)
(sample,) = LiveSource(open_panel(board), board).read(1.0)
panel = await_panel(board)
print(isinstance(panel, PanelProcess), round(sample.x_m * 1e3), round(sample.y_m * 1e3))
events = []
while not events:
    if panel.fileno() is not None:
        select.select([panel.fileno()], [], [])
    events = panel.read(1.0)
print(panel.description.name, len(events))
panel.close()
main(["doctor", "--board", str(folder)])
(folder / "board.toml").write_text((folder / "board.toml").read_text().replace("made_up", "made_down"))
main(["doctor", "--board", str(folder)])
"""


@pytest.mark.interpreted
def test_every_kind_of_panel_has_a_driver_that_takes_its_settings():
    assert set(PANELS) == set(get_args(Touch)) - {RecordingTouch}
    for settings, driver in PANELS.items():
        hints = get_type_hints(import_module(f"controller.touch.{driver.module}").open_panel)
        assert hints["settings"] is settings


def test_a_recording_has_no_driver_and_is_refused_in_words():
    assert driver_of(BOARD.touch) is None
    with pytest.raises(TouchError, match="give its \\[touch\\] the kind of a panel"):
        open_panel(BOARD.touch)
    with pytest.raises(TouchError, match="'simulated' has no touch panel"):
        drivers.open_panel(BOARD)


@pytest.mark.interpreted
@pytest.mark.parametrize("own_process", [False, True])
def test_a_new_kind_of_panel_takes_the_places_that_the_readme_says(tmp_path, own_process):
    tree = tmp_path / "controller"
    shutil.copytree(CONTROLLER, tree, ignore=shutil.ignore_patterns("__pycache__"))
    entry = f'    MadeUpTouch: PanelDriver("made_up", own_process={own_process}),\n'
    changes = {
        "controller/board/touch_panels.py": [
            (r"\nTouch = ([^\n]+)\n", lambda found: f"\n{RECORD}Touch = {found[1]} | MadeUpTouch\n"),
        ],
        "controller/touch/made_up.py": DRIVER,
        "controller/touch/panels.py": [
            (r"    LinuxInputTouch: ", lambda found: entry + found[0]),
            (r"from controller\.board\.touch_panels import ", lambda found: found[0] + "MadeUpTouch, "),
        ],
    }
    section = (CONTROLLER / "touch" / "README.md").read_text().split("### A new kind of panel")[1].split("\n#")[0]
    places = set(re.findall(r"^\d\. `(controller/[\w/.<>]+)`", section, re.MULTILINE))
    assert {place.replace("<kind>", "made_up") for place in places} == set(changes)
    for place, change in changes.items():
        file = tmp_path / place
        if isinstance(change, str):
            file.write_text(change)
            continue
        text = file.read_text()
        for pattern, new in change:
            text, count = re.subn(pattern, new, text)
            assert count == 1
        file.write_text(text)
    folder = tmp_path / "panel"
    shutil.copytree(BOARD.folder, folder)
    board_toml = folder / "board.toml"
    text, count = re.subn(r'(\[touch\][^\[]*?)kind = "recording"', r'\1kind = "made_up"\ndevice = "there"', board_toml.read_text())
    assert count == 1
    board_toml.write_text(text)
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1", "XDG_CACHE_HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-P", "-c", PROGRAM, str(folder)], capture_output=True, text=True, check=False, env=environment
    )
    lines = done.stdout.splitlines()
    assert lines[:2] == [f"{own_process} 105 74", "there 4"], done.stderr
    assert re.search(r"^ok +touch panel +made_up answers$", done.stdout, re.MULTILINE)
    assert "touch.kind = 'made_down'" in done.stderr
    assert "made_up" in done.stderr.partition("must be one of")[2]
