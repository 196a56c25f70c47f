"""Each switch of `Skips` leaves its work undone, and only that; what is said to be exact changes no output bit."""

import json
import shutil
from dataclasses import fields, replace

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.cli import main
from controller.commands.benchmark import SKIPS
from controller.device.loop.skips import ALL, Skips
from controller.workshop.benchmark.device import skipping
from controller.workshop.benchmark.device.skip_cases import CASES, PlayedContact, SkipCase
from controller.workshop.benchmark.device.skipping import NONE, exact_bits, figures

OF = {case.name: case for case in CASES}
SHORT_S = 0.52  # ends in the middle of a beat of the fixed emitters


@pytest.fixture(autouse=True)
def no_reference(monkeypatch):
    monkeypatch.setattr("controller.workshop.simulation.simulated_run.REFERENCE_ROUNDS", 1)


@pytest.fixture(scope="module")
def skipped():
    """Figures of cases with all skipping, by name."""
    return {}


def short(name):
    """A case whose fingers are lifted early."""
    case = OF[name]
    return replace(case, contacts=tuple(replace(contact, end_s=contact.start_s + SHORT_S) for contact in case.contacts))


KEYBOARD = replace(OF["keyboard"], contacts=OF["keyboard"].contacts[:8])
STILL = (KEYBOARD, OF["idle"], short("four always-on spots"))


def test_the_command_names_every_switch():
    assert tuple(field.name for field in fields(Skips)) == SKIPS


def test_the_cases_that_say_so_have_fingers_that_do_not_move():
    assert {case.name for case in CASES if case.equal_bits} == {case.name for case in STILL}


@each_row("case", STILL, ids=lambda case: case.name)
def test_exact_skipping_changes_no_output_bit_where_no_finger_moves(board, bank_file, case):
    assert exact_bits(board, bank_file, case)


def test_without_any_skipping_everything_is_composed_and_sent_for_itself(board, bank_file):
    done, without = (figures(board, bank_file, short("ten free fingers"), skips) for skips in (ALL, NONE))
    assert without["waveforms_sent"] == without["composed"] == without["emissions"] == without["fingers_and_spots_served"]
    assert without["from_the_bank"] == without["resident_plays"] == without["sent_ahead"] == 0
    assert done["fingers_and_spots_served"] == without["fingers_and_spots_served"]
    assert done["emissions"] < without["emissions"] / 5, "ten fingers share an emission"
    assert done["pages_of_the_bank"] < without["pages_of_the_bank"]
    assert done["bytes_on_the_wire"] < without["bytes_on_the_wire"] / 5


@each_row(
    ("off", "case", "figure"),
    [
        ("resident", KEYBOARD, "resident_plays"),
        ("cells", KEYBOARD, "from_the_bank"),
        ("ahead", short("slider"), "sent_ahead"),
        ("near", short("slider"), "of_a_place_near_by"),
    ],
    ids=lambda value: value if isinstance(value, str) else value.name,
)
def test_a_switch_ends_what_it_is_named_for(board, bank_file, off, case, figure, skipped):
    if off == "cells":  # keys within 1 mm of the cells of this coarse bank, none within the board's own 0.25
        board = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, snap_mm=1.0))
        skipped.pop(case.name, None)
    if case.name not in skipped:
        skipped[case.name] = figures(board, bank_file, case, ALL)
    assert skipped[case.name][figure] > 0
    assert figures(board, bank_file, case, replace(ALL, **{off: False}))[figure] == 0


def test_fixed_emitters_are_sent_beat_by_beat_once_the_fpga_does_not_repeat_them(board, bank_file):
    case = short("four always-on spots")
    done, without = (figures(board, bank_file, case, skips) for skips in (ALL, replace(ALL, repeated=False)))
    assert done["fingers_and_spots_served"] == 4, "accepted once"
    assert without["fingers_and_spots_served"] == 4 * without["emissions"]
    assert np.array_equal(done["words"], without["words"])


def test_outputs_that_stay_armed_need_heartbeats(board, bank_file):
    done, without = (figures(board, bank_file, OF["idle"], skips) for skips in (ALL, replace(ALL, idle=False)))
    assert without["outputs_on_s"] > 5 * done["outputs_on_s"]
    assert without["heartbeats"] > 5 * done["heartbeats"]
    assert np.array_equal(done["words"], without["words"])


@pytest.mark.slow
def test_the_command_prints_every_case_and_fails_if_bits_differ_that_must_not(capsys, bank_file, monkeypatch):
    monkeypatch.setattr(skipping, "build_bank", lambda request: shutil.copy(bank_file, request.path))
    on_a_cell = SkipCase("one tap", "plate", (PlayedContact(0.0, 0.1, lambda _: (100.0, 74.0)),), True)
    monkeypatch.setattr(skipping, "CASES", (on_a_cell,))
    assert main(["benchmark", "skipping", "--repeats", "1"]) == 0
    assert "output bits, exact skipping against none: equal (must be equal)" in capsys.readouterr().out
    monkeypatch.setattr(skipping, "EXACT", ("cells",))
    assert main(["benchmark", "skipping", "--repeats", "1", "--json", "--no-skip", "cells"]) == 1, (
        "a cell's own words are not the composed ones"
    )
    reported = json.loads(capsys.readouterr().out)["cases"][0]
    assert reported["switched_off"] == ["cells"]
    assert not reported["exact_bits"]
    assert 0 < reported["other_bits"] < 0.05
