"""Whether the truth lies within the intervals that banks state as often as they say, on plates that they were not fitted to."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_plate import WHOLE, small_board
from tables import each_row
from threadpoolctl import threadpool_limits
from workshop.tolerance.expectation_fit import fit

from controller.cli import main
from controller.device.bank import expectation
from controller.device.board.records import load_toml
from controller.workshop.tolerance.coverage import coverage, drawn_from, record_of
from controller.workshop.tolerance.tolerances import SHIPPED, Tolerances
from controller.workshop.tolerance.unseen import KINDS, PlateRecord

BOARD = small_board()
STUDY = drawn_from(BOARD, load_toml(SHIPPED, Tolerances))
# Of the plates whose numbers stand first, in float32: as `tolerance --intervals` finds them in half an hour of a core
KEPT = {int(number): record_of(np.array(values)) for number, *values in np.load(Path(__file__).with_name("unseen.npy"))}
LEAST, MOST = 0.93, 0.97  # of 95 times in 100


def within(records, name):
    return coverage(BOARD, records, [name])[name]["all"]["within"]


@each_row("name", ["bare plate", "finger"])
def test_the_truth_lies_within_as_often_as_is_stated(name):
    assert LEAST <= within(KEPT.values(), name) <= MOST


@each_row("name, by", [("bare plate", 0.9), ("bare plate", 1.1), ("finger", 0.8), ("finger", 1.2)])
def test_it_would_not_if_plates_did_less_or_more(name, by):
    others = [one._replace(free_um=one.free_um * by, felt_um=one.felt_um * by) for one in KEPT.values()]
    assert within(others, name) < LEAST


def test_a_bank_that_may_be_of_another_plate_never_promises_too_much():
    found = coverage(BOARD, KEPT.values())
    for name in found:
        if name.startswith(("bank of another", "model's")):
            assert found[name]["all"]["within"] > 0.97, name
            assert found[name]["all"]["width"] is None
    felt = [one.model_free_um / one.model_middle_um for one in KEPT.values() if KINDS[int(one.kind)] != "simply supported"]
    assert np.median(felt) < 0.2, "and there is a reason not to"


def test_what_was_not_played_is_not_counted():
    found = coverage(BOARD, [one._replace(other_free_um=math.nan, other_felt_um=math.nan) for one in KEPT.values()])
    assert "finger" in found
    assert not any(name.startswith("bank of another") for name in found)


def same(number):
    """Whether a plate is what it was when it was kept; rounding of linear algebra apart."""
    with threadpool_limits(1, "blas"):
        found = STUDY.record(number)
    for name, one, other in zip(PlateRecord._fields, found, KEPT[number], strict=True):
        assert one == pytest.approx(other, rel=2e-2, abs=2e-3, nan_ok=True), name


def test_the_command_plays_the_plates_that_were_kept(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    assert main(["tolerance", "--intervals", "1", "--json"]) == 0
    of_all = json.loads(capsys.readouterr().out)["intervals"]["finger"]["all"]
    assert of_all["plates"] == 1
    assert of_all["within"] == within([KEPT[0]], "finger")
    assert main(["tolerance", "--intervals", "1"]) == 0
    assert "finger of known mass" in capsys.readouterr().out
    assert main(["tolerance", "--intervals", "0"]) == 2


@pytest.mark.slow
@each_row("number", range(2 * len(KINDS)))
def test_plates_are_what_they_were_when_they_were_kept(number):
    same(number)


@pytest.mark.slow
def test_a_plate_does_the_same_without_banks_of_others():
    alone, besides = (replace(STUDY, others=others).record(1)._asdict() for others in (False, True))
    assert {name for name in alone if alone[name] != besides[name]} == {"other_free_um", "other_felt_um"}


@pytest.mark.slow
def test_constants_are_those_of_plates_drawn_from_tolerances():
    with threadpool_limits(1, "blas"):
        corner, whole = fit(BOARD, STUDY.tolerances), fit(WHOLE, STUDY.tolerances, plates=3, places=10)
    for name, of_corner in corner.items():
        stated = getattr(expectation, name.upper())
        print(f"{name}: {stated:g} stated, {of_corner:.3f} on the corner, {whole[name]:.3f} on the whole plate")
        assert stated == pytest.approx(of_corner, rel=0.2)
        if name in {"detuned", "felt_detuned", "foci", "bare", "resists", "inert", "absorbs", "beside"}:
            assert stated == pytest.approx(whole[name], rel=0.25)
        else:
            assert whole[name] < 1.2 * stated
    assert math.exp(expectation.BARE) == pytest.approx(0.314, abs=0.01)
