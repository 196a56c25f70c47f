"""How a rollout fares by the reports of its devices: counts, files that are broken, and what is proposed."""

import json
import os

import msgspec
import pytest
from tables import each_row
from test_rollout import DAY, steps
from tiny_release import NOW, TinyRepository, release_folder

from controller.cli import main
from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.update.installed import UpdateState
from controller.workshop.publish.fleet import DeviceReport, Fleet, Tally, proposal, tallied

COUNTS = ("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped", "waiting")


def report(version="1.0.0", failed=(), **fields):
    """What a healthy device of a release reports, but for these fields."""
    known = {
        "release": version, "board": "panel", "pid": 1, "boot": "", "started_s": 0.0, "written_s": 9.0, "cause": "",
        "state": PanelState.ARMED, "outputs_on": True, "panel_present": True, "temperature_c": None, "log_lines_lost": 0,
        "statuses_lost": 0, "upload": LatencyStatus(), "resident": LatencyStatus(),
    }  # fmt: skip
    updates = UpdateState(in_use=version, failed=tuple(failed))
    return DeviceReport(**(known | dict.fromkeys(COUNTS, 0) | {"updates": updates} | fields))


def test_a_device_counts_by_its_release_and_health():
    slow = LatencyStatus(2000, 3000.0, 6600.0, 9000.0)
    fleet = tallied(
        [
            (report(), False),
            (report(state=PanelState.NO_PERMIT), False),
            (report(state=PanelState.FAULTED), False),
            (report(upload=slow), False),
            (report(upload=msgspec.structs.replace(slow, p99_us=5900.0)), False),
            (report(old="the service has ended"), False),
            (report(old="the service has ended"), True),
            (report("0.9", failed=["1.0.0"]), False),
        ]
    )
    assert fleet == Fleet(8, {"1.0.0": Tally(healthy=3, faulted=3, silent=1, rolled_back=1), "0.9": Tally(healthy=1)})


@each_row(
    ("tally", "others", "days", "said"),
    [
        (Tally(healthy=5), Tally(healthy=495), 0, ("go on", "next: 10 %")),
        (Tally(healthy=49, rolled_back=1), Tally(healthy=450), 1, ("go on", "next: 100 %")),
        (Tally(healthy=48, rolled_back=1), Tally(healthy=450), 1, ("stop", "1 of 49 devices")),
        (Tally(healthy=47, faulted=2), Tally(healthy=445, faulted=5), 1, ("stop", "more than 2.2%")),
        (Tally(healthy=48, faulted=2), Tally(healthy=440, faulted=10), 1, ("go on", "next: 100 %")),
        (Tally(healthy=39, silent=11), Tally(healthy=450), 1, ("wait", "39 of about 50")),
        (Tally(healthy=40, silent=10), Tally(healthy=450), 1, ("go on", "next")),
        (Tally(healthy=500), Tally(), 2, ("go on", "it is for 100 %")),
    ],
)
def test_what_is_proposed(tally, others, days, said):
    """By shares of 1, 10, 100 % of 500 devices."""
    fleet = Fleet(500, {"1.0.0": tally, "0.9": others})
    do, why = proposal("1.0.0", steps((1, 0), (10, 1), (100, 2)), fleet, NOW + days * DAY)
    assert do == said[0]
    assert said[1] in why


@pytest.fixture
def rolled(tmp_path, monkeypatch):
    """A repository with a release for 10 % of the devices, and a folder for reports."""
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    release_folder(tmp_path / "1", "1.0.0", 1)
    repository.publish(tmp_path / "1", rollout=steps((10, 0), (100, 2)))
    monkeypatch.setattr("controller.workshop.publish.publisher.now", lambda: NOW + DAY)
    (tmp_path / "reports").mkdir()
    return tmp_path


def write(folder, name, what, heard=NOW + DAY):
    file = folder / "reports" / name
    file.write_bytes(what if isinstance(what, bytes) else msgspec.json.encode(what))
    os.utime(file, (heard.timestamp(), heard.timestamp()))
    return file


def status(folder, *more):
    return main(["update", "repository", "status", str(folder / "repository"), "--from", str(folder / "reports"), *more])


def test_the_command_counts_what_devices_report_and_names_what_is_broken(rolled, capsys):
    assert status(rolled) == 1
    assert "has no report of a device (0 broken files)" in capsys.readouterr().err
    for number in range(10):
        write(rolled, f"{number}.json", report("0.9" if number else "1.0.0"))
    write(rolled, "silent.json", report("0.9"), heard=NOW - DAY / 100)
    write(rolled, "empty.json", b"")
    write(rolled, "other.json", b'{"release": "1.0.0"}')
    write(rolled, "notes.txt", b"no report")
    write(rolled, "state.json", msgspec.json.encode(report("0.9")).replace(b'"armed"', b'"\\u001b[2J"'))
    write(rolled, "escape.json", msgspec.json.encode(report("0.9")).replace(b'"0.9"', b'"\\u001b[2J"'))
    (rolled / "reports/link.json").symlink_to(rolled / "reports/0.json")
    assert status(rolled) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "11 devices, 5 broken files"
    assert [line.split() for line in lines[2:4]] == [["0.9", "9", "0", "1", "0"], ["1.0.0", "1", "0", "0", "0"]]
    assert "go on: next: 100 % from 2026-11-24T12:00:00Z" in lines[4]
    assert [line.partition(":")[0].rpartition("/")[2] for line in lines[5:]] == [
        "empty.json",
        "escape.json",
        "link.json",
        "other.json",
        "state.json",
    ]
    assert "\x1b" not in "".join(lines)
    write(rolled, "0.json", report("0.9", failed=["1.0.0"]))
    assert status(rolled, "--json") == 1
    figures = json.loads(capsys.readouterr().out)
    assert figures["releases"]["1.0.0"] == {"healthy": 0, "faulted": 0, "silent": 0, "rolled_back": 1}
    assert (figures["offers"][0]["propose"], figures["offers"][0]["share"], len(figures["broken"])) == ("stop", 0.1, 5)
    assert status(rolled, "--silent-s", "0") == 2
    assert status(rolled, "--channel", "beta") == 1
    assert "channel beta offers no release" in capsys.readouterr().err


def test_what_status_prints_is_a_report(rolled, capsys):
    """The command of the device itself, on a device without releases."""
    seen = msgspec.convert(msgspec.to_builtins(report("checkout")), PanelStatus)
    file = write(rolled, "status.json", seen)
    main(["status", "--json", "--file", str(file)])
    write(rolled, "status.json", capsys.readouterr().out.encode())
    assert status(rolled, "--json") == 0
    assert list(json.loads(capsys.readouterr().out)["releases"]) == ["checkout"]
