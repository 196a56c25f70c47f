"""The trial: statuses are read, the fall-back script is asked, and a release that cannot update again does not stay."""

import os
import time

import msgspec
import pytest
from msgspec.structs import replace
from repository_fixture import Publisher
from tables import each_row

from controller.cli import main
from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.update import trial
from controller.device.update.judge import Verdict
from controller.device.update.layout import Layout
from controller.device.update.requests import ask
from controller.device.update.trial import judge_trial, keep_before, why_no_updater
from controller.errors import UpdateError

VERSION = "1.1.0"
COUNTS = ("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped", "waiting")


@pytest.fixture
def layout(tmp_path):
    """A device that tries a release, with a trusted root."""
    layout = Layout(tmp_path / "device", tmp_path / "root.json")
    for folder in (layout.state, layout.requests, layout.download):
        folder.mkdir(parents=True)
    (layout.state / "trial").write_text(f"{VERSION}\n")
    layout.trusted_root.write_bytes(Publisher(tmp_path / "owner").root)
    return layout


class Device:
    """A service that writes statuses, one at each look of the judge; time is theirs."""

    def __init__(self, layout, *states):
        self.layout, self.states = layout, list(states)
        self.file = layout.root / "status.json"
        self.now_s, self.reported, self.requested = 500.0, [], []
        lost = {"log_lines_lost": 0, "statuses_lost": 0, "upload": LatencyStatus(), "resident": LatencyStatus()}
        self.status = PanelStatus(
            **dict.fromkeys(COUNTS, 0) | lost,
            release=VERSION,
            board="glass",
            pid=os.getpid(),
            boot="",
            started_s=0.0,
            written_s=0.0,
            state=PanelState.ARMED,
            cause="",
            outputs_on=False,
            panel_present=True,
            temperature_c=None,
        )
        self.write(0.0)

    def write(self, seconds):
        self.now_s += seconds
        self.requested.append(sorted(path.name for path in self.layout.requests.iterdir()))
        state = self.states.pop(0) if self.states else None
        if state is not None:
            self.file.write_bytes(msgspec.json.encode(replace(self.status, state=PanelState(state), written_s=self.now_s)))

    def evaluated(self, healthy_s=5.0):
        return judge_trial(self.layout, healthy_s, self.reported.append, self.file, lambda: self.now_s, self.write)


def test_a_release_that_serves_stays(layout):
    device = Device(layout, *["armed"] * 6)
    assert device.evaluated() is Verdict.GOOD
    assert {path.name: path.read_text() for path in layout.requests.iterdir()} == {"good": f"{VERSION}\n"}
    assert device.now_s == 505.0
    assert device.reported[-1] == "release 1.1.0 is on trial: it serves"


def test_a_release_that_does_not_goes(layout, capsys):
    device = Device(layout, *["armed"] * 3, *["faulted"] * 40)
    assert device.evaluated() is Verdict.BAD
    assert {path.name: path.read_text() for path in layout.requests.iterdir()} == {"bad": f"{VERSION}\n"}
    assert device.now_s == 530.0
    assert "release 1.1.0 is bad: faulted" in capsys.readouterr().err


def test_a_release_whose_service_writes_nothing_goes(layout):
    assert Device(layout).evaluated() is Verdict.BAD


def test_a_release_without_a_permit_stands_each_time_that_is_so_for_long(layout):
    device = Device(layout, *["no permit"] * 100, "faulted", *["no permit"] * 100, *["armed"] * 6)

    def stood():
        (layout.requests / "stands").unlink(missing_ok=True)

    write, stands = device.write, 0

    def taken(seconds):
        nonlocal stands
        stands += (layout.requests / "stands").exists()
        stood()
        write(seconds)

    device.write = taken
    assert device.evaluated() is Verdict.GOOD
    assert stands == 2


def test_a_trial_that_is_over_is_not_evaluated(layout):
    device = Device(layout, *["armed"] * 100)
    write = device.write

    def ended(seconds):
        (layout.state / "trial").unlink()
        write(seconds)

    device.write = ended
    assert device.evaluated() is Verdict.NOT_YET
    assert not list(layout.requests.iterdir())


@each_row("broken", ["import", "root absent", "root damaged", "no root"], afresh=[layout])
def test_a_release_that_could_not_update_again_goes_at_once(layout, monkeypatch, broken):
    assert why_no_updater(layout) == ""
    if broken == "import":
        monkeypatch.setattr(trial, "NEEDED", (*trial.NEEDED, "spellbook"))
    elif broken == "root absent":
        layout.trusted_root.unlink()
    else:
        owner = layout.trusted_root
        owner.write_bytes(b"{}" if broken == "no root" else owner.read_bytes().replace(b'"version":1', b'"version":2'))
    device = Device(layout, *["armed"] * 100)
    assert device.evaluated() is Verdict.BAD
    assert (layout.requests / "bad").read_text() == f"{VERSION}\n"
    assert device.now_s == 500.0
    assert "\n" not in why_no_updater(layout)


def test_what_the_old_release_suffered_from_is_kept_with_the_request(layout):
    device = Device(layout)
    status = replace(device.status, release="1.0.0", written_s=time.monotonic(), state=PanelState.WAITING_FOR_FPGA)
    device.file.write_bytes(msgspec.json.encode(status))
    keep_before(layout, device.file)
    device = Device(layout, *["waiting for FPGA"] * 100, *["armed"] * 6)
    assert device.evaluated() is Verdict.GOOD
    assert "stands" in device.requested[-1]


def test_of_an_old_release_that_does_not_run_nothing_is_kept(layout):
    device = Device(layout)
    (layout.download / "before.json").write_text("of an earlier update")
    device.file.write_bytes(msgspec.json.encode(replace(device.status, written_s=time.monotonic() - 60)))
    keep_before(layout, device.file)
    assert not (layout.download / "before.json").exists()


def test_a_request_names_a_release_and_a_full_disk_is_reported(layout):
    with pytest.raises(UpdateError, match="no name of a release"):
        ask(layout, "good", "../1")
    layout.requests.rmdir()
    layout.requests.write_text("in the way")
    with pytest.raises(UpdateError, match=r"requests/good: cannot be written \(Not a directory\)"):
        ask(layout, "good", VERSION)


def test_outside_of_the_release_on_trial_the_command_judges_nothing(layout, monkeypatch, capsys):
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(layout.root))
    assert main(["update", "judge"]) == 0
    assert "nothing to judge: on trial is 1.1.0, and this is none" in capsys.readouterr().err
    assert not list(layout.requests.iterdir())
