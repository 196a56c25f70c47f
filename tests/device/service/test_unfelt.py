"""What was not felt is said, with its cause; what nobody misses is not."""

import dataclasses
from pathlib import Path

import msgspec
from tables import each_row

from controller.cli import main
from controller.commands import status as status_command
from controller.commands.run.report import served
from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.service.unfelt import NOT_PLAYED, left_out, unfelt
from controller.metrics import NO_EMISSIONS, Skipped

RECORDING = Path(__file__).parents[1] / "touch" / "recordings" / "ep0430m09.2-fingers-touch-release.events"
REPLACED = {"merged", "lifted", "scene_changed"}  # by a newer emission, or the finger is gone
CASES = {
    "all is felt": ((100, 0, 90, {"outside_region": 20}), []),
    "not touched": ((0, 0, 0, {}), ["nothing was touched"]),
    "fixed emitters alone": ((0, 0, 7, {}), []),
    "no finger's": ((50, 50, 0, {}), ["none of 50 positions"]),
    "elsewhere": ((100, 10, 3, {"outside_region": 80}), ["80 of 90 positions lay outside"]),
    "off": (
        (100, 0, 3, {"outputs_off": 7, "bad_entries": 2}),
        ["7 emissions not played: the outputs", "2 emissions not played: their"],
    ),
}


@each_row("case", CASES)
def test_each_cause_has_a_line(case):
    arguments, begins = CASES[case]
    lines = unfelt(*arguments)
    assert len(lines) == len(begins)
    assert all(line.startswith(begin) for line, begin in zip(lines, begins, strict=True))


def test_every_cause_of_the_loop_is_said_or_missed_by_nobody():
    names = {one.name for one in dataclasses.fields(Skipped)}
    assert set(NOT_PLAYED) | REPLACED | set(NO_EMISSIONS) == names
    every = Skipped(*range(1, len(names) + 1))
    assert set(left_out(every)) == {*NOT_PLAYED, "outside_region"}
    assert left_out(Skipped()) == {}


def test_the_status_says_it_while_the_panel_serves(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(status_command, "_updates", lambda: None)
    status = PanelStatus(
        release="checkout", board="panel", pid=1, boot="", started_s=0.0, written_s=1.0, state=PanelState.ARMED, cause="",
        outputs_on=True, panel_present=True, temperature_c=None, heartbeats=0, due=0, foci=0, emissions=0, uploads=0, late=0,
        idled=0, host_silent=0, outages=0, skipped=0, waiting=0, log_lines_lost=0, statuses_lost=0, upload=LatencyStatus(),
        resident=LatencyStatus(), touch_points=40, left_out={"outside_region": 40},
    )  # fmt: skip
    file = tmp_path / "status.json"
    for state, said in ((PanelState.ARMED, True), (PanelState.NO_PERMIT, False)):  # there the state says what is missing
        file.write_bytes(msgspec.json.encode(msgspec.structs.replace(status, state=state)))
        main(["status", "--file", str(file)])
        assert ("40 of 40 positions lay outside all regions" in capsys.readouterr().out) is said


@each_row(("off_s", "said"), [(0.0, "outputs were never on"), (1.25, "outputs were off for 1.25 s")])
def test_outputs_that_were_never_on_are_no_outputs_that_were_off_for_no_time(off_s, said):
    figures = {
        "board": "panel",
        "foci": 0,
        "host_silent": 0,
        "outages": 0,
        "outputs_off_s": off_s,
        "warnings": [],
        "unfelt": [],
    } | {"expected": None}
    assert said in served(figures | {"state": "waiting for FPGA", "cause": "there is no /dev/spidev0.0"})


def test_a_run_whose_touches_are_beside_the_regions_says_so(capsys, bank_file):
    short = ["run", "--speed", "max", "--replay", str(RECORDING), "--bank", str(bank_file)]
    assert main([*short, "--scene", "spots"]) == 0
    assert "positions lay outside all regions of the scene" in capsys.readouterr().out
    assert main(short) == 0
    assert "outside" not in capsys.readouterr().out
