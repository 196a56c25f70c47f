"""Effects as designers' files, and back: times within 1 ms and amplitudes within 1 % (here: 1 us and 0.001)."""

import json
import tomllib
from itertools import accumulate
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import each_row

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.scene.effects.effects import MIN_AMPLITUDE
from controller.device.scene.effects.trains import Train
from controller.workshop.clips.exporting import WRITERS, exported
from controller.workshop.clips.importing import READERS, imported
from controller.workshop.clips.rhythm import rhythm_of

FILES = sorted(file for file in (Path(__file__).parent / "files").iterdir() if file.suffix in READERS)
BOARD = load_board(find_board("simulated"))
LEAST_MS = 2.0


def returned(folder, pulses, *suffixes):
    """Pulses [ms, amplitude] that went through files of these kinds, one after the other."""
    for suffix in suffixes:
        rhythm = tuple((at_ms * 1e-3, amplitude) for at_ms, amplitude in pulses)
        text, _ = exported("clip", Train(1.0, len(rhythm), LEAST_MS * 1e-3, rhythm[0][0], (), rhythm), suffix)
        (folder / f"clip{suffix}").write_text(text)
        pulses, report = rhythm_of(READERS[suffix](folder / f"clip{suffix}"), LEAST_MS, 50, 150)
        assert (report.taps_kept, report.wanted, report.silent) == (len(rhythm), 0, 0)
    return pulses


def close(found, pulses):
    assert [at_ms for at_ms, _ in found] == pytest.approx([at_ms for at_ms, _ in pulses], abs=2e-3, rel=0)
    assert [level for _, level in found] == pytest.approx([level for _, level in pulses], abs=1e-3)


intervals = st.lists(st.floats(LEAST_MS + 0.001, 5000).map(lambda ms: round(ms, 3)), min_size=1, max_size=30)


@given(intervals, st.data())
def test_pulses_come_back_from_either_file_and_from_one_by_way_of_the_other(tmp_path_factory, waits_ms, data):
    amplitudes = data.draw(
        st.lists(st.floats(MIN_AMPLITUDE, 1).map(lambda level: round(level, 3)), min_size=len(waits_ms), max_size=len(waits_ms))
    )
    first_ms = data.draw(st.sampled_from([0.0, waits_ms[0]]))
    pulses = [[round(at_ms - first_ms, 3), level] for at_ms, level in zip(accumulate(waits_ms), amplitudes, strict=True)]
    folder = tmp_path_factory.getbasetemp()
    for way in ((".ahap",), (".haptic",), (".ahap", ".haptic", ".ahap"), (".haptic", ".ahap", ".haptic")):
        close(returned(folder, pulses, *way), pulses)


@each_row("file", FILES, ids=lambda file: file.name)
def test_each_shipped_clip_comes_back_from_either_file(file, tmp_path):
    text, _ = imported([file], BOARD, "command", 50, 150)
    (effect,) = tomllib.loads(text)["effects"].values()
    for way in ((".ahap",), (".haptic",), (".ahap", ".haptic", ".ahap")):
        close(returned(tmp_path, effect["pulses"], *way), effect["pulses"])


@pytest.mark.parametrize("suffix", WRITERS)
def test_a_train_with_an_envelope_is_written_as_it_is_played(suffix, tmp_path):
    train = Train(1.0, 11, 0.01, 0.005, ((0.0, 0.0), (0.1, 1.0)))
    text, figures = exported("swell", train, suffix)
    (tmp_path / f"a{suffix}").write_text(text)
    pulses, _ = rhythm_of(READERS[suffix](tmp_path / f"a{suffix}"), LEAST_MS, 50, 150)
    close(pulses, [[15 + 10 * k, 0.15 + 0.1 * k] for k in range(9)] + [[105, 1.0]])
    assert figures == {"effect": "swell", "pulses": 10, "silent": 1, "length_ms": 105.0}


def test_the_command_writes_a_new_file_and_says_what_is_in_it(tmp_path, capsys):
    out = tmp_path / "beat.haptic"
    assert main(["effect", "export", "heartbeat", "--out", str(out)]) == 0
    assert "heartbeat: " in capsys.readouterr().out
    assert json.loads(out.read_text())["metadata"]["description"] == "heartbeat"
    before = out.read_text()
    assert main(["effect", "export", "click", "--out", str(out)]) == 78
    assert "exists already" in capsys.readouterr().err
    assert out.read_text() == before
    assert main(["effect", "import", str(out)]) == 0


@each_row(
    ("arguments", "code", "said"),
    [
        (["heartbeat", "--out", "a.wav"], 2, "--out a.wav: .wav cannot be written; there are: .ahap, .haptic"),
        (["heartbeat", "--out", "a"], 2, "a file without a suffix cannot be written"),
        (["hartbeat", "--out", "a.ahap"], 78, "did you mean heartbeat?"),
        (["texture", "--out", "a.ahap"], 78, "no effect 'texture' that is played over time"),
        (["heartbeat", "--out", "none/a.ahap"], 1, "cannot be written (No such file or directory)"),
    ],
)
def test_what_cannot_be_exported_is_refused_in_one_line(arguments, code, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["effect", "export", *arguments]) == code
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert said in err
    assert not list(tmp_path.iterdir())


def test_an_effect_that_is_too_long_for_a_file_is_refused(tmp_path, capsys):
    scene = tmp_path / "s.toml"
    scene.write_text(
        '[effects.long]\nwhen = "command"\nrate_hz = 100\ncount = 4001\n[[regions]]\nname = "r"\nshape = "plate"\neffects = []\n'
    )
    assert main(["effect", "export", "long", "--scene", str(scene), "--out", str(tmp_path / "a.ahap")]) == 78
    assert "has 4,001 pulses, a file 4,000 at most" in capsys.readouterr().err
