"""How a rollout goes by the reports of its devices: counts, files that are broken, and what is proposed."""

import json
import os
import re

import msgspec
import pytest
from prometheus_client import generate_latest
from tables import each_row
from test_rollout import DAY, steps
from tiny_release import NOW, TinyRepository, release_folder

from controller.cli import main
from controller.device.board.panel_state import PanelState
from controller.device.board.panel_status import LatencyStatus, PanelStatus
from controller.device.service.prometheus import HISTOGRAMS, PanelCollector, registry, update_metrics
from controller.device.update.installed import UpdateState
from controller.errors import LinkError
from controller.metrics import BOUNDS_US
from controller.workshop.publish.fleet import Fleet, Tally, proposal, tallied
from controller.workshop.publish.reports import DeviceStatus

COUNTS = ("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped", "waiting")


def report(version="1.0.0", failed=(), **fields):
    """What a healthy device of a release reports, but for these fields."""
    known = {
        "release": version, "board": "panel", "pid": 1, "boot": "", "started_s": 0.0, "written_s": 9.0, "cause": "",
        "state": PanelState.ARMED, "outputs_on": True, "panel_present": True, "temperature_c": None, "log_lines_lost": 0,
        "statuses_lost": 0, "upload": LatencyStatus(), "resident": LatencyStatus(),
    }  # fmt: skip
    updates = UpdateState(in_use=version, failed=tuple(failed))
    return DeviceStatus(**(known | dict.fromkeys(COUNTS, 0) | {"updates": updates} | fields))


def test_a_device_counts_by_its_release_and_health():
    slow = LatencyStatus(2000, 3000.0, 6600.0, 9000.0)
    fleet = tallied(
        (status.report(NOW), silent)
        for status, silent in [
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
        (Tally(healthy=5), Tally(healthy=495), 0, ("wait", "for the time of the next step: 10 %")),
        (Tally(healthy=5), Tally(healthy=495), 1, ("open", "next: 10 %")),
        (Tally(healthy=4, faulted=1), Tally(healthy=495), 1, ("hold", "1 of 5 devices are faulted or rolled back, 0.0% with")),
        (Tally(healthy=3, faulted=2), Tally(healthy=495), 1, ("stop", "2 of 5 devices")),
        (Tally(healthy=49, rolled_back=1), Tally(healthy=450), 2, ("hold", "look at them before a further step is opened")),
        (Tally(healthy=48, rolled_back=1), Tally(healthy=445, faulted=5), 2, ("open", "next: 100 %")),
        (Tally(healthy=47, faulted=2), Tally(healthy=445, faulted=5), 2, ("stop", "more than 2.2%")),
        (Tally(healthy=48, faulted=2), Tally(healthy=440, faulted=10), 2, ("open", "next: 100 %")),
        (Tally(healthy=26), Tally(healthy=450), 2, ("wait", "26 of about 50")),
        (Tally(healthy=27), Tally(healthy=450), 2, ("open", "next")),
        (Tally(healthy=4, silent=1), Tally(healthy=495), 1, ("hold", "1 of 5 devices fell silent with it, 0.0% with")),
        (Tally(healthy=45, silent=5), Tally(healthy=440, silent=10), 2, ("hold", "5 of 50 devices fell silent")),
        (Tally(healthy=45, silent=5), Tally(healthy=405, silent=45), 2, ("open", "next")),
        (Tally(), Tally(healthy=500), 1, ("wait", "0 of about 5")),
        (Tally(healthy=399, silent=101), Tally(), 3, ("wait", "399 of about 500")),
        (Tally(healthy=497, faulted=3), Tally(), 3, ("hold", "3 of 500")),
        (Tally(healthy=500), Tally(), 3, ("go on", "it is for 100 %")),
    ],
)
def test_what_is_proposed(tally, others, days, said):
    """By shares of 1, 10, 100 % of 500 devices, from day 0, 1 and 2 on, of which the first two, or all, are open by then."""
    fleet = Fleet(500, {"1.0.0": tally, "0.9": others})
    opened_ppm = (0, 0, 100_000, 1_000_000)[days]
    do, why = proposal("1.0.0", steps((1, 0), (10, 1), (100, 2)), opened_ppm, fleet, NOW + days * DAY)
    assert do == said[0]
    assert said[1] in why


@pytest.fixture
def rolled(tmp_path, monkeypatch):
    """A repository with a release for 10 % of the devices, and a folder for reports."""
    repository = TinyRepository(tmp_path / "repository", tmp_path / "keys")
    release_folder(tmp_path / "1", "1.0.0", 1)
    repository.publish(tmp_path / "1", rollout=steps((10, 0), (100, 2)))
    monkeypatch.setattr("controller.workshop.publish.metadata.now", lambda: NOW + DAY)
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
    assert "wait: for the time of the next step: 100 % from 2026-11-24T12:00:00Z" in lines[4]
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
    assert (figures["offers"][0]["propose"], figures["offers"][0]["share"], len(figures["broken"])) == ("hold", 0.1, 5)
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


def samples(version="1.0.0", failed=(), state="armed", slow=0, instance="", heard=None):
    """What `haptic-panel metrics` exports of a device; with an instance as Prometheus gives it on, with its own time."""
    counts = [0] * 6 + [50_000 - slow] * 2 + [50_000] * 4
    none = {"count": 0, "counts": [0] * 12, "sum_us": 0.0}
    latencies = dict.fromkeys(HISTOGRAMS, none) | {"uploads_host": {"count": 50_000, "counts": counts, "sum_us": 1e8}}
    figures = {"state": state, "outputs_on": True, "latency_histograms": latencies | {"bounds_us": BOUNDS_US}}

    def ask():
        if state is None:
            raise LinkError("no panel")
        return version, "panel", figures

    update = UpdateState(in_use=version, failed=tuple(failed))
    text = generate_latest(registry(PanelCollector(ask, lambda: update_metrics(update)))).decode()
    if not instance:
        return text.encode()
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    lines = [re.sub(r"^(\w+)(?:{(.*)})? ", rf'\1{{instance="{instance}",\2}} ', line) for line in lines]
    return "".join(f"{line.replace(',}', '}')} {heard.timestamp() * 1000:.0f}\n" for line in lines).encode()


def test_figures_for_prometheus_count_as_the_status_does(rolled, capsys):
    """A file of `haptic-panel metrics` for each device, one of Prometheus for many; the latest report of a device counts."""
    hour = DAY / 24
    write(rolled, "well.prom", samples())
    write(rolled, "waits.prom", samples(state="no permit"))
    write(rolled, "faulted.prom", samples(state="faulted"))
    write(rolled, "down.prom", samples(state=None))
    write(rolled, "slow.prom", samples(slow=900))  # 1.8 % above 10 ms: at 99 % more than the 6 that may be
    write(rolled, "slowest.prom", samples(slow=400))  # 0.8 %
    write(rolled, "back.prom", samples("0.9", failed=["1.0.0"]))
    write(rolled, "back.json", report("1.0.0"), heard=NOW)  # of the same device, from before
    many = [samples("0.9", instance=f"panel-{number}:9750", heard=NOW + DAY - number * 10 * hour) for number in range(4)]
    write(rolled, "many.prom", b"".join([*many, samples("../..", instance="odd", heard=NOW)]))
    write(rolled, "text.prom", b"haptic_panel_up{ 1\n")
    write(rolled, "other.prom", b"node_up 1\n")
    write(rolled, "half.prom", samples()[:-2000])
    assert status(rolled, "--json") == 1
    figures = json.loads(capsys.readouterr().out)
    assert figures["devices"] == 11
    assert figures["releases"]["1.0.0"] == {"healthy": 3, "faulted": 3, "silent": 0, "rolled_back": 1}
    assert figures["releases"]["0.9"] == {"healthy": 4, "faulted": 0, "silent": 1, "rolled_back": 0}
    assert [line.partition(".prom: ")[2].split(" ")[0] for line in figures["broken"]] == ["is", "'odd'", "is", "is"]
    assert figures["offers"][0]["propose"] == "stop"
