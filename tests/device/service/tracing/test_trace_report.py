"""A trace in plain words: each cause of a late pulse is named with its share; what is no trace is one line."""

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.cli import main
from controller.device.loop.rings.trace_ring import StartRecord, TurnRecord
from controller.device.service.tracing.trace_file import END, events_of, head_of
from controller.device.service.tracing.trace_report import figures_of, read_trace
from controller.errors import ConfigError

T_S, WIRE_S, HOST_S = 2e-3, 1.4e-3, 0.1e-3


def pulse(due_s, *, begun_s=None, host_s=HOST_S, wire_s=WIRE_S, start_s=None):
    """A pulse whose turn began an upload and 0.7 ms before, or at `begun_s`."""
    begun_s = due_s - WIRE_S - 0.7e-3 if begun_s is None else begun_s
    ready_s = begun_s + host_s + wire_s
    start_s = max(ready_s, due_s) if start_s is None else start_s
    return StartRecord(due_s, ready_s, start_s, host_s / 2, host_s / 2, wire_s, 1, pulse=True, resident=False, by_clock=False)


def turn(began_s, ended_s, due=1):
    return TurnRecord(began_s, ended_s, -1.0, due, started=False)


USUAL = [pulse(1.0 + 0.02 * n) for n in range(20)]


def written(folder, records, reason="a pulse was late"):
    events = "".join(f",\n{event}" for record in records for event in events_of(record, 1.0, T_S))
    (folder / "t.json").write_text(head_of(reason, "simulated", "1.0") + events + END)
    return folder / "t.json"


@each_row(
    ("records", "late_ms", "parts_ms"),
    [
        ([pulse(2.0, begun_s=2.003)], 4.5, {"begun too late, with no turn in the way": 4.5}),
        ([turn(1.99, 2.003), pulse(2.0, begun_s=2.003)], 4.5, {"the loop was busy with other turns": 4.5}),
        ([turn(1.99, 2.001), pulse(2.0, begun_s=2.003)], 4.5,
         {"the loop was busy with other turns": 2.5, "begun too late, with no turn in the way": 2.0}),
        ([pulse(2.0, host_s=5.1e-3)], 4.4, {"the host took longer than usual": 4.4}),
        ([pulse(2.0, wire_s=6.4e-3)], 4.4, {"the wire took longer than usual": 4.4}),
        ([pulse(2.0, start_s=2.0035)], 3.5, {"the plate was still playing": 3.5}),
        ([pulse(2.0, begun_s=2.0, start_s=2.004)], 4.0,
         {"begun too late, with no turn in the way": 1.5, "the plate was still playing": 2.5}),
    ],
)  # fmt: skip
def test_each_cause_of_a_late_pulse_is_named_with_its_share(records, late_ms, parts_ms, tmp_path):
    figures = figures_of(read_trace(written(tmp_path, [*USUAL, *records])))
    (explained,) = figures["explained"]
    assert explained["late_ms"] == pytest.approx(late_ms, abs=0.01)
    assert explained["parts_ms"] == pytest.approx(parts_ms, abs=0.01)
    assert sum(explained["parts_ms"].values()) == pytest.approx(late_ms, abs=0.01)


def test_a_trace_without_a_late_pulse_says_so(tmp_path, capsys):
    file = written(tmp_path, [turn(1.0, 1.0002, due=0), *USUAL], "it was asked for (SIGUSR1)")
    assert main(["trace", str(file)]) == 0
    out = capsys.readouterr().out
    assert "written because: it was asked for (SIGUSR1) (board 'simulated', release 1.0)" in out
    assert "1 turns of the loop, the longest 0.2 ms; 20 emissions, 20 of them pulses" in out
    assert "no pulse was more than 2 ms late; the latest: 0 ms" in out


def test_a_late_pulse_is_explained_in_a_sentence_and_for_machines(tmp_path, capsys):
    file = written(tmp_path, [*USUAL, turn(1.9, 1.95), turn(2.003, 2.0045), pulse(2.0, begun_s=2.003)])
    assert main(["trace", str(file)]) == 0
    out = capsys.readouterr().out
    assert "1 pulses were more than 2 ms late; the latest:" in out
    assert "due at 1,000.000 ms, 4.5 ms late: begun too late, with no turn in the way for 4.5 ms" in out
    assert main(["trace", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["pulses_late"] == 1


@each_row(
    ("content", "said"),
    [
        (None, "cannot be read (No such file or directory)"),
        ("", "is no trace of a panel"),
        ("[]", "is no trace of a panel"),
        ('{"traceEvents": []}', "has no turns of a panel's loop"),
        ('{"traceEvents": [{"name": "turn", "ph": "X", "ts": "a"}]}', "is no trace of a panel"),
        ('{"traceEvents": [{"name": "turn", "ph": "X", "args": 5}]}', "is no trace of a panel"),
    ],
)
def test_what_is_no_trace_is_one_line(content, said, tmp_path, capsys):
    file = tmp_path / "t.json"
    if content is not None:
        file.write_text(content)
    assert main(["trace", str(file)]) == 78
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith(f"haptic-panel: {file}: ")
    assert said in err


@given(st.data())
def test_a_damaged_trace_is_read_or_refused(tmp_path_factory, data):
    file = written(tmp_path_factory.getbasetemp(), [*USUAL[:3], turn(1.0, 1.1)])
    damaged = bytearray(file.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(damaged) - 1))
        damaged[place : place + data.draw(st.integers(0, 9))] = data.draw(
            st.sampled_from([b"", b"-", b"1e99", b"null", b'"', b"\xff"])
        )
    file.write_bytes(damaged)
    with contextlib.suppress(ConfigError):
        json.dumps(figures_of(read_trace(file)), allow_nan=False)
