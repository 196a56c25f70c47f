"""What the tests share: the simulated board, and one small bank of it."""

import gc
import os
import re
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # processes of tests keep all cores busy
sys.dont_write_bytecode = False  # of the tests as pytest rewrites them: 10 s of each process of every run but the first

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.configuration import set_hypothesis_home_dir
from quick import SECONDS, is_quick
from scripted_evemu import evemu
from xdist.scheduler import LoadFileScheduling

from controller.device.bank.reader import Bank
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.scene import load_scene
from controller.device.touch.recordings.recording import Recording
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.simulation.simulated_run import play

pytest_plugins = ["random_banks"]

# How long an example takes says how busy the machine is, not whether the code is right: a test with health checks of its own
# suppresses `too_slow` too. Every run tries the same examples, so that a failure comes from a change of the code;
# `--hypothesis-profile explore` tries others each time.
untimed = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("explore", untimed, max_examples=1000)
settings.register_profile("repeatable", untimed, derandomize=True, max_examples=50)
settings.register_profile("quick", settings.get_profile("repeatable"), max_examples=20)
settings.load_profile("repeatable")
set_hypothesis_home_dir(Path(sys.prefix, "hypothesis"))  # not in the checkout

# Files that take longest begin first, so that all processes end at about the same time.
LONGEST = ["test_rtl.py", "test_readme_runs.py", "test_project.py", "test_cli.py", "test_locked.py", "test_build.py"]
LONGEST += ["test_kernel_guest.py", "test_run.py", "test_several_fpgas.py", "test_rehearsal.py", "test_tolerance.py"]
OWN_LINES = ("kernel", "gateware")  # in the README, beside that of all others
HERE = Path(__file__).parent
COVERAGE: pytest.StashKey[list[str]] = pytest.StashKey()  # what a process tells of the coverage of the Verilog


def pytest_xdist_auto_num_workers(config):
    """All tests run in three processes, or four, which keep two cores busy: some wait; what is chosen by name, in this one."""
    marked = config.option.markexpr
    everything = config.args_source is config.ArgsSource.TESTPATHS and (
        "not slow" in marked or marked in {"kernel", "quick", "gateware"}
    )
    return (4 if marked == "kernel" else 3) if everything and config.option.capture != "no" else 0


def pytest_configure(config):
    """Before any test is imported.

    `-m quick` tries fewer examples, where a test has no number of its own. Each of several processes begins at another place of
    the files, so that in a fresh checkout each rewrites some of them, which takes 10 s, and finds the others as they were left.
    """
    if config.option.markexpr == "quick" and settings.get_current_profile_name() == "repeatable":
        settings.load_profile("quick")
    if (worker := getattr(config, "workerinput", None)) and config.args == ["tests"]:
        files = sorted(str(path) for path in HERE.rglob("test_*.py") if not left_out(path, config.option.markexpr))
        first = int(worker["workerid"].removeprefix("gw")) * len(files) // worker["workercount"]
        config.args[:] = files[first:] + files[:first]


class ByFileOrMachine(LoadFileScheduling):
    """Tests of a file run in one process, one after the other; of those that run elsewhere, all that share a machine."""

    def _split_scope(self, nodeid):
        elsewhere = re.search(r"/test_kernel_guest\.py::.*\[(container_\w+|guest|system)", nodeid)
        return elsewhere[1].replace("system", "guest") if elsewhere else super()._split_scope(nodeid)


def pytest_xdist_make_scheduler(config, log):
    return ByFileOrMachine(config, log) if config.option.dist == "loadfile" else None


def pytest_ignore_collect(collection_path, config):
    """Leave out files without a test that is asked for by `-m quick`, `-m kernel` or `-m gateware`; None otherwise: as always."""
    return True if collection_path.suffix == ".py" and left_out(collection_path, config.option.markexpr) else None


def left_out(path, marked):
    """Whether a file has no test that `-m marked` runs; pytest asks `pytest_ignore_collect` of no file that it is given by name."""
    if marked == "quick":
        return not is_quick(path)
    if marked == "gateware" and "conformance" in path.parts:  # whose conftest.py marks tests of the compiled Verilog
        return False
    return marked in OWN_LINES and f"mark.{marked}" not in path.read_text()


def pytest_collection_modifyitems(items, config):
    if config.option.markexpr in OWN_LINES:  # of which the slow form has the slow ones
        items[:] = [item for item in items if not item.get_closest_marker("slow")]
    for item in items:
        slower = getattr(item, "originalname", "") in SECONDS or any(
            item.get_closest_marker(name) for name in ("slow", "stress", *OWN_LINES)
        )
        if is_quick(item.path) and not slower:
            item.add_marker(pytest.mark.quick)
    items.sort(key=lambda item: (LONGEST.index(item.path.name) if item.path.name in LONGEST else len(LONGEST), item.path))


@pytest.fixture(scope="module", autouse=True)
def what_is_there_stays():
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


KEPT_LIBRARIES = 30  # of compiled gateware, each under the hash of all that it is built from
PITCH_M = 10e-3  # 20 x 13 cells: built in a second


@pytest.fixture(scope="session")
def board():
    return load_board(find_board("simulated"))


@pytest.fixture(scope="session")
def bank_file(board, tmp_path_factory):
    path = tmp_path_factory.mktemp("bank") / "simulated.bank"
    build_bank(BankRequest(board, path, PITCH_M))
    return path


@pytest.fixture(scope="session")
def state_folder(tmp_path_factory):
    """A cache apart from the user's: banks of this process; compiled gateware of all runs, the libraries that are newest."""
    folder, shared = tmp_path_factory.getbasetemp() / "state", Path(sys.prefix, "gateware")
    folder.mkdir()
    shared.mkdir(exist_ok=True)
    for library in sorted(shared.glob("*.so"), key=lambda path: path.stat().st_mtime)[:-KEPT_LIBRARIES]:
        library.unlink(missing_ok=True)  # by the process of another run
    (folder / "gateware").symlink_to(shared)
    return folder


@pytest.fixture(autouse=True)
def own_state(request, state_folder, monkeypatch):
    """What a test keeps is not the user's, whose banks may be measured ones of boards with the same name; a machine has its own."""
    if not request.node.get_closest_marker("kernel"):
        monkeypatch.setenv("STATE_DIRECTORY", str(state_folder))
    return state_folder


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
