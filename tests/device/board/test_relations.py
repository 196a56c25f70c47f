"""Keys of board.toml that do not go together: each relation by a board that just keeps it and one that just breaks it."""

import math

import msgspec
import numpy as np
import pytest
from device.board.changed_board import changed
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device.bank.file_format import Header
from controller.device.bank.grid import Grid
from controller.device.board.board import load_board
from controller.device.board.devices import ApplicationSocket, LinkedFpga, Temperature
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.panel import Compose
from controller.device.board.plate.patches import Patches
from controller.device.board.plate.plate import Damping, DecayAt
from controller.device.board.relations.bank import BANK_BYTES
from controller.device.board.relations.bending_waves import bending_wavelength_m, mindlin_shift, mindlin_wavelength_m
from controller.device.board.relations.checked import RELATIONS, judge
from controller.device.board.relations.limits import ALIVE_HZ
from controller.device.board.relations.stage import RAMP_EDGES
from controller.device.board.relations.stage_heat import passed, worst_edge_j
from controller.device.board.relations.touch_area import reached
from controller.device.fpga.build_parameters import BuildParameters
from controller.device.touch.panels.ft5x06 import Ft5x06Touch
from controller.device.touch.panels.recording import RecordingTouch
from controller.device.touch.panels.serial_panel import EloTouch
from controller.workshop.gateware.model.gate import ALIVE_HZ_4
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.responses.driver import DriverResponse

BOARD = load_board(find_board("ulx3s"))
NAMED = {relation.broken.__name__: relation for relation in RELATIONS}
WHOLE = {"x_mm_from_axes": (210.0, 0.0, 0.0), "y_mm_from_axes": (0.0, 148.0, 0.0)}
RECORDING = RecordingTouch(**WHOLE, recording="demo.evemu")
ON_I2C = Ft5x06Touch(
    **WHOLE, bus="/dev/i2c-1", interrupt_chip="pinctrl-bcm2711", interrupt_line="GPIO17", reset_line="GPIO27", width=800, height=480
)
ON_SERIAL = EloTouch(**WHOLE, device="/dev/ttyUSB1")
COLD = Temperature(kind="lm75", device="/dev/i2c-1", coefficient_per_k=-2e-4)
MADE_N_PER_V = BOARD.parts.on(BOARD.plate).moment_n_per_v
WAVE_MM = bending_wavelength_m(BOARD.plate, BOARD.waveform.band_high_hz) * 1e3
MIDDLE_MM = bending_wavelength_m(BOARD.plate, BOARD.waveform.middle_hz) * 1e3


def patch(index, **keys):
    """The board's patches, one of them with other keys."""
    patches = list(BOARD.actuators)
    patches[index] = msgspec.structs.replace(patches[index], **keys)
    return tuple(patches)


def idling(levels):
    """The board's patches, the first of them with these idle levels."""
    head = [msgspec.structs.replace(a, idle=level) for a, level in zip(BOARD.actuators, levels, strict=False)]
    return (*head, *BOARD.actuators[len(head) :])


def square_of_area(thickness_mm, of):
    """Size in mm of a patch of the board's capacitance that is so thick, of this relative permittivity."""
    return 1e3 * math.sqrt(BOARD.driver.capacitance_f * thickness_mm * 1e-3 / (8.854e-12 * of))


def thickness_at(found, wanted):
    """Thickness in mm at which a rising function of the plate reaches a value."""
    low, high = 0.05, 20.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if found(msgspec.structs.replace(BOARD.plate, thickness_mm=middle)) < wanted else (low, middle)
    return low


def capacitance_at(share):
    """Capacitance with which the driver passes this share in the middle of the band."""
    low, high = BOARD.driver.capacitance_f, 1e-6
    for _ in range(60):
        middle = math.sqrt(low * high)
        passes = passed(msgspec.structs.replace(BOARD.driver, capacitance_f=middle), BOARD.waveform.middle_hz)
        low, high = (middle, high) if passes > share else (low, middle)
    return low


HIGH = BOARD.waveform.band_high_hz
THICK_MM = thickness_at(lambda plate: plate.thickness_m / mindlin_wavelength_m(plate, HIGH), 0.3)
SHIFTED_MM = thickness_at(lambda plate: mindlin_shift(plate, HIGH), 0.05)
WIDE_MM = thickness_at(lambda plate: 0.54 * bending_wavelength_m(plate, BOARD.waveform.middle_hz), 15e-3)
BROAD_F = capacitance_at(0.5)
EDGES_HZ = 0.25 / worst_edge_j(BOARD.driver)
RAMP_MS = 53e3 * 0.25 / (500e3 * RAMP_EDGES) * 1e3
MODES_HZ = 50 * (WAVE_MM * 1e-3) ** 2 * HIGH / (math.pi * 0.21 * 0.148)
TWO = (LinkedFpga(device="/dev/spidev0.0"), LinkedFpga(device="/dev/spidev0.1"))


def cabled(*cables):
    """Two FPGAs, each with its cable."""
    return tuple(msgspec.structs.replace(one, cable=cable) for one, cable in zip(TWO, cables, strict=True))


CELLS_MM = math.sqrt(210 * 148 * 1000 * BANK_BYTES / 4e9)

# of each relation: what a board is that just keeps it, and one that just breaks it
JUST = {
    "_count": ({"actuators": BOARD.actuators[:1]}, {"actuators": ()}),
    "_channels": ({}, {"actuators": patch(3, channel=2)}),
    "_fpgas": (
        {"actuators": patch(31, channel=32), "link__fpga": TWO},
        {"actuators": patch(31, channel=64), "link__fpga": TWO},
    ),
    "_together": ({"link__fpga": TWO}, {"link__fpga": TWO, "link__kind": "serial"}),
    "_cables": (
        {"link__fpga": cabled("A", "B"), "gateware__load": ("load", "{cable}", "{bitstream}")},
        {"link__fpga": cabled("A", "A"), "gateware__load": ("load", "{cable}", "{bitstream}")},
    ),
    "_on_plate": ({"actuators": patch(0, x_mm=2.3)}, {"actuators": patch(0, x_mm=2.29)}),
    "_apart": ({"actuators": patch(0, x_mm=31.5 - 4.6)}, {"actuators": patch(0, x_mm=31.5 - 4.59)}),
    "_patches": (
        {"patches": Patches(mass_kg_m2=1.0, stiffness_ratio=2.0, shape="disc", size_mm=12.0)},
        {"patches": Patches(mass_kg_m2=1.0, stiffness_ratio=2.0, shape="disc", size_mm=50.0)},
    ),
    "_idle": ({"actuators": idling([0, 1, 1, 0])}, {"actuators": idling([1, 1, 1, 0])}),
    "_parts": ({"driver__moment_n_per_v": MADE_N_PER_V * 1.49}, {"driver__moment_n_per_v": MADE_N_PER_V * 1.51}),
    "_patch_size": (
        {"actuators": (msgspec.structs.replace(BOARD.actuators[0], x_mm=50.0, y_mm=50.0, size_mm=0.749 * WAVE_MM),)},
        {"actuators": (msgspec.structs.replace(BOARD.actuators[0], x_mm=50.0, y_mm=50.0, size_mm=0.751 * WAVE_MM),)},
    ),
    "_capacitance": (
        {"actuators": patch(0, size_mm=square_of_area(0.0501, 4000))},
        {"actuators": patch(0, size_mm=square_of_area(0.0499, 4000))},
    ),
    "_driver_band": ({"driver__capacitance_f": BROAD_F * 0.999}, {"driver__capacitance_f": BROAD_F * 1.001}),
    "_pitch": ({"bank__pitch_mm": WAVE_MM / 2 - 1e-3}, {"bank__pitch_mm": WAVE_MM / 2 + 1e-3}),
    "_cells": (
        {"plate__width_mm": 60.0, "bank__pitch_mm": 30.0, "bank__coarse": True},
        {"plate__width_mm": 59.9, "bank__pitch_mm": 30.0, "bank__coarse": True},
    ),
    "_snap": ({"bank__snap_mm": 1.767}, {"bank__snap_mm": 1.768}),
    "_bank_size": ({"bank__pitch_mm": CELLS_MM * 1.001}, {"bank__pitch_mm": CELLS_MM * 0.999}),
    "_thickness": ({"plate__thickness_mm": THICK_MM * 0.999}, {"plate__thickness_mm": THICK_MM * 1.001}),
    "_theory": ({"plate__thickness_mm": SHIFTED_MM * 0.999}, {"plate__thickness_mm": SHIFTED_MM * 1.001}),
    "_plate_in_waves": ({"plate__width_mm": 2.001 * MIDDLE_MM}, {"plate__width_mm": 1.999 * MIDDLE_MM}),
    "_focus_width": ({"plate__thickness_mm": WIDE_MM * 0.999}, {"plate__thickness_mm": WIDE_MM * 1.001}),
    "_modes": ({"waveform__band_low_hz": HIGH - 1.001 * MODES_HZ}, {"waveform__band_low_hz": HIGH - 0.999 * MODES_HZ}),
    "_decay": ({"plate__decay_time_ms": 0.667}, {"plate__decay_time_ms": 0.666}),
    "_resolved": (
        {"waveform__band_low_hz": 500.0, "waveform__band_high_hz": 700.0},
        {"waveform__band_low_hz": 500.0, "waveform__band_high_hz": 699.0},
    ),
    "_periods": ({"waveform__duration_ms": 0.2}, {"waveform__duration_ms": 0.198}),
    "_bit_ticks": ({"link__clock_hz": 2_000_000, "link__sck_hz": 10**6}, {"link__clock_hz": 1_999_999, "link__sck_hz": 900_000}),
    "_bit_period": (
        {"waveform__bit_clock_hz": 1.9e6, "waveform__duration_ms": 0.5, "temperature": COLD},
        {
            "waveform__bit_clock_hz": 1.9e6,
            "waveform__duration_ms": 0.5,
            "temperature": msgspec.structs.replace(COLD, coefficient_per_k=1e-3),
        },
    ),
    "_pulse": ({"limits__min_pulse_us": 2.0}, {"limits__min_pulse_us": 2.01}),
    "_emission": ({"limits__longest_emission_ms": 2.0}, {"limits__longest_emission_ms": 1.99}),
    "_temperatures": (
        {"temperature": COLD, "limits__longest_emission_ms": 2.03},
        {"temperature": COLD, "limits__longest_emission_ms": 2.02},
    ),
    "_coefficient": (
        {"temperature": msgspec.structs.replace(COLD, coefficient_per_k=-1e-3)},
        {"temperature": msgspec.structs.replace(COLD, coefficient_per_k=-1.01e-3)},
    ),
    "_heartbeat": (
        {"link__sck_hz": 100_000, "limits__heartbeat_timeout_ms": 82.0},
        {"link__sck_hz": 100_000, "limits__heartbeat_timeout_ms": 81.9},
    ),
    "_patience": ({"limits__heartbeat_timeout_ms": 10.0}, {"limits__heartbeat_timeout_ms": 9.9}),
    "_settle": ({"limits__hv_settle_us": 500.0}, {"limits__hv_settle_us": 499.0}),
    "_ramp_duty": ({"limits__ramp_ms": 32.2}, {"limits__ramp_ms": 32.3}),
    "_two_ramps": ({"limits__ramp_ms": 16.1}, {"limits__ramp_ms": 16.2}),
    "_ramp_edges": ({"limits__ramp_ms": RAMP_MS * 0.999}, {"limits__ramp_ms": RAMP_MS * 1.001}),
    "_ramp_speed": ({"limits__ramp_ms": 0.5}, {"limits__ramp_ms": 0.499}),
    "_heat": (
        {"limits__max_channel_edge_rate_hz": EDGES_HZ * 0.999},
        {"limits__max_channel_edge_rate_hz": EDGES_HZ * 1.001},
    ),
    "_duty_edges": ({"limits__max_channel_edge_rate_hz": 45e3}, {"limits__max_channel_edge_rate_hz": 44.9e3}),
    "_total_edges": ({"limits__max_total_edge_rate_hz": 53e3}, {"limits__max_total_edge_rate_hz": 52.9e3}),
    "_edges_of_band": ({"limits__max_edge_rate_hz": 40e3}, {"limits__max_edge_rate_hz": 39.9e3}),
    "_edges_of_waveforms": ({"limits__max_edge_rate_hz": 90e3}, {"limits__max_edge_rate_hz": 89.9e3}),
    "axes": ({"touch__x_mm_from_axes": (10.6, 0.0, 0.0)}, {"touch__x_mm_from_axes": (10.4, 0.0, 0.0)}),
    "_axes_in_part": ({"touch__x_mm_from_axes": (105.1, 0.0, 0.0)}, {"touch__x_mm_from_axes": (104.9, 0.0, 0.0)}),
    "_no_finger": (
        {"touch__no_finger_mm": ((210.0, 0.0, 10.0, 148.0),)},
        {"touch__no_finger_mm": ((210.1, 0.0, 10.0, 148.0),)},
    ),
    "_lines": ({"link__permit_line": "GPIO26"}, {"link__permit_line": "GPIO25"}),
    "_of_each": ({"link__device": "", "link__fpga": TWO}, {"link__device": "", "link__fpga": (TWO[0],) * 2}),
    "_bus_lines": ({"link__permit_line": "GPIO7"}, {"link__permit_line": "GPIO8"}),
    "_ports": (
        {"link__kind": "serial", "link__device": "/dev/ttyUSB0", "touch": ON_SERIAL},
        {"link__kind": "serial", "link__device": "/dev/ttyUSB1", "touch": ON_SERIAL},
    ),
    "_addresses": (
        {"touch": ON_I2C, "temperature": COLD},
        {"touch": ON_I2C, "temperature": msgspec.structs.replace(COLD, address=0x38)},
    ),
    "_sck": (
        {"link__spi_source_hz": 80_000_000, "link__sck_hz": 25_000_000},
        {"link__spi_source_hz": 80_000_000, "link__sck_hz": 25_000_001},
    ),
    "_serial_lines": (
        {"link__kind": "serial", "link__trigger_line": "", "link__configured_line": "", "link__permit_line": ""},
        {"link__kind": "serial", "link__trigger_line": "", "link__configured_line": ""},
    ),
    "_recording": ({"touch": RECORDING}, {"touch": msgspec.structs.replace(RECORDING, recording="")}),
    "_palms": ({"touch__max_size_mm": 148.0}, {"touch__max_size_mm": 148.1}),
    "_clients": (
        {"application_socket": ApplicationSocket(max_clients=4, clients_per_user=4)},
        {"application_socket": ApplicationSocket(max_clients=4, clients_per_user=5)},
    ),
}


@each_row("name", sorted(NAMED))
def test_each_relation_is_kept_by_one_board_and_broken_by_its_neighbour(name):
    relation = NAMED[name]
    keeps, breaks = (changed(BOARD, **keys) for keys in JUST[name])
    assert list(relation.broken(keeps)) == []
    said = list(relation.broken(breaks))
    assert said
    verdict = judge(breaks)
    assert set(said) <= set(verdict.refused if relation.refuses else verdict.odd)
    for line in said:
        assert "\n" not in line
        assert "`" not in line
        assert line.startswith(BOARD.__struct_fields__), "it begins with a key"


def test_every_relation_has_its_two_boards():
    assert sorted(JUST) == sorted(NAMED)
    assert len(NAMED) == len(RELATIONS)


def test_every_relation_has_a_rule_of_one_sentence():
    for relation in RELATIONS:
        assert relation.rule.endswith(".")
        assert "\n" not in relation.rule


@each_row("name", sorted(file.parent.name for file in data_folder("boards").glob("*/board.toml")))
def test_nothing_of_a_shipped_board_is_refused_or_odd(name):
    assert judge(load_board(find_board(name))) == ((), ())


@each_row(
    ("rows", "said"),
    [
        (((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), "put all touches onto one line or point"),
        (((210.0, 0.0, 0.0), (148.0, 0.0, 0.0)), "put all touches onto one line or point"),
        (((-210.0, 0.0, 0.0), (0.0, 148.0, 0.0)), "put every touch off the plate: x from -210 to 0 mm"),
        (((210.0, 0.0, 0.0), (0.0, -148.0, 0.0)), "put every touch off the plate"),
        (((21.0, 0.0, 0.0), (0.0, 14.8, 0.0)), "reach 1 % of the plate: x from 0 to 21 mm and y from 0 to 14.8 mm"),
        (((0.21, 0.0, 0.0), (0.0, 0.148, 0.0)), "are they in mm?"),
        (((90e3, 0.0, 0.0), (0.0, 60e3, 0.0)), "put nearly every touch off the plate"),
    ],
)
def test_axes_that_cannot_be_meant_are_refused(rows, said):
    (refused,) = judge(changed(BOARD, touch__x_mm_from_axes=rows[0], touch__y_mm_from_axes=rows[1])).refused
    assert said in refused
    assert refused.endswith("haptic-panel calibrate-touch finds the axes")


@each_row(
    "rows",
    [
        ((-210.0, 0.0, 210.0), (0.0, 148.0, 0.0)),  # mirrored
        ((0.0, 210.0, 0.0), (-148.0, 0.0, 148.0)),  # swapped, and one of them mirrored
        ((190.0, 0.0, 10.0), (0.0, 128.0, 10.0)),  # of a panel within the frame
        ((230.0, 0.0, -10.0), (0.0, 168.0, -10.0)),  # of one that reaches beyond the glass
        ((600.0, 0.0, -100.0), (0.0, 400.0, -100.0)),  # of one whose range is longer than it is used
        ((209.5, 1.5, 0.4), (-1.2, 147.6, 0.8)),  # glued on askew
    ],
)
def test_axes_of_real_panels_are_taken(rows):
    assert judge(changed(BOARD, touch__x_mm_from_axes=rows[0], touch__y_mm_from_axes=rows[1])) == ((), ())


@each_row(
    ("x_mm", "y_mm", "said"),
    [
        ((-210.0, 0.0, 148.0), (0.0, 148.0, 0.0), "are shifted: x from -62 to 148 mm"),
        ((84.0, 0.0, 63.0), (0.0, 148.0, 0.0), "reach only 40 % of the plate: x from 63 to 147 mm"),
        ((1050.0, 0.0, -420.0), (0.0, 592.0, -222.0), "put 95 % of the panel's range off the plate: x from -420 to 630 mm"),
    ],
)
def test_axes_that_are_shifted_or_reach_far_less_or_more_than_the_plate_are_odd(x_mm, y_mm, said):
    (odd,) = judge(changed(BOARD, touch__x_mm_from_axes=x_mm, touch__y_mm_from_axes=y_mm)).odd
    assert said in odd


def test_a_line_is_known_by_number_too_and_only_on_one_chip():
    assert judge(changed(BOARD, link__permit_line="25")).refused
    shared = msgspec.structs.replace(ON_I2C, reset_line="GPIO25")
    (refused,) = judge(changed(BOARD, touch=shared)).refused
    assert "touch.reset_line = 'GPIO25' is link.trigger_line already, on pinctrl-bcm2711" in refused
    elsewhere = msgspec.structs.replace(shared, interrupt_chip="another")
    assert judge(changed(BOARD, touch=elsewhere)).refused == ()


@each_row(
    ("first", "second", "link", "said"),
    [
        ({}, {"device": "/dev/spidev0.0"}, {}, "link.fpga[1].device = '/dev/spidev0.0' is link.fpga[0].device already"),
        ({}, {}, {"device": "/dev/spidev0.0"}, "link.device = '/dev/spidev0.0' is not used, as each link.fpga has its own"),
        ({"configured_line": "GPIO5"}, {}, {}, "link.fpga[1].configured_line is missing: give one to each FPGA, or to none"),
        (
            {"configured_line": "GPIO5"},
            {"configured_line": "GPIO6"},
            {"configured_line": "GPIO27"},
            "link.configured_line = 'GPIO27' is of all FPGAs, and link.fpga gives one to each",
        ),
        (
            {"configured_line": "GPIO5"},
            {"configured_line": "GPIO23"},
            {},
            "link.fpga[1].configured_line = 'GPIO23' is link.permit_line already, on pinctrl-bcm2711: the run permit would follow",
        ),
        (
            {"configured_line": "GPIO5"},
            {"configured_line": "GPIO7"},
            {},
            "link.fpga[1].configured_line = 'GPIO7' is a pin of link.fpga[1].device = '/dev/spidev0.1'",
        ),
    ],
)
def test_what_fpgas_have_of_their_own_and_what_they_share_does_not_collide(first, second, link, said):
    fpga = tuple(msgspec.structs.replace(one, **keys) for one, keys in zip(TWO, (first, second), strict=True))
    keys = {f"link__{key}": value for key, value in {"device": "", "configured_line": "", **link}.items()}
    board = changed(BOARD, link__fpga=fpga, actuators=patch(31, channel=32), gateware=None, **keys)
    (refused,) = judge(board).refused
    assert said in refused


@each_row(
    ("fpga", "load", "said"),
    [
        (TWO, ("{bitstream}",), "gateware.load names no {cable}: several FPGAs are loaded one by one"),
        ((), ("{bitstream}", "{cable}"), "gateware.load names a {cable}: those are of the FPGAs in link.fpga, and there is none"),
        (cabled("A", ""), ("{bitstream}", "{cable}"), "link.fpga[1].cable = '': each FPGA needs one of its own"),
    ],
)
def test_what_loads_several_fpgas_knows_each_by_its_cable(fpga, load, said):
    (refused,) = NAMED["_cables"].broken(changed(BOARD, link__fpga=fpga, gateware__load=load))
    assert refused.startswith(said)


@each_row(("line", "of"), [("GPIO3", "touch.bus"), ("GPIO10", "link.device"), ("11", "link.device")])
def test_a_pin_of_a_bus_is_no_line(line, of):
    (refused,) = judge(changed(BOARD, touch=ON_I2C, link__permit_line=line)).refused
    assert f"link.permit_line = {line!r} is a pin of {of}" in refused


def test_all_idle_levels_alike_are_odd_and_a_lone_channel_is_not():
    (odd,) = judge(changed(BOARD, actuators=idling([1] * 32))).odd
    assert odd.startswith("actuators: all 32 have idle = 1:")
    assert not list(NAMED["_idle"].broken(changed(BOARD, actuators=BOARD.actuators[:1])))


def test_a_pitch_that_is_chosen_for_the_scene_is_not_looked_at():
    auto = changed(BOARD, bank__pitch_mm=40.0, compose=Compose(method="auto"))
    assert judge(auto) == ((), ())


def test_an_fpga_hears_nothing_while_the_others_get_their_uploads():
    slow = {"link__fpga": (*TWO, LinkedFpga(device="/dev/spidev1.0")), "limits__heartbeat_timeout_ms": 100.0}
    assert not list(NAMED["_heartbeat"].broken(changed(BOARD, **slow, link__sck_hz=1_320_000)))
    (said,) = NAMED["_heartbeat"].broken(changed(BOARD, **slow, link__sck_hz=1_300_000))
    assert "is less than twice the 50.4 ms that the uploads to the other FPGAs take at link.sck_hz = 1300000" in said


def test_a_serial_link_has_the_times_of_its_baud_rate():
    serial = {"link__kind": "serial", "link__device": "/dev/ttyUSB0", "limits__heartbeat_timeout_ms": 250.0}
    assert not list(NAMED["_heartbeat"].broken(changed(BOARD, **serial, link__baud=41_000)))
    (said,) = NAMED["_heartbeat"].broken(changed(BOARD, **serial, link__baud=40_000))
    assert "at link.baud = 40000" in said


def test_a_drive_word_may_be_as_short_as_the_shortest_pulse_when_the_plate_is_warm():
    clock_hz = BOARD.link.clock_hz
    scales = [COLD.scale(COLD.lowest_c), COLD.scale(COLD.highest_c)]
    shortest = min(int(clock_hz / BOARD.waveform.bit_clock_hz / scale) for scale in scales)
    longer = changed(BOARD, temperature=COLD, limits__longest_emission_ms=2.1)
    for ticks, refused in ((shortest, 0), (shortest + 1, 1)):
        limited = changed(longer, limits__min_pulse_us=ticks / (clock_hz * 1e-6))
        assert len(list(NAMED["_temperatures"].broken(limited))) == refused


def test_the_slowest_bit_clock_has_to_be_whole_clocks():
    """The FPGA's bound is a whole number of clocks; 100 kHz of 62.512345 MHz is a little more, and bring-up would refuse it."""
    slow = {"waveform__bit_clock_hz": 100e3, "waveform__band_high_hz": 45e3}
    assert not list(NAMED["_bit_period"].broken(changed(BOARD, **slow)))
    (said,) = NAMED["_bit_period"].broken(changed(BOARD, **slow, link__clock_hz=62_512_345))
    assert "625.1235 clocks" in said


def test_decay_is_that_of_the_longest():
    decays = (DecayAt(frequency_hz=20e3, decay_time_ms=0.1), DecayAt(frequency_hz=70e3, decay_time_ms=0.7))
    assert not list(NAMED["_decay"].broken(changed(BOARD, plate__damping=Damping(decay_times=decays))))


@each_row(("low_hz", "clock_hz"), [(499.0, 500e3), (1e-3, 500e3), (5e-324, 2e6), (99.0, 100e3)])
def test_a_band_that_an_emission_cannot_tell_from_rest_is_refused(low_hz, clock_hz):
    waveform = {"band_low_hz": low_hz, "band_high_hz": 40e3, "bit_clock_hz": clock_hz, "duration_ms": 0.5}
    board = changed(BOARD, **{f"waveform__{key}": value for key, value in waveform.items()})
    (line,) = NAMED["_resolved"].broken(board)
    assert f"tell no less than {clock_hz / 1000:g} Hz from rest" in line


def test_pulses_of_hv_alive_are_those_of_the_gateware():
    assert ALIVE_HZ == ALIVE_HZ_4 / 2


@each_row("samples", [500, 5000, 50_000])
def test_a_ramp_has_the_edges_that_are_reckoned_with(samples):
    levels = np.concatenate([[0], ramp_bits(samples, up=True), [1]]).astype(int)
    assert np.abs(np.diff(levels)).sum() == pytest.approx(RAMP_EDGES * samples, rel=0.02)


def test_a_bank_has_the_size_that_is_reckoned_with():
    grid = Grid.of(BOARD.plate, 2.5e-3)
    size = Header("", b"", grid, 500e3, 1000, grid.cells, {"composes": True}).file_bytes
    assert size / grid.cells == pytest.approx(1000 * BANK_BYTES, rel=0.02)
    assert size / grid.cells != pytest.approx(1000 * BANK_BYTES * 1.05, rel=0.02)


@each_row("frequency_hz", [1e3, 20e3, 43e3, 70e3])
def test_what_a_driver_passes_is_its_transfer(frequency_hz):
    exact = abs(complex(DriverResponse.of(BOARD.driver).transfer(2j * math.pi * frequency_hz)))
    assert passed(BOARD.driver, frequency_hz) == pytest.approx(exact, rel=1e-9)


def test_the_part_on_the_plate_is_that_of_a_fine_grid():
    rows = ((180.0, 70.0, -30.0), (-40.0, 190.0, 20.0))
    found = reached(*rows, 210.0, 148.0)
    one, other = (np.ravel(axis) for axis in np.meshgrid(*2 * [(np.arange(1000) + 0.5) / 1000]))
    x_mm, y_mm = (row[0] * one + row[1] * other + row[2] for row in rows)
    share = np.mean((x_mm >= 0) & (x_mm <= 210) & (y_mm >= 0) & (y_mm <= 148))
    assert 0.2 < share < 0.9
    assert found.on_plate_mm2 / found.area_mm2 == pytest.approx(share, abs=2e-3)
    assert found.x_mm == (-30.0, 220.0)


Numbers = st.floats
ROWS = st.tuples(*3 * [Numbers(-1e5, 1e5)])
RANDOM = {
    "plate__length_mm": Numbers(20, 4000),
    "plate__width_mm": Numbers(20, 4000),
    "plate__thickness_mm": Numbers(0.05, 20),
    "plate__young_modulus_pa": Numbers(1e9, 1e12),
    "plate__poisson_ratio": Numbers(0, 0.499),
    "plate__density_kg_m3": Numbers(100, 25e3),
    "plate__decay_time_ms": Numbers(0.1, 10e3),
    "driver__supply_v": Numbers(1e-9, 60),
    "driver__resistance_ohm": Numbers(1, 1e6),
    "driver__inductance_h": Numbers(1e-9, 1),
    "driver__capacitance_f": Numbers(1e-12, 1e-6),
    "bank__pitch_mm": Numbers(0.5, 50),
    "bank__snap_mm": Numbers(0, 1e9),
    "touch__x_mm_from_axes": ROWS,
    "touch__y_mm_from_axes": ROWS,
    "limits__ramp_ms": Numbers(1e-9, 100),
    "limits__max_duty": Numbers(1e-9, 1),
    "limits__max_channel_edge_rate_hz": Numbers(1e-9, 500e3),
    "limits__max_total_edge_rate_hz": Numbers(1e-9, 16e6),
    "limits__max_edge_rate_hz": Numbers(1e-9, 1e300),
    "limits__resistor_rating_w": Numbers(1e-9, 100),
    "limits__derating": Numbers(1e-9, 1),
    "link__clock_hz": st.integers(56_000_000, 400_000_000),
    "link__spi_source_hz": st.integers(1_000_000, 1_000_000_000),
    "temperature": st.builds(
        Temperature,
        kind=st.just("lm75"),
        device=st.just("/dev/i2c-1"),
        coefficient_per_k=Numbers(-1e-2, 1e-2),
        lowest_c=Numbers(-1e300, 20),
        highest_c=Numbers(25, 1e300),
    ),
    "actuators": st.lists(
        st.builds(
            lambda **keys: msgspec.structs.replace(BOARD.actuators[0], **keys),
            channel=st.integers(0, 31),
            x_mm=Numbers(-1000, 5000),
            y_mm=Numbers(-1000, 5000),
            size_mm=Numbers(1e-9, 5000),
            idle=st.integers(0, 1),
        ),
        max_size=6,
    ).map(tuple),
}


@settings(max_examples=200)
@given(st.fixed_dictionaries({}, optional=RANDOM))
def test_any_board_is_evaluated_without_a_traceback(keys):
    board = changed(BOARD, **keys)
    verdict = judge(board)
    assert all(line and "\n" not in line and "nan" not in line for line in (*verdict.refused, *verdict.odd))
    if not verdict.refused:  # what is not refused can be built
        parameters = BuildParameters.of(board, 0)
        assert parameters.bit_period_reset >= 4 << 16


def test_a_driver_that_misses_the_band_is_named_by_the_frequency_of_its_filter():
    (said,) = NAMED["_driver_band"].broken(changed(BOARD, driver__inductance_h=10e-3, driver__capacitance_f=100e-9))
    assert said.partition("a filter of ")[2].startswith("5.03e+03 Hz; match")
