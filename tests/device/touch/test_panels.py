"""Kinds of touch panels: each is one module that is found by its name, as the README of the room says."""

import inspect
import itertools
import os
import re
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder
from controller.device.board.touch_panels import touch_record, touch_records
from controller.device.service import drivers
from controller.device.touch.panels import open_panel
from controller.errors import TouchError

CONTROLLER = Path(drivers.__file__).parents[2]
BOARD = load_board(data_folder("boards") / "simulated")

DRIVER = '''"""A made-up panel: one finger at once, then nothing."""

from collections import Counter
from typing import ClassVar

from controller.device.board.touch_panels import Name, TouchPanel
from controller.device.touch import event_codes as ev
from controller.device.touch.event_reader import AxisInfo, DeviceDescription


class MadeUpTouch(TouchPanel, frozen=True, kw_only=True, tag_field="kind", tag="KIND"):
    """A panel that does not exist.

    Attributes:
    device: Anything.
    """

    own_process: ClassVar[bool] = OWN_PROCESS

    device: Name


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
from controller.device.board.board import load_board
from controller.cli import main
from controller.device.service.drivers import await_panel, open_panel
from controller.device.touch.live_source import LiveSource
from controller.device.touch.drivers.panel_process import PanelProcess

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
main(["board", "reference"])
(folder / "board.toml").write_text((folder / "board.toml").read_text().replace(board.touch.__struct_config__.tag, "made_down"))
main(["doctor", "--board", str(folder)])
"""


@pytest.mark.interpreted
def test_every_kind_of_panel_has_a_driver_that_takes_its_settings():
    kinds = {record.__struct_config__.tag: record for record in touch_records()}
    assert {"recording", "linux_input", "serial_panel"} < set(kinds)
    for kind, record in kinds.items():
        module = import_module(f"controller.device.touch.panels.{kind}")
        assert record is touch_record(kind)
        assert record.__module__ == module.__name__
        (settings,) = inspect.signature(module.open_panel).parameters.values()
        assert settings.annotation == record.__name__


@each_row("kind", [None, 3, "", "nothing", "i2c_reader", "..event_codes", "panel process"])
def test_what_is_no_kind_of_panel_has_no_record(kind):
    assert touch_record(kind) is None


def test_a_board_of_any_kind_is_read_without_a_package_of_a_driver():
    program = """
import sys
from controller.device.board.touch_panels import touch_record
for kind in sys.argv[1:]:
    assert touch_record(kind)
print(*{"evdev", "gpiod", "smbus2", "serial"} & set(sys.modules))
"""
    kinds = [record.__struct_config__.tag for record in touch_records()]
    done = subprocess.run([sys.executable, "-c", program, *kinds], capture_output=True, text=True, check=True)
    assert done.stdout == "\n"


def test_a_recording_has_no_device_and_is_refused_in_words():
    assert not BOARD.touch.has_device
    with pytest.raises(TouchError, match="give its \\[touch\\] the kind of a panel"):
        open_panel(BOARD.touch)
    with pytest.raises(TouchError, match="'simulated' has no touch panel"):
        drivers.open_panel(BOARD)


@pytest.mark.interpreted
@pytest.mark.parametrize("own_process", [False, True])
def test_a_new_kind_of_panel_takes_the_one_file_that_the_readme_names(tmp_path, own_process):
    kind = next(name for number in itertools.count(1) if touch_record(name := f"made_up_{number}") is None)
    shutil.copytree(CONTROLLER, tmp_path / "controller", ignore=shutil.ignore_patterns("__pycache__"))
    section = (CONTROLLER / "device/touch/README.md").read_text().split("### A new kind of panel")[1].split("\n#")[0]
    (place,) = re.findall(r"`(controller/[\w/.]*<kind>[\w.]+)`", section)
    (tmp_path / place.replace("<kind>", kind)).write_text(DRIVER.replace("KIND", kind).replace("OWN_PROCESS", str(own_process)))
    folder = tmp_path / "panel"
    shutil.copytree(BOARD.folder, folder)
    board_toml = folder / "board.toml"
    text, count = re.subn(r'(\[touch\][^\[]*?)kind = "recording"', rf'\1kind = "{kind}"\ndevice = "there"', board_toml.read_text())
    assert count == 1
    board_toml.write_text(text)
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1", "XDG_CACHE_HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-P", "-c", PROGRAM, str(folder)], capture_output=True, text=True, check=False, env=environment
    )
    lines = done.stdout.splitlines()
    assert lines[:2] == [f"{own_process} 105 74", "there 4"], done.stderr
    assert re.search(rf"^ok +touch panel +{kind} answers$", done.stdout, re.MULTILINE)
    assert f'## [touch] with kind = "{kind}"' in done.stdout
    assert "touch.kind = 'made_down'" in done.stderr
    assert kind in done.stderr.partition("must be one of")[2]


def test_kinds_are_listed_and_a_wrong_one_is_refused_without_any_package_of_a_driver():
    """As on a computer that checks boards and opens no panel."""
    code = (
        "import sys\n"
        "for name in ('evdev', 'gpiod', 'smbus2', 'serial', 'spidev'): sys.modules[name] = None\n"
        "from controller.device.board.touch_panels import touch_record, touch_records\n"
        "print([record.__struct_config__.tag for record in touch_records()], touch_record('evdev_library'), touch_record('absent'))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    kinds = [record.__struct_config__.tag for record in touch_records()]
    assert "gt911" in kinds
    assert done.stdout == f"{kinds} None None\n"
