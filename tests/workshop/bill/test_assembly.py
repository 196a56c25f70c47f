"""Figures of boards/assembly.md are those of the board, the netlists and the stage's table."""

import math
import re

from controller.device.board.board import load_board
from controller.device.board.lookup import data_folder, find_board
from controller.device.board.relations.bending_waves import bending_stiffness
from controller.workshop.benchmark.stage.stage_circuit import parameters
from controller.workshop.bill.bill import SHIFTER_A, bill, supply_w

BOARD = load_board(find_board("ulx3s"))
PAGE = " ".join((data_folder("boards") / "assembly.md").read_text().split())
STAGE = (data_folder("boards") / "stage" / "README.md").read_text()


def measured(figure):
    return re.search(rf"^\| {re.escape(figure)} \| ([^|]+) \|", STAGE, re.MULTILINE)[1]


def test_glue_and_patches():
    glue = next(item for item in bill(BOARD) if item.item == "glue")
    discs = next(item for item in bill(BOARD) if item.item.startswith("piezo"))
    assert f"{BOARD.parts.glue_mm:g} mm is what [parts] assumes, {glue.quantity / discs.quantity:.1f} mm³ a disc" in PAGE
    assert f"{BOARD.driver.capacitance_f * 1e9:g} nF ± 30 % to the brass" in PAGE
    assert f"are {BOARD.driver.capacitance_f * BOARD.driver.supply_v**2 / 2 * 1e6:.1f} µJ a sector" in PAGE


def test_what_is_measured_when_it_is_switched_on():
    part, volts = parameters(), BOARD.driver.supply_v
    assert f"{part['rail_bleeder_ohm'] / 1e3:g} kΩ (R26), and {part['bleeder_ohm'] / 1e6:g} MΩ" in PAGE
    assert f"at most {measured('pins of an FPGA that is not configured')}; `V60`" in PAGE
    assert float(measured("switched supply then").split()[0]) < 0.01
    high = bin(BOARD.idle_word).count("1")
    rest_ma = (high * SHIFTER_A + volts / part["rail_bleeder_ohm"]) * 1e3
    assert f"{rest_ma:.0f} mA: {high} channels that idle high" in PAGE
    assert float(measured("from hv_enable to 98 % of the supply").split()[0]) < 1000
    for figure in ("patch 10 ms after the 5 V are gone, channel high", "patch 10 ms after the 60 V are gone, channel high"):
        assert float(measured(figure).split()[0]) < 1
    assert f"at most {supply_w(BOARD) / volts * 1e3:.0f} mA |" in PAGE
    stored_mj = part["bulk_f"] * volts**2 / 2 * 1e3
    assert f"{part['bulk_f'] * 1e6:g} µF on `V60` are {stored_mj:.1f} mJ, gone in" in PAGE
    assert volts * math.exp(-0.1 / (part["rail_bleeder_ohm"] * part["bulk_f"])) < 1


def test_masses_beside_the_plates_impedance():
    plate = BOARD.plate
    impedance = 8 * math.sqrt(bending_stiffness(plate) * plate.density_kg_m3 * plate.thickness_mm * 1e-3)
    assert f"8 √(D ρ h) = {impedance:.1f} N s/m" in PAGE
    for mass_mg in (1, 10, 50, 300):
        ratios = [2 * math.pi * frequency_hz * mass_mg * 1e-6 / impedance for frequency_hz in (20e3, 45e3, 70e3)]
        assert re.search(
            rf"\| {mass_mg} mg[^|]* \| {', '.join(f'{ratio:.3g}' if ratio > 1 else f'{ratio:.2f}' for ratio in ratios)} \|", PAGE
        )
