"""What the tests share: the simulated board, and one small bank of it."""

import gc
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # two processes of tests keep two cores busy

import pytest
from hypothesis import HealthCheck, settings
from scripted_evemu import evemu

from controller.bank.reader import Bank
from controller.bank_builder.build import build_bank
from controller.board.board import load_board
from controller.board.lookup import find_board
from controller.scene.scene import load_scene
from controller.simulation.simulated_run import play
from controller.touch.recording import Recording

pytest_plugins = ["random_banks"]

# How long an example takes says how busy the machine is, not whether the code is right: a test with health checks of its own
# suppresses `too_slow` too. Every run tries the same examples, so that a failure comes from a change of the code;
# `--hypothesis-profile explore` tries others each time.
untimed = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("explore", untimed, max_examples=1000)
settings.register_profile("repeatable", untimed, derandomize=True)
settings.load_profile("repeatable")

# Files that take longest begin first, so that both processes end at about the same time.
LONGEST = ["test_rtl.py", "test_project.py", "test_cli.py"]
COVERAGE: pytest.StashKey[list[str]] = pytest.StashKey()  # what a process tells of the coverage of the Verilog


def pytest_xdist_auto_num_workers(config):
    """All tests run in two processes; what is chosen on the command line, or to be seen as it runs, in this one."""
    everything = config.args_source is config.ArgsSource.TESTPATHS and "not slow" in config.option.markexpr
    return 2 if everything and config.option.capture != "no" else 0


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: LONGEST.index(item.path.name) if item.path.name in LONGEST else len(LONGEST))


def pytest_collection_finish():
    """Each run of the loop begins with a garbage collection, which need not walk all tests and modules every time."""
    gc.collect()
    gc.freeze()


def pytest_testnodedown(node):
    """The process with the benches of tests/rtl has ended."""
    lines = getattr(node, "workeroutput", {}).get("verilog_coverage", [])
    node.config.stash.setdefault(COVERAGE, []).extend(lines)


def pytest_terminal_summary(terminalreporter, config):
    for line in config.stash.get(COVERAGE, []):
        terminalreporter.write_line(line)


PITCH_M = 10e-3  # 20 x 13 cells: built in a second


@pytest.fixture(scope="session")
def board():
    return load_board(find_board("simulated"))


@pytest.fixture(scope="session")
def bank_file(board, tmp_path_factory):
    path = tmp_path_factory.mktemp("bank") / "simulated.bank"
    build_bank(board, path, PITCH_M, measure_sgemm=False)
    return path


@pytest.fixture(scope="session")
def state_folder(tmp_path_factory):
    """A cache apart from the user's: banks of this process, compiled gateware of all processes, each library built once."""
    base = tmp_path_factory.getbasetemp()
    folder, shared = base / "state", (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "gateware"
    folder.mkdir()
    shared.mkdir(exist_ok=True)
    (folder / "gateware").symlink_to(shared)
    return folder


@pytest.fixture
def evemu_text():
    return evemu


@pytest.fixture
def perform(board, bank_file, tmp_path):
    """Replay scripted touches on a scripted scene, in virtual time unless asked; everything is the product's own."""

    def play_script(reports, scene_text, *, on=board, bank=None, real_time=False):
        scene_file = tmp_path / "scripted.toml"
        scene_file.write_text(scene_text)
        with Bank.open(bank or bank_file, on) as opened:
            return play(on, load_scene(scene_file, on), opened, Recording(evemu(*reports)), real_time=real_time)

    return play_script
