"""What does not work as it should of a connected touch panel: reported in the log once, in the status and by doctor with counts."""

from collections import Counter
from types import SimpleNamespace

import msgspec
import pytest

from controller.device.board.panel_state import Condition, PanelState
from controller.device.board.panel_status import read_status
from controller.device.doctor import touch_check
from controller.device.service import touch_faults
from controller.device.service.status_file import StatusFile
from controller.device.service.touch_faults import TouchFaults
from controller.device.touch.event_reader import DeviceDescription
from controller.device.touch.panels.ft5x06 import Ft5x06Touch
from controller.device.touch.reports import FAULTS, WARNINGS
from controller.errors import ControllerError
from controller.log import Event
from controller.metrics import Counters

AXES_MM = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}

UNSHARED = "no other program on this machine gets its touches; [touch] share = true hands them on"


@pytest.fixture
def logged(monkeypatch):
    lines = []
    monkeypatch.setattr(touch_faults, "log", lambda message, about: lines.append((message, about)))
    return lines


def test_each_fault_is_logged_once_however_often_it_comes(logged):
    panel = SimpleNamespace(warnings=Counter(), description=DeviceDescription("chip"))
    faults = TouchFaults(panel)
    faults.look(0.0)
    panel.warnings = Counter(interrupt_silent=1, bus_retried=7)  # another object, as from the panel's process
    faults.look(0.5)
    assert logged == []  # not looked at yet
    for second in range(1, 5):
        panel.warnings["interrupt_silent"] += 1
        faults.look(float(second))
    assert logged == [(f"2 × {WARNINGS['interrupt_silent']}", Event.TOUCH_FAULT)]
    panel.description = DeviceDescription("chip", remark="it refuses register 0xA4")
    faults.look(6.0)
    panel.description = DeviceDescription("chip", remark="it refuses register 0xA4")  # after a reconnection
    faults.look(7.0)
    assert [message for message, _ in logged[1:]] == ["it refuses register 0xA4"]
    assert set(WARNINGS) > FAULTS


def status_of(folder, warnings, remark=""):
    file = StatusFile(folder, "glass")
    file.watch(Counters(), int, touch=lambda: (warnings, remark))
    file.changed(Condition(PanelState.ARMED, "", True, True))
    file.use(file.due_s, file.due_s + 1)
    return read_status(folder / "status.json")


def test_the_status_counts_all_anomalies_and_has_the_remark(tmp_path):
    status = status_of(tmp_path, Counter(interrupt_silent=2, bus_retried=7, dropped=0), "it refuses register 0xA4")
    assert status.touch_warnings == {"interrupt_silent": 2, "bus_retried": 7}
    assert status.touch_remark == "it refuses register 0xA4"


def test_the_command_says_them_also_of_a_newer_release(tmp_path, capsys):
    from controller.cli import main

    status = status_of(tmp_path, {"interrupt_silent": 2, "unheard_of": 3}, "it refuses register 0xA4")
    assert status.serves
    assert main(["status", "--file", str(tmp_path / "status.json")]) == 0
    out = capsys.readouterr().out
    assert f"touch panel: 2 × {WARNINGS['interrupt_silent']}" in out
    assert "touch panel: 3 × unheard_of" in out
    assert "it refuses register 0xA4" in out


def test_doctor_says_what_the_running_service_has_found_instead_of_taking_its_panel(board, tmp_path, monkeypatch):
    monkeypatch.setattr(touch_check, "FOLDER", tmp_path)
    touch = Ft5x06Touch(bus="/dev/i2c-no", width=100, height=100, **AXES_MM)
    with_chip = msgspec.structs.replace(board, name="glass", touch=touch)
    status_of(tmp_path, {"interrupt_silent": 2, "bus_retried": 7})
    finding = touch_check.look_at_touch_panel(with_chip, lambda: 0.0)
    assert (finding.good, finding.warns) == (True, True)
    assert finding.said == f"read by the running service; 2 × {WARNINGS['interrupt_silent']}; {UNSHARED}"
    status_of(tmp_path, {})
    finding = touch_check.look_at_touch_panel(with_chip, lambda: 0.0)
    assert (finding.good, finding.warns, finding.said) == (True, False, f"read by the running service; {UNSHARED}")
    with pytest.raises(ControllerError, match="no I2C bus"):
        touch_check.look_at_touch_panel(msgspec.structs.replace(with_chip, name="another"), lambda: 0.0)
