"""Banks of a fleet: of 50 measurements one is broken, a clear line; resumed after kill -9, the same bytes however many compute."""

import dataclasses
import errno
import json
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest
from patience import wait_for
from small_plate import small_board
from tables import each_row

from controller.cli import main
from controller.commands.calibrate import fleet as fleet_command
from controller.device.bank.reader import Bank
from controller.workshop.bank_builder import said_amplitude
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.calibration.banks import fleet
from controller.workshop.calibration.banks.fleet import KEPT, REPORT, calibrate_fleet
from controller.workshop.calibration.banks.plate_bank import PlateBank, fit
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.calibration.recording.simulated_measurement import Flaws, RecordingSettings, simulate_measurement
from controller.workshop.workers.dask_client import OWN_CLUSTER, OWN_HTTP
from controller.workshop.workers.workers import Workers

POINTS = 60


def measure(folder, seed):
    """A small plate of the fleet: free edges, each a little thicker than the one before."""
    board = small_board()
    plate = msgspec.structs.replace(board.plate, edges="free", thickness_mm=board.plate.thickness_mm * (1 + 0.004 * seed))
    recording = RecordingSettings(record_s=4e-3, repetitions=1, seed=seed)
    names, points_m = tuple(map(str, range(POINTS))), scattered_points(board, POINTS, 0.0, seed=seed)
    simulate_measurement(
        folder, board, msgspec.structs.replace(board, plate=plate), names, points_m, recording, Flaws(snr_db=50), lambda *_: None
    )


def wanted(folder, aim=None):
    return PlateBank(small_board(), folder, pitch_mm=4.0, aim=aim)


def test_a_good_panel_has_its_bank_and_what_is_wrong_with_others_is_a_line(tmp_path):
    fleet, banks = tmp_path / "fleet", tmp_path / "banks"
    measure(fleet / "good", 1)
    (fleet / "torn").mkdir()
    (fleet / "torn/measurement.toml").write_text("[records\n")
    (fleet / "torn/records.npy").symlink_to("gone")
    (fleet / "empty").mkdir()
    (fleet / "notes").mkdir()
    shutil.copytree(fleet / "good", fleet / "without-records")
    for file in (fleet / "without-records").rglob("*.npy"):
        file.unlink()
    found = calibrate_fleet(fleet, banks, wanted(fleet))
    assert list(found["panels"]) == ["good"]
    assert found["panels"]["good"]["points"] == POINTS
    assert found["panels"]["good"]["frequency_scale"][0] == pytest.approx(0.994, abs=5e-3)  # shear slows Mindlin's plate by 1 %
    assert list(found["broken"]) == ["torn", "without-records"]
    assert all(str(fleet / name) in line and "\n" not in line for name, line in found["broken"].items())
    with Bank.open(banks / "good.bank", small_board()) as bank:
        assert bank.header.provenance.kind == "measured"
    assert json.loads((banks / REPORT).read_text())["panels"] == found["panels"]
    again = calibrate_fleet(fleet, banks, wanted(fleet))
    assert again["workers"]["kept"] == 1
    assert again["panels"] == found["panels"]
    shutil.rmtree(fleet / "without-records")
    (fleet / "good/measurement.toml").write_text("")
    (banks / "good.bank").unlink()
    assert list(calibrate_fleet(fleet, banks, wanted(fleet))["broken"]) == ["good", "torn"]


def test_a_full_disk_ends_the_fleet_where_it_is_and_the_same_command_goes_on(tmp_path, monkeypatch, capsys):
    """What is computed for a disk that is full is lost: one line, no further panel."""
    fleet_folder, banks, begun = tmp_path / "fleet", tmp_path / "banks", []
    measure(fleet_folder / "a", 1)
    for name in "bc":
        shutil.copytree(fleet_folder / "a", fleet_folder / name)
    fitted = fit(wanted(fleet_folder / "a"))

    def full(fd, *_):
        if "b.bank" in str(Path(f"/proc/self/fd/{fd}").readlink()):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(fleet_command, "board_of", lambda _: small_board())
    monkeypatch.setattr(fleet, "fit", lambda one: begun.append(one.folder.name) or fitted)  # copies
    monkeypatch.setattr(said_amplitude, "PLACES", 3)  # of each bank, where most of the time goes
    monkeypatch.setattr(os, "posix_fallocate", full)
    assert main(["calibrate", "fleet", str(fleet_folder), "--out", str(banks), "--pitch-mm", "4", "--workers", "1"]) == 78
    (line,) = capsys.readouterr().err.splitlines()
    assert f"{banks / 'b.bank'}: cannot be written (No space left on device)" in line
    assert "the same command goes on" in line
    monkeypatch.setattr(os, "posix_fallocate", lambda *_: None)
    report = calibrate_fleet(fleet_folder, banks, wanted(fleet_folder))
    assert (report["workers"]["kept"], list(report["panels"]), report["broken"]) == (1, list("abc"), {})
    assert begun == ["a", "b", "b", "c"]


KILLED = """
import sys
from pathlib import Path
from workshop.calibration.test_fleet_of_banks import HURRIED, calibrate_fleet, wanted
from controller.workshop.workers.workers import Workers
if __name__ == "__main__":
    folder, aim = Path(sys.argv[1]), HURRIED if sys.argv[4:] else None
    print(calibrate_fleet(folder, Path(sys.argv[2]), wanted(folder, aim), Workers(int(sys.argv[3]))))
"""
HURRIED = dataclasses.replace(AIMS["contrast"], steps=4)


def started(script, *arguments):
    script.write_text(KILLED)
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    command = [sys.executable, str(script), *map(str, arguments)]
    return subprocess.Popen(command, env=environment, start_new_session=True, stdout=subprocess.PIPE, text=True)


@pytest.mark.slow
def test_a_fleet_of_fifty_of_which_one_is_broken_killed_and_resumed(tmp_path):
    """Ten plates, five times each. Everything is killed once some banks are there; two processes, and one alone, go on."""
    fleet, banks, script = tmp_path / "fleet", tmp_path / "banks", tmp_path / "killed.py"
    for number in range(50):
        if number < 10:
            measure(fleet / f"panel-{number:02}", number)
        else:
            shutil.copytree(fleet / f"panel-{number % 10:02}", fleet / f"panel-{number:02}")
    record = sorted((fleet / "panel-17").rglob("*.npy"))[-1]
    record.write_bytes(record.read_bytes()[:-100])

    killed = started(script, fleet, banks, 2)
    assert wait_for("some banks", lambda: (banks / KEPT).exists() and (banks / KEPT).stat().st_size > 5000, seconds=500)
    os.killpg(killed.pid, signal.SIGKILL)
    killed.communicate()
    some = sorted(path.stem for path in banks.glob("panel-*.bank"))
    assert 0 < len(some) < 49
    with started(script, fleet, banks, 2) as going_on:
        said = going_on.communicate()[0]
    assert int(re.search(r"'kept': (\d+)", said)[1]) >= len(some) - 2  # two may have been under way
    report = json.loads((banks / REPORT).read_text())
    assert len(report["panels"]) == 49, report["broken"]
    (line,) = report["broken"].values()
    assert str(record) in line
    alone = tmp_path / "alone"
    for number in range(3, 50):
        shutil.rmtree(fleet / f"panel-{number:02}")
    calibrate_fleet(fleet, alone, wanted(fleet))
    for number in range(50):
        if number != 17 and number % 10 < 3:
            one, other = alone / f"panel-{number % 10:02}.bank", banks / f"panel-{number:02}.bank"
            assert one.read_bytes() == other.read_bytes()


@pytest.mark.slow
def test_an_optimised_fleet_killed_amid_its_panels_goes_on_at_their_cells(tmp_path):
    """The bytes are those of one process that nobody disturbs; what each bank says of its contrast is in the report."""
    fleet, banks, script = tmp_path / "fleet", tmp_path / "banks", tmp_path / "killed.py"
    for number in range(3):
        measure(fleet / f"panel-{number}", number)
    killed = started(script, fleet, banks, 2, "optimised")
    assert wait_for("some cells", lambda: sum(file.stat().st_size > 20_000 for file in banks.glob(".*.words")) == 2, seconds=500)
    os.killpg(killed.pid, signal.SIGKILL)
    killed.communicate()
    assert not list(banks.glob("*.bank"))
    with started(script, fleet, banks, 2, "optimised") as going_on:
        going_on.communicate()
    report = json.loads((banks / REPORT).read_text())
    assert not report["broken"]
    with started(script, fleet, tmp_path / "alone", 1, "optimised") as alone:
        alone.communicate()
    for name, panel in report["panels"].items():
        assert (banks / f"{name}.bank").read_bytes() == (tmp_path / "alone" / f"{name}.bank").read_bytes()
        assert panel["optimised"]["aim"] == "contrast"
        assert panel["optimised"]["contrast_of_plain"]["with_error"] > 1.2
    assert sorted(file.name for file in banks.iterdir()) == [KEPT, *(f"panel-{number}.bank" for number in range(3)), REPORT]


@pytest.mark.slow
def test_what_two_processes_and_a_cluster_of_two_workers_do_of_a_fleet(tmp_path):
    """Processor time, as cores may have other work: that of one process over that of the busier of two is the gain of two cores."""
    import dask
    from distributed import LocalCluster

    folders = {"one process": tmp_path / "alone", "two processes": tmp_path / "two", "--dask, two workers": tmp_path / "dask"}
    for number in range(8):
        measure(folders["one process"] / f"panel-{number}", number)
    seconds, cluster_options = {}, {"dashboard_address": OWN_HTTP, "worker_dashboard_address": OWN_HTTP, "silence_logs": "CRITICAL"}
    with (
        dask.config.set(OWN_CLUSTER),
        LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", **cluster_options) as cluster,
    ):
        who = [Workers(), Workers(2), Workers(address=cluster.scheduler_address)]
        for (name, folder), workers in zip(folders.items(), who, strict=True):
            if name != "one process":  # what was learned of points is kept by their folder
                shutil.copytree(folders["one process"], folder)
            report = calibrate_fleet(folder, tmp_path / f"banks of {folder.name}", wanted(folder), workers)
            shares = [share for worker, share in report["workers"].items() if worker != "kept"]
            assert sum(share["items"] for share in shares) == 8
            seconds[name] = max(share["processor_s"] for share in shares)
            of_each = ", ".join(f"{share['items']} panels in {share['processor_s']:.1f} s" for share in shares)
            peak_mb = max(share["peak_mb"] for share in shares)
            print(f"{name}: {of_each}, {peak_mb:.0f} MB at most; {seconds['one process'] / seconds[name]:.2f}")
    for name in ("two", "dask"):
        for number in range(8):
            alone, other = (tmp_path / f"banks of {some}" / f"panel-{number}.bank" for some in ("alone", name))
            assert alone.read_bytes() == other.read_bytes()


@each_row(
    ("options", "code", "said"),
    [
        (["{}/absent", "--out", "{}/banks"], 2, "absent: No such file or directory: give a folder of measurement folders"),
        (["{}", "--out", "{}/banks"], 2, "no folder in it has a measurement.toml"),
        (["{}", "--out", "{}/banks", "--pitch-mm", "9"], 78, "pitch_mm = 9 is above"),
        (["{}", "--out", "{}/banks", "--workers", "0"], 2, "--workers 0: not from 1 to 256"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(tmp_path, capsys, options, code, said):
    assert main(["calibrate", "fleet", *(option.format(tmp_path) for option in options)]) == code
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
