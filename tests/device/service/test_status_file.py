"""The file that tells state of a running panel: what is in it, when it is written, and who may read it."""

import errno
import os
import stat
import time
from itertools import pairwise

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.cli import main
from controller.device.board import panel_status
from controller.device.board.panel_state import Condition, PanelState
from controller.device.board.panel_status import BYTES_MAX, STALE_S, PanelStatus, boot_id, read_now, read_status
from controller.device.service import status_file
from controller.device.service.status_file import APART_S, PATIENCE_S, PERIOD_S, SPARE_S, StatusFile
from controller.device.update.layout import Layout
from controller.errors import ControllerError
from controller.metrics import Counters

ARMED = Condition(PanelState.ARMED, "", True, True, 23.5)


@pytest.fixture
def written(tmp_path):
    """A status file in its folder, with counters, and the file's path."""
    file = StatusFile(tmp_path, "glass")
    counters = Counters(heartbeats=7, emissions=3, outages=1)
    counters.upload_latency.record(1000, 2000, 3000, 4000, 5000)
    file.watch(counters, lambda: 2)
    return file, counters, tmp_path / "status.json"


def test_it_tells_state_counters_and_latency_and_everybody_may_read_it(written):
    file, _, path = written
    umask = os.umask(0o077)
    try:
        file.changed(ARMED)
        file.use(file.due_s, file.due_s + 1)
    finally:
        os.umask(umask)
    status = read_status(path)
    assert (status.state, status.outputs_on, status.temperature_c, status.board) == (PanelState.ARMED, True, 23.5, "glass")
    assert (status.heartbeats, status.emissions, status.outages, status.waiting) == (7, 3, 1, 2)
    assert (status.release, status.pid, status.boot) == ("checkout", os.getpid(), boot_id())
    assert (status.upload.count, status.upload.worst_us) == (1, 8.0)
    assert status.upload.p99_us == pytest.approx(8.0, rel=0.01)
    assert stat.S_IMODE(path.stat().st_mode) == 0o644
    assert list(path.parent.iterdir()) == [path]


def test_before_the_first_state_is_known_nothing_is_written(written):
    file, _, path = written
    assert file.due_s == float("inf")
    assert read_status(path) is None


def test_without_a_runtime_folder_nothing_is_ever_due():
    file = StatusFile.from_environment("glass", {})
    file.changed(ARMED)
    assert file.due_s == float("inf")
    file.close()


@given(st.lists(st.tuples(st.floats(1e-4, 0.7), st.floats(0, 0.01), st.booleans()), max_size=80))
def test_it_is_written_about_once_a_second_in_gaps_of_the_schedule(turns):
    """Turns: time to the next, gap behind this one, whether the state changes; nothing is written to a disk here."""
    writes, reported_s = [], []

    class Noted(StatusFile):
        def _write(self, now_s, *, ended=False):
            assert not ended
            self.due_s, self._written_s = now_s + PERIOD_S, now_s
            writes.append(now_s)

    file = Noted(status_file.Path("/"), "glass")
    now_s = file._written_s + APART_S
    file.changed(ARMED)
    due_s = file.due_s
    for step_s, gap_s, changes in turns:
        now_s += step_s
        if changes:
            file.changed(ARMED)
            reported_s.append(now_s)
        if file.due_s <= now_s:
            due_s = file.due_s
            file.use(now_s, now_s + gap_s)
            if not writes or writes[-1] != now_s:
                assert gap_s < SPARE_S
                assert now_s - due_s < PATIENCE_S, "it waits for a gap no longer"
    for earlier_s, later_s in pairwise(writes):
        assert later_s - earlier_s >= (APART_S if any(earlier_s < s <= later_s for s in reported_s) else PERIOD_S) * (1 - 1e-9)
    os.close(file._folder)


@pytest.mark.parametrize("why", [errno.ENOSPC, errno.EROFS])
def test_a_full_folder_is_counted_reported_once_and_the_last_status_stays(written, monkeypatch, capsys, why):
    file, _, path = written
    file.changed(ARMED)
    file.use(file.due_s, file.due_s + 1)
    before = path.read_bytes()

    def full(*_):
        raise OSError(why, os.strerror(why))

    with monkeypatch.context() as patched:
        patched.setattr(os, "write", full)
        for _ in range(3):
            file.use(file.due_s, file.due_s + 1)
    assert path.read_bytes() == before
    said = capsys.readouterr().err
    assert said.count("\n") <= 1, said
    file.use(file.due_s, file.due_s + 1)
    assert read_status(path).statuses_lost == 3


def test_at_the_end_it_says_so(written):
    file, _, path = written
    file.changed(Condition(PanelState.FAULTED, "too many edges"))
    file.close()
    status, old = read_now(path)
    assert (status.ended, status.state, status.cause, status.outputs_on) == (True, PanelState.FAULTED, "too many edges", False)
    assert old == "the service has ended"


def test_in_a_sandbox_without_proc_the_unit_tells_the_boot(monkeypatch, tmp_path):
    monkeypatch.setattr(panel_status, "BOOT_ID", tmp_path / "none")
    assert boot_id({"HAPTIC_PANEL_BOOT": "0123456789abcdef0123456789abcdef"}) == "0123456789abcdef0123456789abcdef"
    assert boot_id({}) == ""


def statuses(**fields):
    """A status as the file has it."""
    now_s = time.monotonic()
    plain = dict.fromkeys(
        ("heartbeats", "due", "foci", "emissions", "uploads", "late", "idled", "host_silent", "outages", "skipped", "waiting"), 0
    )
    lost = {"log_lines_lost": 0, "statuses_lost": 0, "upload": {}, "resident": {}}
    said = {
        "release": "1.2",
        "board": "glass",
        "pid": os.getpid(),
        "boot": boot_id(),
        "started_s": now_s - 90_061,
        "written_s": now_s,
    }
    state = {"state": "armed", "cause": "", "outputs_on": True, "panel_present": True, "temperature_c": None}
    return plain | lost | said | state | fields


def asked(tmp_path, capsys, *options, **fields):
    """Exit code and words of `haptic-panel status`."""
    file = tmp_path / "status.json"
    file.write_bytes(msgspec.json.encode(statuses(**fields)))
    code = main(["status", "--file", str(file), *options])
    out, err = capsys.readouterr()
    assert err.count("\n") <= 1
    return code, out, err


def test_the_command_says_how_the_panel_fares_and_its_exit_code_whether_it_serves(tmp_path, capsys):
    code, out, _ = asked(tmp_path, capsys, emissions=12345, outages=2, outage_causes={"LINK": 2})
    assert code == 0
    for words in ("armed\n", "release 1.2", "for 1 d 1 h", "12,345", "outages 2 (LINK 2)"):
        assert words in out
    code, out, _ = asked(tmp_path, capsys, "--json", state="no permit", cause="look at its switch")
    said = msgspec.json.decode(out)
    assert (code, said["serves"], said["state"], said["cause"]) == (1, False, "no permit", "look at its switch")


def test_it_tells_of_a_trial_and_of_releases_that_failed(tmp_path, capsys, monkeypatch):
    layout = Layout(tmp_path / "device")
    monkeypatch.setenv("HAPTIC_PANEL_ROOT", str(layout.root))
    layout.state.mkdir(parents=True)
    layout.release("2").mkdir(parents=True)
    layout.current.symlink_to("releases/2")
    for name, words in {"trial": "2", "tries": "1", "failed": "1.9\n1.8"}.items():
        (layout.state / name).write_text(f"{words}\n")
    _, out, _ = asked(tmp_path, capsys)
    assert "release in use: 2, on trial, start 1, not tried again: 1.9, 1.8;" in out
    said = msgspec.json.decode(asked(tmp_path, capsys, "--json")[1])
    assert (said["updates"]["trial"], said["updates"]["failed"]) == ("2", ["1.9", "1.8"])


@each_row(
    ("fields", "words"),
    [
        ({"ended": True}, "the service has ended"),
        ({"pid": 2**22 + 1, "written_s": time.monotonic() - 100}, "s ago: the service hangs, or was killed"),
        ({"boot": "another"}, "before the computer was started"),
    ],
)
def test_without_a_service_it_says_what_to_do(tmp_path, capsys, fields, words):
    fields = {"pid": 2**22 + 1} | fields
    code, out, err = asked(tmp_path, capsys, **fields)
    assert code == 69
    assert words in err
    assert "systemctl start haptic-panel" in err
    assert out.startswith("NOT NOW: ")


def test_a_service_that_hangs_does_not_serve(tmp_path, capsys):
    code, out, _ = asked(tmp_path, capsys, written_s=time.monotonic() - STALE_S - 1)
    assert code == 1
    assert "the service hangs" in out


def test_without_a_file_it_says_what_to_do(tmp_path, capsys):
    assert main(["status", "--file", str(tmp_path / "none.json")]) == 69
    assert "no service runs: there is no " in capsys.readouterr().err


@given(st.one_of(st.binary(max_size=300), st.recursive(st.none() | st.integers() | st.text(), st.lists).map(msgspec.json.encode)))
def test_what_is_no_status_is_refused_in_one_line(tmp_path_factory, data):
    file = tmp_path_factory.mktemp("s") / "status.json"
    file.write_bytes(data)
    with pytest.raises(ControllerError, match="is no status") as refused:
        read_status(file)
    assert "\n" not in str(refused.value)


def test_statuses_of_later_releases_are_read_those_of_another_format_are_not(tmp_path):
    file = tmp_path / "status.json"
    file.write_bytes(msgspec.json.encode(statuses(of_a_later_release=1)))
    assert isinstance(read_status(file), PanelStatus)
    file.write_bytes(msgspec.json.encode(statuses(format=2)))
    with pytest.raises(ControllerError, match="format"):
        read_status(file)
    file.write_bytes(msgspec.json.encode(statuses()) + b" " * BYTES_MAX + b"x")
    assert read_status(file).release == "1.2"
