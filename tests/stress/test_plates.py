"""Plates from 30 x 20 x 0.2 mm to a floor of 4 x 3 m x 20 mm; points on, near and beyond the edge, on actuators, on nodal lines."""

import itertools
import math

import msgspec
import numpy as np
import pytest
from stress.boards import changed, focus_on, scaled
from tables import each_row

from controller.cli import main
from controller.device.bank.inspection import verify_bank
from controller.device.bank.packing import channel_bits, drive_words
from controller.device.bank.reader import Bank
from controller.device.board.panel import Actuator
from controller.device.board.relations.bending_waves import bending_wavelength_m
from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.physics.focusing import focus
from controller.workshop.physics.modes.plate_modes import modes_of
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel

LONG = pytest.mark.stress
SMALL, FLOOR = (30.0, 20.0, 0.2), (4000.0, 3000.0, 20.0)


def panel_of(board, size_mm, **waveform):
    """A plate of that length, width and thickness with eight patches, an eighth of its width from the sides."""
    length, width, thickness = size_mm
    size = width / 12
    places = [
        (u * length, v * width)
        for u, v in ((0.13, 0.14), (0.45, 0.12), (0.77, 0.15), (0.9, 0.43), (0.82, 0.87), (0.5, 0.88), (0.21, 0.86), (0.09, 0.55))
    ]
    patches = tuple(Actuator(channel=n, x_mm=x, y_mm=y, size_mm=size, idle=n % 2) for n, (x, y) in enumerate(places))
    plate = {"length_mm": length, "width_mm": width, "thickness_mm": thickness}
    table = msgspec.convert(msgspec.to_builtins(board.plate) | plate, type(board.plate))
    return changed(msgspec.structs.replace(board, plate=table, actuators=patches), waveform=waveform)


@pytest.mark.parametrize(
    ("size_mm", "waveform"),
    [
        (SMALL, {}),
        pytest.param((30.0, 20.0, 0.2), {"band_low_hz": 100e3, "band_high_hz": 200e3}, marks=LONG),
        pytest.param((600.0, 400.0, 1.0), {}, marks=LONG),
        pytest.param(FLOOR, {"band_low_hz": 1e3, "band_high_hz": 8e3, "bit_clock_hz": 100e3, "duration_ms": 10.0}, marks=LONG),
    ],
)
def test_a_plate_of_any_size_has_a_bank_a_focus_and_a_twin_that_agree(board, tmp_path, size_mm, waveform):
    panel = panel_of(board, size_mm, **waveform)
    middle_hz = (panel.waveform.band_low_hz + panel.waveform.band_high_hz) / 2
    waves_m = bending_wavelength_m(panel.plate, middle_hz)
    pitch_m = min(panel.plate.width_m / 5, 20 * waves_m)
    roomy = changed(panel, limits={"max_edge_rate_hz": panel.waveform.bit_clock_hz, "min_pulse_us": 0.4})
    report = build_bank(BankRequest(roomy, tmp_path / "bank", pitch_m))
    assert report.modes == modes_of(panel).count
    assert verify_bank(tmp_path / "bank")["cells"] == report.cells
    twin = PlateTwin(panel)
    with Bank.open(tmp_path / "bank", roomy) as bank:
        for cell in (0, bank.grid.cells // 2):
            x_m, y_m = bank.grid.place(cell)
            words = np.frombuffer(bank.drive.words(cell), "<u4")
            reached, best = float(emit(twin, words).at([(x_m, y_m)])[0]), twin.reference_amplitude(x_m, y_m)
            assert reached == pytest.approx(best, rel=1e-3), "float32 and 8 bits against float64"
            assert reached != pytest.approx(1.01 * best, rel=1e-3)
    _, (row,) = focus_on(panel, [(0.4 * panel.plate.length_m, 0.55 * panel.plate.width_m)])
    assert 0.3 * waves_m < row["spot_mm"] * 1e-3 < 0.8 * waves_m
    assert row["spot_wavelengths"] == pytest.approx(row["spot_mm"] * 1e-3 / waves_m, rel=1e-9)
    assert row["relative_amplitude"] == pytest.approx(1, abs=1e-6)
    assert math.isfinite(row["contrast"])  # eight patches focus a small plate, and a floor hardly


def test_the_largest_plate_that_is_allowed_is_refused_in_one_line_where_it_has_too_many_modes(board):
    with pytest.raises(ConfigError, match="more than 30000 modes below 100000 Hz: too large or too thin"):
        focus_on(panel_of(board, (4000.0, 3000.0, 5.0)), [(1.0, 1.0)])


def nodal_points(board):
    """On lines where a mode has no displacement, in the very middle, on patches, on and next to the edge."""
    length, width = board.plate.length_m, board.plate.width_m
    lines = [(length / m, width / n) for m, n in itertools.product((2, 3, 7), (2, 5))]
    patches = [(a.x_mm * 1e-3, a.y_mm * 1e-3) for a in board.actuators[:6]]
    edge = [
        (np.nextafter(0, 1), width / 2),
        (1e-300, 1e-300),
        (1e-12, width / 3),
        (np.nextafter(length, 0), width / 2),
        (length - 1e-9, width - 1e-9),
    ]
    return lines + patches + [(float(x), float(y)) for x, y in edge]


@pytest.mark.parametrize("every", [5, pytest.param(1, marks=LONG)])
def test_foci_on_nodal_lines_patches_and_next_to_the_edge_are_numbers_and_no_surprise(board, every):
    """The reference is the best there is: nobody gets more in the band, wherever the point lies."""
    thick = changed(board, plate={"thickness_mm": 5.0})
    twin = PlateTwin(thick)
    for point in nodal_points(thick)[::every]:
        field, (row,) = focus_on(thick, [point])
        assert math.isfinite(row["amplitude_um"])
        assert math.isfinite(row["contrast"])
        assert np.isfinite(field.around(point)).all()
        assert abs(row["relative_amplitude"]) == pytest.approx(1, abs=1e-5) or row["amplitude_um"] == 0, point
        assert 0 <= row["spot_mm"] <= 1e3 * (twin.scale.line_m[-1] - twin.scale.line_m[0])
    assert np.isfinite(twin.exact_amplitudes(tuple(nodal_points(thick))[:10:every])).all()


APART_M = [1e-9, *(pytest.param(apart_m, marks=LONG) for apart_m in (0.0, 5e-324, 1e-18, 1e-12, 1e-6))]


@pytest.mark.parametrize("count", [pytest.param(2, marks=LONG), 10])
@pytest.mark.parametrize("apart_m", APART_M)
def test_fingers_that_coincide_share_what_one_would_have(board, count, apart_m):
    thick = changed(board, plate={"thickness_mm": 5.0})
    twin = PlateTwin(thick)
    points = tuple((0.08 + n * apart_m, 0.06) for n in range(count))
    exact = twin.exact_amplitudes(points)
    alone = twin.reference_amplitude(0.08, 0.06)
    assert exact == pytest.approx(alone, rel=1e-3)
    _, rows = focus_on(thick, points)
    assert [row["relative_amplitude"] for row in rows] == pytest.approx([1.0] * count, rel=1e-3)


@each_row("at", [("0", "60"), ("-1", "60"), ("210", "60"), ("nan", "60"), ("inf", "60"), ("-inf", "60"), ("1e400", "60")])
def test_a_focus_on_the_edge_beyond_it_or_nowhere_is_refused_in_one_line(capsys, at):
    assert main(["focus", "--at", *at]) in (2, 78)  # argparse takes -inf for an option
    assert capsys.readouterr().err.count("\n") == 1


def test_a_focus_at_a_denormal_place_is_nothing_and_no_division_by_zero(board):
    _, (row,) = focus_on(changed(board, plate={"thickness_mm": 5.0}), [(5e-324, 0.06)])
    assert (row["amplitude_um"], row["relative_amplitude"], row["contrast"]) == (0, 0, 0)


@LONG
@pytest.mark.parametrize("drift", [-0.02, -0.005, 0.005, 0.02])
def test_a_plate_that_has_drifted_gets_less_and_one_that_has_not_gets_all(board, drift):
    """Frequencies higher by the drift (Young's modulus by twice that): the words of the plate as it was, played on it.

    At 0.5 % about 40 % are lost (boards/README.md), at 2 % nothing is left that could be felt; a mean of four points.
    """
    drifted = PlateTwin(changed(board, plate={"young_modulus_pa": board.plate.young_modulus_pa * (1 + drift) ** 2}))
    model = ResponseModel(board)
    shares = []
    for x_m, y_m in ((0.05, 0.04), (0.08, 0.06), (0.14, 0.1), (0.11, 0.075)):
        words = focus(model.drive_order_responses([(x_m, y_m)], dtype=np.float64), [1.0], board.idle_word)
        shares.append(float(emit(drifted, words).at([(x_m, y_m)])[0]) / drifted.reference_amplitude(x_m, y_m))
    assert np.isfinite(shares).all()
    low, high = (0.45, 0.8) if abs(drift) < 0.01 else (-0.25, 0.35)
    assert low < np.mean(shares) < high


def test_float32_and_float64_give_the_same_field_end_to_end(board):
    """Responses, words, pins, plate: the field of words from float32 is that from float64 to a thousandth of its crest."""
    thick = changed(board, plate={"thickness_mm": 3.0})
    model, twin = ResponseModel(thick), PlateTwin(thick)
    for point in ((0.08, 0.06), (0.15, 0.03)):
        fields, words = [], []
        for kind in (np.float32, np.float64):
            words.append(drive_words(model.drive_order_responses([point], dtype=kind)[0], thick.idle_word))
            fields.append(emit(twin, words[-1]).map(5e-3)[2])
        assert np.mean(channel_bits(words[0]) != channel_bits(words[1])) <= 1e-3
        assert np.abs(fields[0] - fields[1]).max() <= 1e-3 * np.abs(fields[1]).max()
        off = scaled(thick, 1.01, thick.plate.thickness_mm)
        other = emit(twin, drive_words(ResponseModel(off).drive_order_responses([point], dtype=np.float64)[0], thick.idle_word))
        assert np.abs(other.map(5e-3)[2] - fields[1]).max() > 1e-2 * np.abs(fields[1]).max(), (
            "a plate one per cent larger is noticed"
        )
