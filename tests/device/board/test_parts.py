"""What follows from a disc on a plate: against equilibrium solved another way, the paper's stage, and what is refused."""

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.parts import BRASS, E12, E24, GLUE, Disc, Parts, catalogue, followed, made
from controller.device.board.plate.patches import Patches
from controller.device.board.relations.checked import judge
from controller.errors import ConfigError

BOARD = load_board(find_board("simulated"))
GLASS = BOARD.plate
PAPERS = Parts(disc="7BB-12-9")
RULED = ("resistance_ohm", "inductance_h", "capacitance_f", "moment_n_per_v")


def glass(thickness_mm):
    return msgspec.structs.replace(GLASS, thickness_mm=thickness_mm)


def solved(parts, plate):
    """Stiffness of plate and disc, and the moment per volt that bends as the ceramic does, from force and moment balance.

    Each layer's stress is Q (e + z k), that of the ceramic less its own expansion; e and k, both the same along x and y, make
    force and moment vanish. Q is that of waves along one axis, E / (1 - nu^2); the ceramic pulls both ways, Y / (1 - nu).
    """
    disc = parts.data
    layers = [
        (plate.thickness_mm, plate.young_modulus_pa, plate.poisson_ratio),
        (parts.glue_mm, GLUE["young_modulus_pa"], GLUE["poisson_ratio"]),
        (disc.brass_thickness_mm, BRASS["young_modulus_pa"], BRASS["poisson_ratio"]),
        (disc.ceramic_thickness_mm, disc.ceramic_modulus_pa, disc.ceramic_poisson_ratio),
    ]
    z = np.linspace(0, sum(layer[0] for layer in layers) * 1e-3, 400_001)
    z = (z[1:] + z[:-1]) / 2
    ends = np.cumsum([layer[0] for layer in layers]) * 1e-3
    which = np.searchsorted(ends, z)
    q = np.array([e / (1 - nu**2) for _, e, nu in layers])[which]
    pull = np.where(which == 3, disc.piezo_constant_m_per_v * disc.ceramic_modulus_pa / (1 - disc.ceramic_poisson_ratio), 0.0)
    pull /= disc.ceramic_thickness_mm * 1e-3
    step = z[1] - z[0]
    stiffness = np.array([[q.sum(), (q * z).sum()], [(q * z).sum(), (q * z**2).sum()]]) * step
    _, curvature = np.linalg.solve(stiffness, np.array([pull.sum(), (pull * z).sum()]) * step)
    bending = np.linalg.inv(np.linalg.inv(stiffness)[1:, 1:])[0, 0]
    return bending, bending * curvature


def passed_on(inside, outside, poisson):
    """Moment on the bare plate that makes the same waves far away: a disc of unit radius, slope and moment balanced at its rim.

    w = a r^2 inside and b ln(r) outside. At r = 1: 2 a = b; inside (1 + nu) 2 a less the disc's own moment, outside (nu - 1) b.
    """

    def far(stiffness):
        system = np.array([[2.0, -1.0], [stiffness * (1 + poisson) * 2, -outside * (poisson - 1)]])
        return np.linalg.solve(system, np.array([0.0, 1.0]))[1]

    return far(inside) / far(outside)


@each_row("thickness_mm", [0.3, 0.5, 1.1, 2.0])
def test_a_disc_bends_the_plate_as_its_layers_in_balance_do(thickness_mm):
    plate, parts = glass(thickness_mm), Parts(disc="7BB-12-9", bond=1.0)
    on = parts.on(plate)
    bending, moment = solved(parts, plate)
    bare = plate.young_modulus_pa * plate.thickness_m**3 / (12 * (1 - plate.poisson_ratio**2))
    for found, wanted in (
        (on.stiffness_ratio, bending / bare),
        (on.disc_moment_n_per_v, moment),
        (on.moment_n_per_v, moment * passed_on(bending, bare, plate.poisson_ratio)),
    ):
        assert found == pytest.approx(wanted, rel=1e-4)
        assert found * 1.01 != pytest.approx(wanted, rel=1e-4)


def test_thicker_glass_takes_more_of_a_moment_as_reckoned_by_hand():
    """Over that on 0.5 mm: a laminate reckoning without glue, done apart from this program, to two digits."""
    parts = Parts(disc="7BB-12-9", glue_mm=0)
    moments = [parts.on(glass(mm)).moment_n_per_v for mm in (0.3, 0.5, 0.7, 1.1, 1.5, 2.0)]
    assert np.round(np.array(moments) / moments[1], 2) == pytest.approx([0.43, 1, 1.65, 3.0, 4.5, 6.3], rel=0.02)
    assert parts.on(GLASS).mass_kg_m2 == pytest.approx(1.774, rel=5e-3)
    assert parts.on(GLASS).stiffness_ratio == pytest.approx(3.07, rel=0.015)


def test_the_papers_disc_asks_for_the_papers_stage():
    found = followed(PAPERS, GLASS, BOARD.waveform, {})["driver"]
    assert found == {
        "moment_n_per_v": pytest.approx(BOARD.driver.moment_n_per_v, rel=0.01),
        "capacitance_f": 2e-9,
        "inductance_h": 6.8e-3,
        "resistance_ohm": 2000.0,
    }
    assert all(value == float(f"{value:.6g}") for value in found.values())


@each_row(
    ("value", "series", "wanted"),
    [(6.25e-3, E12, 6.8e-3), (97.0, E12, 100.0), (2004, E24, 2000.0), (9.4, E24, 9.1), (1e-9, E12, 1e-9)],
)
def test_parts_are_made_in_preferred_numbers(value, series, wanted):
    assert made(value, series) == wanted


def board_of(tmp_path, driver=(), parts='disc = "7BB-12-9"', extra=""):
    """The simulated board with only these keys in [driver], these [parts], and more tables."""
    lines, table = [], ""
    for line in (BOARD.folder / "board.toml").read_text(encoding="utf-8").splitlines():
        table = line.strip().partition("]")[0][1:] if line.startswith("[") else table
        if table == "parts" or (table == "driver" and line.partition(" ")[0] in RULED and line.partition(" ")[0] not in driver):
            continue
        lines.append(line)
    file = tmp_path / "board.toml"
    file.write_text("\n".join([*lines, f"[parts]\n{parts}" if parts else "", extra]), encoding="utf-8")
    return file


def test_a_board_leaves_out_what_its_parts_say(tmp_path):
    board = load_board(board_of(tmp_path))
    assert msgspec.structs.asdict(board.driver) == followed(PAPERS, GLASS, BOARD.waveform, {"supply_v": 60.0})["driver"]
    assert not [said for said in judge(board).odd if "driver" in said]


def test_what_a_board_gives_stands_and_the_rest_follows_from_it(tmp_path):
    board = load_board(board_of(tmp_path, driver=("capacitance_f", "moment_n_per_v")))
    assert (board.driver.capacitance_f, board.driver.moment_n_per_v) == (2e-9, 1.3e-3)
    assert (board.driver.inductance_h, board.driver.resistance_ohm) == (6.8e-3, 2000)


def test_patches_that_count_have_the_mass_and_stiffness_of_the_parts(tmp_path):
    on = PAPERS.on(GLASS)
    board = load_board(board_of(tmp_path, extra='[patches]\nshape = "disc"\nsize_mm = 9.0\nmass_kg_m2 = 1.7'))
    assert board.patches.mass_kg_m2 == 1.7
    assert board.patches.stiffness_ratio == pytest.approx(on.stiffness_ratio, rel=1e-5)
    assert board.driver.moment_n_per_v == pytest.approx(on.disc_moment_n_per_v, rel=1e-5)
    assert load_board(board_of(tmp_path)).digest() != board.digest()


OWN = "disc = { brass_mm = 20, brass_thickness_mm = 0.2, ceramic_mm = 15, ceramic_thickness_mm = 0.22, capacitance_f = 15e-9 }"


def test_a_disc_of_ones_own_is_a_table_of_its_data(tmp_path):
    board = load_board(board_of(tmp_path, parts=f"{OWN}\nsectors = 8"))
    assert board.driver.capacitance_f == 1.875e-9
    assert board.parts.data == Disc(
        brass_mm=20, brass_thickness_mm=0.2, ceramic_mm=15, ceramic_thickness_mm=0.22, capacitance_f=15e-9
    )


@each_row(
    ("parts", "said"),
    [
        (
            "",
            "driver.resistance_ohm is missing; driver.inductance_h is missing; driver.capacitance_f is missing; driver.mom",
        ),
        ('disc = "7BB-12-8"', "disc = '7BB-12-8' is not in the catalogue: one of 7BB-12-9"),
        ("sectors = 4", "parts.disc is missing"),
        ('disc = "7BB-12-9"\nsectors = 0', "parts.sectors = 0"),
        ('disc = "7BB-12-9"\nbond = nan', "parts.bond = nan: must be a finite number"),
        ('disc = "7BB-12-9"\nbonds = 1', "parts.bonds = 1: unknown key; did you mean bond"),
        (OWN.replace("ceramic_mm = 15", "ceramic_mm = 25"), "ceramic_mm = 25 is above brass_mm = 20"),
        (OWN.replace("15e-9", "9e-6"), "[parts] makes driver.capacitance_f = 2.25e-06"),
    ],
)
def test_parts_that_are_none_are_refused_in_one_line(tmp_path, parts, said):
    with pytest.raises(ConfigError) as refused:
        load_board(board_of(tmp_path, parts=parts))
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


@each_row(
    ("table", "keys", "said"),
    [
        ("driver", {"moment_n_per_v": 3e-3}, "driver.moment_n_per_v = 0.003, of disc 7BB-12-9 0.0013"),
        ("driver", {"capacitance_f": 1e-9}, "actuators.size_mm = 4.6: driver.capacitance_f = 1e-09"),
        ("patches", Patches(mass_kg_m2=9.0, stiffness_ratio=3.4), "patches.mass_kg_m2 = 9"),
        ("patches", Patches(mass_kg_m2=1.8, stiffness_ratio=9.0), "patches.stiffness_ratio = 9"),
    ],
)
def test_what_is_given_is_compared_with_the_parts(table, keys, said):
    value = msgspec.structs.replace(BOARD.driver, **keys) if table == "driver" else keys
    assert any(said in odd for odd in judge(msgspec.structs.replace(BOARD, **{table: value})).odd)


def test_every_disc_of_the_catalogue_is_named_once_and_fits_a_board():
    for name in catalogue():
        driver = followed(Parts(disc=name), GLASS, BOARD.waveform, {})["driver"]
        assert 1e-4 < driver["moment_n_per_v"] < 1e-2
        assert 1e-9 < driver["capacitance_f"] < 1e-8
