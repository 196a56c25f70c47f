"""Banks whose cells workers compute: the bytes of one process, from a model and from measured responses, also when killed."""

import os
import pickle
import shutil
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

import msgspec
import numpy as np
import pytest
from small_plate import small_board
from tables import each_row
from worker_functions import kill_session
from workshop.calibration.true_plate import TruePlate

from controller.device.board.panel import AssumedFinger
from controller.device.scene.scene import FixedEmitter
from controller.errors import ConfigError
from controller.workshop.bank_builder import plan, said_amplitude
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.cells import CellEntries
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.calibration.interpolation.interpolate import interpolate
from controller.workshop.calibration.point_plan import scattered_points
from controller.workshop.workers import map_kept
from controller.workshop.workers.workers import ALONE, Workers

TWO = Workers(2)
CELLS = 16 * 11  # with a pitch of 4 mm
BOARD = small_board()
DRIFTING = msgspec.structs.replace(BOARD, waveform=msgspec.structs.replace(BOARD.waveform, drift_percent=1.0))
TOUCHED = msgspec.structs.replace(BOARD, finger=AssumedFinger())


@lru_cache
def measured():
    """Responses measured on a plate with free edges."""
    learned = TruePlate(BOARD, 1.6, edges="free").learned(scattered_points(BOARD, 100, 2e-3))
    return interpolate(BOARD, learned, exact=True)[0]


def build(path, workers, source=None, board=BOARD, pitch_m=4e-3, **others):
    return build_bank(BankRequest(board, path, pitch_m, source=source, workers=workers, **others))


@pytest.fixture
def groups(monkeypatch):
    """Blocks of 32 cells, computed by what a worker gets: the function as it is sent; those that are computed."""
    computed = []

    def by_workers(function, tasks, workers):
        assert workers == TWO
        sent = pickle.dumps(function)
        for task in tasks:
            computed.append(task.items)
            yield task.compute(pickle.loads(sent))

    monkeypatch.setattr(map_kept, "_computed", by_workers)
    monkeypatch.setattr(plan, "CELLS_PER_BLOCK", 32)
    monkeypatch.setattr(said_amplitude, "PLACES", 3)  # of the whole bank, whoever computes its cells
    return computed


@each_row("board, source", [
    (BOARD, None),
    (BOARD, measured),
    (TOUCHED, None),
    (DRIFTING, measured),
])  # fmt: skip
def test_workers_give_the_bytes_of_one_process(board, source, groups, tmp_path):
    groups.clear()
    emitters = [FixedEmitter(0.02, 0.02, 10.0, "a"), FixedEmitter(0.05, 0.03, 10.0, "b")]
    how = {"source": source and source(), "board": board, "emitters": emitters}
    assert build(tmp_path / "one", ALONE, **how).workers is None
    assert not groups
    report = build(tmp_path / "two", TWO, **how)
    assert (len(groups), report.workers["kept"]) == (6, 0)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()
    assert sorted(file.name for file in tmp_path.iterdir()) == ["one", "two"]


@pytest.fixture
def interrupted(groups, monkeypatch):
    """A build at the third block of which Ctrl-C is pressed."""
    compute = CellEntries.__call__

    def until_third(entries, blocks):
        if len(groups) == 3:
            raise KeyboardInterrupt
        return compute(entries, blocks)

    def interrupted_build(path, **how):
        groups.clear()
        with monkeypatch.context() as until:
            until.setattr(CellEntries, "__call__", until_third)
            with pytest.raises(KeyboardInterrupt):
                build(path, TWO, **how)

    return interrupted_build


def test_an_interrupted_build_goes_on_at_its_blocks(interrupted, tmp_path):
    interrupted(tmp_path / "two")
    assert [file.suffix for file in tmp_path.iterdir()] == [".cells"]
    assert build(tmp_path / "two", TWO).workers["kept"] == 2
    build(tmp_path / "one", ALONE)
    assert (tmp_path / "two").read_bytes() == (tmp_path / "one").read_bytes()
    assert sorted(file.name for file in tmp_path.iterdir()) == ["one", "two"]


def test_what_is_kept_of_another_bank_is_not_taken(interrupted, tmp_path, monkeypatch):
    interrupted(tmp_path / "bank")
    interrupted(tmp_path / "bank", cells=np.arange(CELLS) > 0)
    interrupted(tmp_path / "bank", board=DRIFTING)
    monkeypatch.setattr(plan, "CELLS_PER_BLOCK", 16)
    interrupted(tmp_path / "bank")
    assert len(list(tmp_path.glob(".bank.*.cells"))) == 4


@each_row("how, said", [
    ({"compact": True}, "--workers 2: a compact bank is computed by one process"),
    ({"memory_mb": 300, "pitch_m": 5e-4}, "a bank of 'simulated' that is collected from workers takes 4.. MB"),
])  # fmt: skip
def test_what_workers_cannot_do_is_refused_before_they_begin(how, said, groups, tmp_path):
    with pytest.raises(ConfigError, match=said):
        build(tmp_path / "bank", TWO, **how)
    assert not groups
    assert not list(tmp_path.iterdir())


class FatalEntries(CellEntries):
    """Kills all processes of its session with the third block, as a power cut would, once another is kept."""

    def __call__(self, blocks):
        """As that of `CellEntries`."""
        if blocks[0][0, 1] == pytest.approx(21e-3):
            kill_session(next(Path(os.environ["KEPT_IN"]).glob(".*.cells")))
        return super().__call__(blocks)


KILLED = """
import sys
from pathlib import Path
from controller.workshop.bank_builder import cells, plan
from workshop.bank_builder import test_cells as test
if __name__ == "__main__":
    plan.CELLS_PER_BLOCK, cells.CellEntries = 32, test.FatalEntries
    test.build(Path(sys.argv[1]), test.TWO, test.measured() if sys.argv[2:] else None)
"""


@pytest.mark.slow
@each_row("source", [[], ["measured"]])
def test_after_kill_9_of_everything_processes_and_a_cluster_go_on_to_the_same_bytes(source, tmp_path, monkeypatch):
    from distributed import LocalCluster

    monkeypatch.setattr(plan, "CELLS_PER_BLOCK", 32)
    script, killed, other = tmp_path / "killed.py", tmp_path / "killed/bank", tmp_path / "other/bank"
    script.write_text(KILLED)
    killed.parent.mkdir()
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2]), "KEPT_IN": str(killed.parent)}
    ended = subprocess.run([sys.executable, script, killed, *source], env=environment, start_new_session=True, check=False)
    assert ended.returncode == -9
    shutil.copytree(killed.parent, other.parent)
    responses = measured() if source else None
    build(tmp_path / "one", ALONE, responses)
    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        for path, workers in ((killed, TWO), (other, Workers(address=cluster.scheduler_address))):
            assert 0 < build(path, workers, responses).workers["kept"] < 6
            assert path.read_bytes() == (tmp_path / "one").read_bytes()
            assert [file.name for file in path.parent.iterdir()] == ["bank"]
