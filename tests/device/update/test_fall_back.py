"""The fall-back script, cut at every step and given every kind of state: there is always a whole release to start."""

import contextlib
import fcntl
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from tables import each_row

from controller.device.update.layout import Layout

SCRIPT = Path(__file__).parents[3] / "systemd/fall-back"
CUT_AT = ("mv", "sync", "ln", "rm")  # commands of the script that change something


class Device:
    """Releases in a folder, and a systemctl that says what the controller does."""

    def __init__(self, root):
        self.layout = Layout(root)
        for folder in (self.layout.state, self.layout.requests, self.layout.releases):
            folder.mkdir(parents=True)
        self.tools = root / "tools"
        self.tools.mkdir()
        self.unit_state("active")
        self.run("boot")

    def unit_state(self, state, restarts=0):
        systemctl = self.tools / "systemctl"
        answers = f'case "$*" in *NRestarts*) echo {restarts} ;; show*) echo {state} ;; esac\n'
        systemctl.write_text(f'#!/bin/sh\necho "$*" >>{self.tools}/asked\n{answers}')
        systemctl.chmod(0o755)

    def refuse_while(self, file):
        """Have systemctl fail once for each line of a file."""
        systemctl = self.tools / "systemctl"
        refusal = f'if [ -s {file} ]; then sed -i 1d {file}; echo "Failed to start: Connection timed out" >&2; exit 1; fi\n'
        systemctl.write_text(systemctl.read_text() + refusal)

    def asked(self):
        """What was asked of systemctl since the last time, without questions."""
        file = self.tools / "asked"
        lines = file.read_text().splitlines() if file.exists() else []
        file.unlink(missing_ok=True)
        return [line for line in lines if not line.startswith("show")]

    def add(self, version, *, complete=True):
        python = self.layout.release(version) / "venv/bin/python"
        python.parent.mkdir(parents=True)
        python.symlink_to("/bin/sh")
        if complete:
            (self.layout.release(version) / ".complete").touch()

    def environment(self, path="", **more):
        return {
            "HAPTIC_PANEL_ROOT": str(self.layout.root),
            "SYSTEMCTL": str(self.tools / "systemctl"),
            "PATH": f"{path}/usr/bin:/bin",
            **more,
        }

    def run(self, *command, **more):
        return subprocess.run([SCRIPT, *command], env=self.environment(**more), capture_output=True, text=True, check=False)

    def ask(self, name, version, **options):
        (self.layout.requests / name).write_text(f"{version}\n")
        return self.run("requests", **options)

    @property
    def current(self):
        return self.layout.current.readlink().name if self.layout.current.is_symlink() else ""

    @property
    def failed(self):
        file = self.layout.state / "failed"
        return file.read_text().split() if file.exists() else []


@pytest.fixture
def device(tmp_path):
    """One that uses release 1.0, and has 2.0 installed."""
    made = Device(tmp_path / "root")
    made.add("1.0")
    assert made.run("adopt", "1.0").returncode == 0
    made.add("2.0")
    made.add("3.0", complete=False)
    return made


def test_a_trial_that_is_called_good_stays(device):
    device.ask("trial", "2.0")
    assert device.current == "1.0", "nothing is switched while the controller runs"
    assert device.asked() == [
        "reset-failed haptic-panel.service haptic-panel-trial.service",
        "--no-block restart haptic-panel.service",
    ]
    assert "release 2.0 is on trial, start 1 of 3" in device.run("boot").stderr
    assert device.asked() == ["--no-block restart haptic-panel-deadline.timer"]
    assert device.current == "2.0"
    device.ask("good", "2.0")
    assert not device.asked(), "it plays on"
    assert [device.layout.word(name) for name in ("current", "previous", "trial")] == ["2.0", "1.0", ""]
    device.run("boot")
    assert device.current == "2.0"


@pytest.mark.parametrize("failures", [1, 2])
def test_a_deadline_that_systemd_does_not_take_is_asked_for_twice(device, failures):
    device.ask("trial", "2.0")
    device.asked()
    refusals = device.tools / "refusals"
    refusals.write_text("x\n" * failures)
    device.refuse_while(refusals)
    done = device.run("boot")
    assert device.asked() == ["--no-block restart haptic-panel-deadline.timer"] * 2
    assert done.returncode == (0 if failures == 1 else 1)
    assert ("release 2.0 is not started this time: its deadline was not set" in done.stderr) == (failures == 2)
    assert device.run("boot").returncode == 0, "what the unit does then"
    assert device.current == "2.0"
    assert device.layout.word("tries") == "2"


def test_a_trial_that_never_serves_is_given_up_after_three_starts_and_not_tried_again(device):
    device.ask("trial", "2.0")
    for _ in range(3):
        device.run("boot")
        assert device.current == "2.0"
    assert "release 2.0 was started 3 times and did not serve" in device.run("boot").stderr
    assert (device.current, device.failed) == ("1.0", ["2.0"])
    device.asked()
    assert "it has failed before" in device.ask("trial", "2.0").stderr
    assert not device.asked()
    device.run("boot")
    assert device.current == "1.0"


def test_the_updater_can_read_what_is_written_before_a_start_of_the_controller(device):
    device.ask("trial", "2.0")
    before = os.umask(0o077)  # the unit's
    try:
        for _ in range(4):
            device.run("boot")
    finally:
        os.umask(before)
    assert {file.name: file.stat().st_mode & 0o777 for file in device.layout.state.iterdir()} == {"current": 0o644, "failed": 0o644}


def test_a_trial_that_stands_and_is_not_evaluated_yet_survives_any_number_of_starts(device):
    device.ask("trial", "2.0")
    for _ in range(10):
        device.run("boot")
        device.ask("stands", "2.0")
    assert (device.current, device.failed) == ("2.0", [])


@each_row("how", ["bad", "failed", "late"], afresh=[device])
def test_a_trial_that_fails_is_given_up_at_once(device, how):
    device.ask("trial", "2.0")
    device.run("boot")
    device.asked()
    device.unit_state("failed" if how == "failed" else "activating")
    if how == "bad":
        device.ask("bad", "2.0")
    else:
        device.run(how)
    assert device.asked() == [
        "reset-failed haptic-panel.service haptic-panel-trial.service",
        "--no-block restart haptic-panel.service",
    ]
    device.run("boot")
    assert (device.current, device.failed) == ("1.0", ["2.0"])


@each_row("how", ["failed", "late"], afresh=[device])
def test_what_is_no_trial_is_not_given_up(device, how):
    device.unit_state("failed" if how == "failed" else "activating")
    device.run(how)
    device.unit_state("active")
    device.ask("trial", "2.0")
    device.run("boot")
    device.asked()
    if how == "late":  # ready in time
        device.run(how)
        assert device.layout.word("trial") == "2.0"
    assert (device.asked(), device.failed) == ([], [])


def test_a_trial_that_ends_again_and_again_has_one_deadline_for_all_its_starts(device):
    device.ask("trial", "2.0")
    device.run("boot")
    device.run("boot")
    device.run("late")
    assert device.layout.word("trial") == "2.0", "started twice, not by itself: the power was cut"
    device.unit_state("active", restarts=1)
    device.ask("stands", "2.0")
    device.run("late")
    assert device.layout.word("trial") == "2.0", "it stands since"
    device.run("boot")
    device.run("boot")
    device.run("late")
    assert (device.layout.word("trial"), device.failed) == ("", ["2.0"])


def test_a_failure_that_is_over_is_not_the_trials(device):
    """The release before could not be stopped in time, and failed so: OnFailure= comes when the trial has been started already."""
    device.ask("trial", "2.0")
    device.run("boot")
    device.unit_state("activating")
    device.run("failed")
    assert device.layout.word("trial") == "2.0"
    device.unit_state("failed")
    assert "release 2.0 has failed (haptic-panel.service: " in device.run("failed").stderr
    assert (device.layout.word("trial"), device.failed) == ("", ["2.0"])


def test_a_verdict_from_before_a_power_cut_counts_at_the_next_start(device):
    device.ask("trial", "2.0")
    for _ in range(3):
        device.run("boot")
    (device.layout.requests / "good").write_text("2.0\n")
    device.run("boot")
    assert (device.current, device.layout.word("current"), device.failed) == ("2.0", "2.0", [])
    assert not list(device.layout.requests.iterdir())


def test_a_rollback_that_is_read_once_more_is_not_one_step_more(device):
    device.add("2.5")
    for version in ("2.0", "2.5"):
        device.ask("trial", version)
        device.run("boot")
        if version == "2.0":
            device.ask("good", version)
    for _ in range(2):  # the power was cut before the request was removed
        device.ask("rollback", "2.5")
    device.run("boot")
    assert (device.current, device.layout.word("previous"), device.failed) == ("2.0", "1.0", ["2.5"])


def test_two_of_it_run_one_after_the_other(device):
    device.ask("trial", "2.0")
    state = os.open(device.layout.root / ".lock", os.O_RDONLY)
    try:
        fcntl.flock(state, fcntl.LOCK_EX)
        with subprocess.Popen([SCRIPT, "boot"], env=device.environment(), stderr=subprocess.PIPE) as started:
            while f"flock -w 20 9 {started.pid}" not in waiting_for_a_lock(started.pid):
                assert started.poll() is None
            assert device.current == "1.0"
            fcntl.flock(state, fcntl.LOCK_UN)
            assert started.wait() == 0
    finally:
        os.close(state)
    assert device.current == "2.0"


def test_what_others_may_open_and_lock_holds_nothing_up(device):
    """Any user of the device can open these folders, and hold a lock on them."""
    device.ask("trial", "2.0")
    folders = [device.layout.root, device.layout.state, device.layout.requests, device.layout.releases]
    held = [os.open(folder, os.O_RDONLY) for folder in folders]
    try:
        for folder in held:
            fcntl.flock(folder, fcntl.LOCK_EX)
        done = device.run("boot", path=f"{refusing_to_wait(device)}:")
    finally:
        for folder in held:
            os.close(folder)
    assert "release 2.0 is on trial, start 1 of 3" in done.stderr
    assert device.current == "2.0"
    assert (device.layout.root / ".lock").stat().st_mode & 0o777 == 0o600


def refusing_to_wait(device):
    """A folder of a flock that takes a lock at once or not at all."""
    folder = device.tools / "at_once"
    folder.mkdir()
    (folder / "flock").write_text("#!/bin/sh\nexec /usr/bin/flock -n 9\n")
    (folder / "flock").chmod(0o755)
    return folder


@each_row("command", ["boot", "requests", "failed", "late", "adopt"], afresh=[device])
def test_without_the_lock_nothing_is_changed_and_a_start_has_its_release(device, command):
    """Another of these scripts hangs, as a disk does not answer."""
    device.ask("trial", "2.0")
    (device.layout.requests / "stands").write_text("2.0\n")
    device.asked()
    before = everything(device)
    with (device.layout.root / ".lock").open("ab") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        done = device.run(command, *(["2.0"] if command == "adopt" else []), path=f"{refusing_to_wait(device)}:")
    (line,) = done.stderr.splitlines()
    if command == "boot":
        assert (done.returncode, device.current) == (0, "1.0")
        assert "release 1.0 is used, and nothing is changed: " in line
    else:
        assert done.returncode == 1
        assert f"{command}: not done: " in line
    assert ".lock was not had in 20 s: another of these is at work" in line
    assert (everything(device), device.asked()) == (before, [])
    device.run("boot")
    assert device.current == "2.0", "what was asked for is done later"


def test_without_the_lock_and_without_a_release_a_start_fails(device):
    device.layout.current.unlink()
    with (device.layout.root / ".lock").open("ab") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        assert device.run("boot", path=f"{refusing_to_wait(device)}:").returncode == 1


def everything(device):
    """Files of the state and requests, and what `current` leads to."""
    files = {file.name: file.read_text() for folder in (device.layout.state, device.layout.requests) for file in folder.iterdir()}
    return device.current, files


def waiting_for_a_lock(parent):
    """Commands of a process's children, each with its parent."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            if status.read_text().rpartition(")")[2].split()[1] == str(parent):
                found.append(f"{(status.parent / 'cmdline').read_text().strip(chr(0)).replace(chr(0), ' ')} {parent}")
    return found


def test_where_nothing_can_be_written_what_was_begun_goes_on(device):
    """A disk that has become read-only: a release is used, and not none."""
    device.ask("trial", "2.0")
    device.run("boot")
    done = device.run("boot", path=f"{refusing(device, 'sync', 'mv', 'ln', 'rm')}:")
    assert done.returncode == 0
    assert "release 2.0 is used, as `current` cannot be changed" in done.stderr
    assert device.current == "2.0"


def refusing(device, *commands):
    """A folder of commands that fail."""
    folder = device.tools / "refusing"
    folder.mkdir()
    for name in commands:
        (folder / name).write_text("#!/bin/sh\nexit 1\n")
        (folder / name).chmod(0o755)
    return folder


def test_a_list_of_failed_releases_that_is_damaged_is_mended(device):
    (device.layout.state / "failed").write_bytes(b"\0\xff\n0.9\n../x\n")
    device.ask("trial", "2.0")
    device.run("boot")
    device.ask("bad", "2.0")
    assert device.failed == ["0.9", "2.0"]


def test_back_by_hand(device):
    assert "there is no release before" in device.ask("rollback", "1.0").stderr
    device.ask("trial", "2.0")
    device.run("boot")
    device.ask("good", "2.0")
    device.ask("rollback", "2.0")
    device.run("boot")
    assert (device.current, device.failed) == ("1.0", ["2.0"])


@each_row("version", ["3.0", "4.0", "../1.0", "-rf", "", ".hidden", "x" * 65, "2.0/../2.0"], afresh=[device])
def test_what_is_no_complete_release_is_not_tried(device, version):
    assert "haptic-panel: " in device.ask("trial", version).stderr
    assert not list(device.layout.requests.iterdir())
    assert device.layout.word("trial") == ""
    device.run("boot")
    assert device.current == "1.0"


def test_a_controller_that_an_operator_has_stopped_stays_so(device):
    device.unit_state("inactive")
    device.ask("trial", "2.0")
    assert not device.asked()
    device.run("boot")
    assert device.current == "2.0"


def test_requests_that_mean_nothing_are_dropped(device):
    (device.layout.requests / "format-disk").write_text("1.0\n")
    (device.layout.requests / "trial").mkdir()
    (device.layout.requests / "good").symlink_to("/etc/passwd")
    device.run("requests")
    assert not list(device.layout.requests.iterdir())
    assert device.current == "1.0"


def test_a_start_does_not_wait_for_what_the_updater_puts_among_its_requests(device):
    """Files without number, trees, pipes: another user's; they are removed after the start, and a start takes what it knows."""
    for number in range(300):
        (device.layout.requests / f"z{number}").write_text("2.0\n")
    (device.layout.requests / "bad" / "deep").mkdir(parents=True)
    os.mkfifo(device.layout.requests / "good")
    (device.layout.requests / "trial").write_text("2.0\n")
    done = device.run("boot")
    assert done.stderr.splitlines() == ["haptic-panel: release 2.0 is on trial, start 1 of 3"]
    assert device.current == "2.0"
    assert len(list(device.layout.requests.iterdir())) == 302
    device.asked()
    device.run("requests")
    assert not list(device.layout.requests.iterdir())
    assert not device.asked()


@each_row("name", ["current", "previous", "trial", "tries", "failed"])
@each_row("damage", [b"", b"\0" * 100, b"../../etc\n", b"-rf\n", b"9.9\n", bytes(range(256)) * 20], afresh=[device])
def test_a_damaged_state_still_starts_a_whole_release(device, name, damage):
    device.ask("trial", "2.0")
    device.run("boot")
    (device.layout.state / name).write_bytes(damage)
    for _ in range(2):
        assert device.run("boot").returncode == 0
        assert device.layout.is_complete(device.current)


def test_where_a_start_cannot_be_counted_the_trial_is_not_started(device):
    device.ask("trial", "2.0")
    assert "its start cannot be counted" in device.run("boot", path=f"{refusing(device, 'sync')}:").stderr
    assert (device.current, device.failed) == ("1.0", [])


def test_without_any_release_it_says_so(tmp_path):
    device = Device(tmp_path / "root")
    done = device.run("boot")
    assert done.returncode == 1
    assert "no release is complete: install the package again" in done.stderr


def test_where_all_have_failed_the_newest_is_used(device):
    (device.layout.state / "failed").write_text("1.0\n2.0\n")
    (device.layout.state / "current").unlink()
    device.layout.current.unlink()
    device.run("boot")
    assert device.current == "2.0"


def cutting(device, number, before):
    """A folder of commands of which the one with this number kills the script, before it does its work or after."""
    folder = device.tools / "cutting"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name in CUT_AT:
        do = f'/bin/{name} "$@"; code=$?'
        kill = f"n=$(cat {folder}/count); if [ $n = {number} ]; then {'' if before else do + ';'} kill -9 $PPID; exit; fi"
        (folder / name).write_text(f"#!/bin/sh\necho $(($(cat {folder}/count) + 1)) >{folder}/count\n{kill}\n{do}\nexit $code\n")
        (folder / name).chmod(0o755)
    (folder / "count").write_text("0\n")
    return f"{folder}:"


WANTED = {"trial": "2.0", "boot": "2.0", "last boot": "1.0", "good": "2.0", "bad": "1.0", "rollback": "1.0", "stands": "2.0"}


@pytest.mark.slow
@pytest.mark.parametrize("what", ["trial", "boot", "last boot", "good", "bad", "failed", "stands", "rollback", "adopt", "damaged"])
def test_cut_at_any_command_the_next_start_ends_on_a_whole_release(tmp_path, what):
    """Killed before and after each command that changes something; the wanted end is reached by doing it again."""
    points = 0
    for number in range(1, 100):
        counts = set()
        for before in (True, False):
            device = Device(tmp_path / f"{number}-{before}")
            device.add("1.0")
            device.add("2.0")
            device.run("adopt", "1.0")
            if what != "trial":
                device.ask("trial", "2.0")
            for _ in range({"last boot": 3, "boot": 0, "trial": 0}.get(what, 1)):
                device.run("boot")
            if what == "rollback":
                device.ask("good", "2.0")
            if what == "damaged":
                (device.layout.state / "current").write_bytes(b"\0\0")
            path = cutting(device, number, before)
            if what in ("trial", "good", "bad", "stands", "rollback"):
                device.ask(what, "2.0", path=path)
            elif what == "adopt":
                device.run("adopt", "2.0", path=path)
            else:
                device.unit_state("failed")
                device.run("failed" if what == "failed" else "boot", path=path)
            counts.add(int((device.tools / "cutting/count").read_text()))
            for command in (("boot",), ("requests",), ("boot",)):
                device.run(*command)
                assert not device.current or device.layout.is_complete(device.current), (number, before, command)
            assert device.current
            allowed = {
                "trial": "2.0",
                "boot": "2.0",
                "last boot": "1.0",
                "good": "2.0",
                "bad": "1.0",
                "rollback": "1.0",
                "stands": "2.0",
            }
            if what in allowed:
                assert device.current == allowed[what], (number, before)
            shutil.rmtree(device.layout.root)
        if max(counts) < number:
            break
        points += 2
    print(f"{what}: {points} points")
    assert points >= 4


class Life(RuleBasedStateMachine):
    """Whatever is asked, started and lost in whatever order."""

    versions = st.sampled_from(["1.0", "2.0", "3.0", "4.0"])

    @initialize()
    def begin(self):
        import tempfile

        self.folder = tempfile.TemporaryDirectory()
        self.device = Device(Path(self.folder.name) / "root")
        for version in ("1.0", "2.0", "3.0"):
            self.device.add(version)
        self.device.run("adopt", "1.0")
        self.starts = 0  # of the trial in a row, without a word for it
        self.on_trial = ""
        self.ever_failed = set()

    @rule(version=versions)
    def try_it(self, version):
        self.device.ask("trial", version)
        if self.device.layout.word("trial") == version:
            self.starts = 0
            assert version not in self.ever_failed

    @rule()
    def start(self):
        self.device.run("boot")
        trial = self.device.layout.word("trial")
        assert not trial or trial == self.device.current
        self.starts = self.starts + 1 if trial else 0
        assert self.starts <= 3

    @rule(name=st.sampled_from(["good", "bad", "stands", "rollback"]), version=versions)
    def judge(self, name, version):
        before = self.device.layout.word("current")
        trial = self.device.layout.word("trial")
        self.device.ask(name, version)
        if name == "stands" and version == trial:
            self.starts = 0
        if name == "good" and version != trial:
            assert self.device.layout.word("current") == before

    @rule(how=st.sampled_from(["failed", "late"]))
    def fail(self, how):
        self.device.unit_state("failed" if how == "failed" else "activating")
        self.device.run(how)
        self.device.unit_state("active")

    @precondition(lambda self: self.device.layout.word("current") != "1.0")
    @rule()
    def lose_a_release(self):
        (self.device.layout.release("1.0") / ".complete").unlink(missing_ok=True)

    @invariant()
    def there_is_a_release_and_what_has_failed_is_remembered(self):
        if hasattr(self, "device"):
            self.ever_failed |= set(self.device.failed)
            assert self.ever_failed == set(self.device.failed)

    def teardown(self):
        if hasattr(self, "device"):
            self.device.run("boot")
            assert self.device.layout.is_complete(self.device.current)
            self.folder.cleanup()


TestLife = Life.TestCase
TestLife.settings = settings(max_examples=4, stateful_step_count=12, deadline=None, suppress_health_check=list(HealthCheck))
