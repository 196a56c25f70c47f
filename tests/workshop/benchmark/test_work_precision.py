"""The benchmark as a whole, on a coarse grid with few methods: its figures, their schema, its diagrams and command."""

import json
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from worker_functions import few_methods, plain_methods

from controller.cli import main
from controller.commands import benchmark as command
from controller.commands.common.tables import benchmark_table
from controller.errors import ConfigError
from controller.workshop.benchmark import baselines, plate_under_test, scene_errors
from controller.workshop.benchmark import work_precision as module
from controller.workshop.benchmark.device.interleaved import interleaved
from controller.workshop.benchmark.fingers_scenes import scenes, still
from controller.workshop.benchmark.methods import registry
from controller.workshop.benchmark.methods.laboratory import Laboratory
from controller.workshop.benchmark.pareto import cost, front
from controller.workshop.benchmark.scene_errors import Effort
from controller.workshop.benchmark.work_precision import work_precision
from controller.workshop.benchmark.work_precision_diagrams import DIAGRAMS, draw_all
from controller.workshop.workers.kept_file import KeptFile
from controller.workshop.workers.workers import Workers

SCHEMA = json.loads(Path(__file__).with_name("work_precision.schema.json").read_text())
EFFORT = Effort(each=1, random_scenes=1, tabled_scenes=1, timed_scenes=1, turns=2, longest_s=1e3, slow_methods=False)


@pytest.fixture(scope="module")
def coarse(small_board):
    return msgspec.structs.replace(small_board, bank=msgspec.structs.replace(small_board.bank, pitch_mm=10.0))


@pytest.fixture(scope="module", autouse=True)
def hasty():
    """Neither the bounds of many fingers nor the machine's best rate are the subject here, and both take long."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(plate_under_test, "bound", lambda _unit: 1.0)
        patched.setattr(baselines, "best_sgemm_rate", lambda: 1e10)
        yield


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    return tmp_path_factory.mktemp("kept")


@pytest.fixture(scope="module")
def figures(coarse, kept):
    return work_precision(coarse, EFFORT, seed=5, kept=kept, candidates=few_methods)


def test_figures_are_as_the_schema_says(figures):
    import jsonschema  # a second of each process that imports it

    jsonschema.validate(json.loads(json.dumps(figures, allow_nan=False)), SCHEMA)
    broken = {**figures, "settings": [{**figures["settings"][0], "time_us": 3}]}
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(broken, SCHEMA)


def flat(figures):
    """Every error but those that depend on which methods are compared."""
    return {
        (setting["curve"], family, error, kind): value
        for setting in figures["settings"]
        for family, errors in setting["families"].items()
        for error, found in errors.items()
        for kind, value in found.items()
        if error not in ("best_loss", "felt_loss")
    }


def test_errors_are_the_same_for_a_seed(coarse, figures, tmp_path):
    again = work_precision(coarse, EFFORT, 5, kept=tmp_path, timing=False, candidates=lambda some: few_methods(some)[:2])
    assert flat(again) == pytest.approx({name: value for name, value in flat(figures).items() if name in flat(again)}, rel=1e-6)
    assert len(flat(again)) > 200
    assert not any(setting["time_us"] for setting in again["settings"])
    assert again["baselines"] == again["building"] == []


def test_processes_keep_the_same_bytes_and_what_is_kept_is_not_computed_again(coarse, figures, kept, tmp_path):
    def records(folder):
        with KeptFile.open(next(folder.glob(module.KEPT))) as file:
            return file.results

    given = {"timing": False, "candidates": few_methods}
    by_two = work_precision(coarse, EFFORT, 5, kept=tmp_path, workers=Workers(2), **given)
    assert records(tmp_path) == records(kept)
    assert sum(share["items"] for worker, share in by_two["workers"].items() if worker != "kept") == len(records(kept))
    again = work_precision(coarse, EFFORT, 5, kept=kept, **given)
    assert again["workers"] == {"kept": len(records(kept))}
    assert flat(again) == flat(figures)


def test_the_full_field_loses_nothing_alone_and_the_nearest_of_coarse_cells_much(figures):
    entry, *_, exact = figures["settings"]
    assert entry["curve"] == "nearest entry"
    assert abs(exact["families"]["1 off grid"]["loss"]["worst"]) < 1e-9
    assert entry["families"]["1 off grid"]["loss"]["worst"] > 0.3
    assert "2 off grid" not in entry["families"]
    assert exact["families"]["1 at +0.5 % drift"]["loss"]["median"] > 0.02
    assert set(exact["time_us"]) == {"1", "2", "4", "10"}


def test_fronts_name_settings_that_none_beats(figures):
    for name, indices in figures["fronts"].items():
        axis, _, family = name.partition(", ")
        assert indices == front(figures["settings"], axis, family)
        costs = [cost(figures["settings"][index], axis, family) for index in indices]
        assert costs == sorted(costs)


def test_every_diagram_has_its_curves(figures):
    for name, draw in DIAGRAMS.items():
        figure = draw(figures)
        if name == "building":
            assert len(figure.axes[0].lines) == 3
            continue
        if name == "front_page":
            assert {"nearest entry", "modal bank, baseband", "full field, float64"} <= {
                t.get_text() for ax in figure.axes for t in ax.texts
            }
            continue
        labels = {text.get_text() for ax in figure.axes for text in ax.texts}
        assert {"B", "C"} <= labels, name  # the letters of the curves
        assert len(figure.legends[0].get_texts()) == 4


@pytest.mark.slow
def test_every_diagram_is_written(figures, tmp_path):
    written = draw_all(tmp_path, figures)
    assert {path.suffix for path in written} == {".png", ".svg"}
    assert {path.stem for path in written} == set(DIAGRAMS)
    for path in written:
        assert path.stat().st_size > 10_000
    with pytest.raises(ConfigError, match="cannot be written"):
        draw_all(tmp_path / "nowhere", figures)


def test_the_command_writes_figures_and_says_where_it_cannot(coarse, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(module, "QUICK", replace(EFFORT, random_scenes=0))
    for place in (module, scene_errors):
        monkeypatch.setattr(place, "scenes", lambda *given: [scene for scene in scenes(*given) if scene.family == "1 off grid"])
    monkeypatch.setattr(registry, "METHODS", (plain_methods,))
    monkeypatch.setattr(command, "board_of", lambda _options: coarse)
    options = ["--quick", "--no-timing", "--no-pictures", "--json", "--workers", "1", "--out"]
    assert main(["benchmark", *options, str(tmp_path / "out")]) == 0
    assert not list((tmp_path / "out").glob(module.KEPT)), "they are in the results"
    shown = json.loads(capsys.readouterr().out)
    assert shown == json.loads((tmp_path / "out" / "work_precision.json").read_text())
    assert shown["seed"] == 1
    (tmp_path / "file").write_text("")
    assert main(["benchmark", "--out", str(tmp_path / "file")]) == 78
    assert "another folder" in capsys.readouterr().err


def test_every_method_gives_words(small_board):
    places = [(0.0417, 0.0332), (0.0603, 0.0471)]
    quiet = (0.05, 0.02)
    laboratory = Laboratory(small_board, still("1 off grid", places, quiet).needed)
    methods = [method for method in registry.all_candidates(laboratory) if not method.slow]
    laboratory.prepare(places)
    said = {}
    assert len({(method.curve, method.setting) for method in methods}) == len(methods)
    for method in methods:
        points = [(*place, 1.0) for place in places[: method.most_fingers]]
        words = method.words_of(method.run(points, quiet))
        said[method.curve, method.setting] = words.tolist()
        assert words.dtype == "u4"
        assert 0 < len(words) <= small_board.waveform.samples
        assert method.memory_bytes > 0
        assert method.wire_bytes in {72} or method.wire_bytes > 4 * len(words)
    pitch = f"{small_board.bank.pitch_mm:g} mm"
    assert said["device, another finger still", pitch] != said["device, compiled kernel", pitch], "the bank has its pad"


def test_the_table_has_the_front_of_each_number_of_fingers(figures):
    text = benchmark_table(figures)
    for fingers in ("1", "10"):
        front = [figures["settings"][index]["curve"] for index in figures["fronts"][f"time, {fingers} off grid"]]
        part = text.partition(f"{fingers} fingers, front")[2].partition("fingers, front")[0]
        assert [line[:34].strip() for line in part.splitlines()[1:] if line.startswith(tuple(front))] == front
    assert "plain C composes 1000 samples, not 250" in text  # what is left out, and why


def test_jobs_take_turns():
    order = []
    timings = interleaved([[lambda: order.append("a")], [lambda: order.append("b")]], turns=5, most_s=1e3)
    assert order == ["a", "b", *("a", "a", "b", "b") * 5]
    assert [timing.calls for timing in timings] == [5, 5]
    assert all(0 <= timing.median_us <= timing.p99_us for timing in timings)
    assert interleaved([[lambda: order.append("a")]], turns=50, most_s=0)[0].calls == 3
