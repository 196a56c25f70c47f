import contextlib
import dataclasses
import hashlib
import importlib.metadata
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from tables import each_row

from controller.cli import main
from controller.device.bank.file_format import creator
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.lookup import FoundBank
from controller.device.bank.reader import Bank
from controller.errors import BankError, UsageError
from controller.workshop.bank_builder import dask_client, optimised, own_bank
from controller.workshop.bank_builder.bank_fit import optimised_for
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.methods.descent import AIMS
from controller.workshop.bank_builder.optimised import METHOD_VERSION, Workers, compute
from controller.workshop.bank_builder.request import BankRequest

PITCH_M = 10e-3
AIM = dataclasses.replace(AIMS["contrast"], steps=3)
BOARD = small_board()
CELLS = 6 * 4
SOME = np.isin(np.arange(CELLS), [7, 8, 14, 15, 16])


def build(path, cells=SOME, **options):
    return build_bank(BankRequest(BOARD, path, PITCH_M, cells, **options))


@pytest.fixture(scope="module")
def banks(tmp_path_factory):
    folder = tmp_path_factory.mktemp("optimised")
    build(folder / "plain")
    return folder / "plain", folder / "optimised", build(folder / "optimised", aim=AIM)


def test_only_the_drive_words_differ_and_the_bank_says_what_for(banks):
    plain, path, report = banks
    assert verify_bank(path)["cells"] == 5
    with Bank.open(plain, BOARD) as before, Bank.open(path, BOARD) as after:
        for cell in np.flatnonzero(SOME).tolist():
            assert bytes(before.drive.words(cell)) != bytes(after.drive.words(cell))
            assert np.array_equal(before.responses.response(cell)[0], after.responses.response(cell)[0])
    reported = bank_info(path)["parameters"]
    assert reported["optimised"] == optimised.reported(BOARD, AIM)
    assert reported["optimised"]["name"] == "contrast"
    assert bank_info(plain)["parameters"]["optimised"] is None
    assert reported["amplitude_of_plain"]["cells"] == 5
    assert 0.8 < reported["amplitude_of_plain"]["least"] <= reported["amplitude_of_plain"]["median"] < 1.3
    assert report.optimised == {"aim": "contrast", "amplitude_of_plain": reported["amplitude_of_plain"]}
    assert reported["inputs_sha256"] != bank_info(plain)["parameters"]["inputs_sha256"]
    assert not list(path.parent.glob(".*"))


def test_who_replaces_an_optimised_bank_by_a_plain_one_is_reported(banks, monkeypatch, capsys):
    path = banks[1]
    assert [optimised_for(file) for file in (*banks[:2], path / "none")] == ["", "contrast", ""]
    board = msgspec.structs.replace(BOARD, bank=msgspec.structs.replace(BOARD.bank, pitch_mm=PITCH_M * 1e3, coarse=True))
    monkeypatch.setattr(own_bank, "find_bank", lambda _board: FoundBank(path, "given"))
    monkeypatch.setattr(own_bank, "bank_path", lambda *_: path)
    monkeypatch.setattr(own_bank, "reached", lambda *_: np.ones(CELLS, bool))
    monkeypatch.setattr(own_bank, "build_bank", lambda *_, **__: SimpleNamespace(interpolation_error={}))
    monkeypatch.setattr(own_bank, "warn_of_pitch", lambda *_: None)
    own_bank.own_bank(board, SimpleNamespace(emitters=()), Path("scene.toml")).close()
    said = capsys.readouterr().err
    assert "lacks 19 cells" in said
    assert said.endswith("--optimise contrast\n")


@each_row("arguments", [["--workers", "2"], ["--dask", "tcp://h:1"], ["--optimise", "quiet", "--workers", "0"]])
def test_options_that_do_not_go_together_are_a_usage_error(arguments, capsys):
    assert main(["bank", "build", *arguments]) == 2
    assert "--workers" in capsys.readouterr().err


def test_every_aim_can_be_asked_for(capsys):
    with pytest.raises(SystemExit):
        main(["bank", "build", "--help"])
    assert f"--optimise {{{','.join(AIMS)}}}" in capsys.readouterr().out


def test_an_interrupted_build_leaves_the_old_bank_and_goes_on_where_it_was(banks, tmp_path, monkeypatch):
    path = tmp_path / "bank"
    build(path)
    old = path.read_bytes()
    monkeypatch.setattr(optimised, "CELLS_AT_ONCE", 2)  # tasks of 2, 2 and 1 cells
    computed = []

    def interrupted(task):
        if computed:
            raise KeyboardInterrupt
        computed.append(task)
        return compute(task)

    monkeypatch.setattr(optimised, "compute", interrupted)
    with pytest.raises(KeyboardInterrupt):
        build(path, aim=AIM)
    assert path.read_bytes() == old
    (kept,) = tmp_path.glob(".bank.*.words")
    assert not list(tmp_path.glob("*.building"))
    record = 4 + 4 * BOARD.waveform.samples + 4
    assert kept.stat().st_size == 2 * record
    kept.write_bytes(kept.read_bytes()[:-1])  # as if the power had failed: the second record is torn

    computed.clear()
    monkeypatch.setattr(optimised, "compute", lambda task: (computed.append(task), compute(task))[1])
    build(path, aim=AIM)
    assert sum(len(task.points_m) for task in computed) == 4
    assert path.read_bytes() == banks[1].read_bytes()
    assert [file.name for file in tmp_path.iterdir()] == ["bank"]


def test_what_is_kept_for_other_inputs_is_not_taken(tmp_path, monkeypatch):
    def interrupt(task):
        raise KeyboardInterrupt

    monkeypatch.setattr(optimised, "compute", interrupt)
    for aim in (AIM, dataclasses.replace(AIM, calm=0.5)):
        with pytest.raises(KeyboardInterrupt):
            build(tmp_path / "bank", aim=aim)
    assert len(list(tmp_path.glob(".bank.*.words"))) == 2


def test_two_builds_of_one_bank_do_not_meet(tmp_path):
    kept = tmp_path / "kept"
    with optimised._Kept.open(kept, 4), pytest.raises(UsageError, match="another build"), optimised._Kept.open(kept, 4):
        pass


def test_the_words_of_a_cell_are_those_of_this_version_of_the_method():
    words = compute(optimised.Task(BOARD, 100e3, AIM, ((0.03, 0.03),), creator()))
    recorded = {2: "23e90d6d03625e31"}
    assert hashlib.sha256(words.astype("<u4").tobytes()).hexdigest()[:16] == recorded[METHOD_VERSION]


def test_a_worker_of_another_version_is_refused():
    task = optimised.Task(BOARD, 100e3, AIM, ((0.03, 0.03),), creator() + "x")
    with pytest.raises(BankError, match="another version"):
        compute(task)


@pytest.mark.slow
def test_a_scheduler_that_is_not_there_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr(dask_client, "FOUND_WITHIN_S", 0.05)
    with pytest.raises(BankError, match=r"--dask tcp://127\.0\.0\.1:1: no dask scheduler answers"):
        build(tmp_path / "bank", aim=AIM, workers=Workers(address="tcp://127.0.0.1:1"))


CLUSTER = """
import sys
{first}
from distributed import LocalCluster
cluster = LocalCluster(n_workers=1, processes=False, protocol="tcp://", host="127.0.0.1", dashboard_address=None)
print(cluster.scheduler_address, flush=True)
sys.stdin.read()
"""


@pytest.fixture
def cluster():
    """Starts a scheduler with one worker, in a process that is prepared by some code; its address."""
    with contextlib.ExitStack() as stack:

        def start(first):
            code = [sys.executable, "-c", CLUSTER.format(first=first)]
            process = subprocess.Popen(code, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            stack.enter_context(process)  # its standard input is closed, and it ends
            return process.stdout.readline().strip()

        yield start


@pytest.mark.slow
def test_workers_without_the_package_are_reported(cluster, tmp_path):
    address = cluster("sys.modules['controller'] = None")
    with pytest.raises(BankError, match=f"--dask {address}: .*lack this package.*what was done is kept") as caught:
        build(tmp_path / "bank", aim=AIM, workers=Workers(address=address))
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_scheduler_of_another_version_is_reported_with_both(cluster, tmp_path):
    address = cluster(
        "import importlib.metadata as reported\nversion = reported.version\n"
        "reported.version = lambda name: '2024.8.0' if name == 'distributed' else version(name)"
    )
    both = rf"scheduler has distributed 2024\.8\.0, this computer {re.escape(importlib.metadata.version('distributed'))}"
    with pytest.raises(BankError, match=both):
        build(tmp_path / "bank", aim=AIM, workers=Workers(address=address))


@each_row("error", [TypeError("identity() got an unexpected\nkeyword"), RuntimeError(""), OSError("closed")])
def test_whatever_dask_raises_is_one_line(error):
    with pytest.raises(BankError, match="--workers 2: dask failed") as caught, dask_client.dask_errors("--workers 2"):
        raise error
    assert "\n" not in str(caught.value)


def test_errors_of_ours_and_want_of_dask_itself_stay_what_they_are():
    for error in (BankError("a worker has another version"), ModuleNotFoundError("no dask", name="dask")):
        with pytest.raises(type(error)) as caught, dask_client.dask_errors("--workers 2"):
            raise error
        assert caught.value is error


@pytest.mark.slow
def test_a_bank_is_the_same_by_two_processes_of_which_one_is_killed(banks, tmp_path, monkeypatch):
    """The first task to arrive kills its worker, as a power cut would; the scheduler gives it to another."""
    monkeypatch.setattr(optimised, "compute", Fatal(str(tmp_path / "killed")))
    build(tmp_path / "bank", aim=AIM, workers=Workers(2))
    assert (tmp_path / "killed").exists()
    assert (tmp_path / "bank").read_bytes() == banks[1].read_bytes()


@dataclasses.dataclass(frozen=True)
class Fatal:
    """Kills the process that calls it first."""

    mark: str

    def __call__(self, task):
        try:
            os.close(os.open(self.mark, os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return compute(task)
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError
