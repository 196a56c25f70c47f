"""board.toml: the shipped board loads, and everything that cannot be meant is refused with file, key and value."""

import hashlib
import re
from pathlib import Path

import msgspec
import pytest
from tables import each_row

from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.device.board.plate.plate import Damping
from controller.device.scene.scene_file import find_scene
from controller.device.service.drivers import recording_path
from controller.errors import ConfigError

SHIPPED = (find_board("simulated") / "board.toml").read_text()


def refused(tmp_path, text):
    file = tmp_path / "board.toml"
    file.write_text(text)
    with pytest.raises(ConfigError) as caught:
        load_board(tmp_path)
    message = str(caught.value)
    assert message.startswith(f"{file}: ")
    assert "\n" not in message
    assert caught.value.exit_code == 78
    return message.removeprefix(f"{file}: ")


def test_the_simulated_board_is_the_papers():
    board = load_board(find_board("simulated"))
    assert (board.plate.length_m, board.plate.width_m, board.plate.thickness_m) == (0.21, 0.148, 0.0005)
    assert board.waveform.samples == 1000
    assert board.waveform.duration_s == 2e-3
    assert board.bit_ticks == 160
    assert len(board.actuators) == 32
    assert board.channel_mask == 0xFFFFFFFF


def test_half_of_each_discs_quadrants_idle_high_as_a_checkerboard():
    board = load_board(find_board("simulated"))
    for disc in range(8):
        first = board.actuators[4 * disc : 4 * disc + 4]
        high = [a for a in first if a.idle]
        assert len(high) == 2
        assert high[0].x_mm != high[1].x_mm
        assert high[0].y_mm != high[1].y_mm
    assert board.idle_word == 0x99999999


def test_no_two_discs_are_mirror_images():
    board = load_board(find_board("simulated"))
    discs = [
        tuple(sum(getattr(a, axis) for a in board.actuators[4 * d : 4 * d + 4]) / 4 for axis in ("x_mm", "y_mm")) for d in range(8)
    ]
    for x, y in discs:
        for image in ((210 - x, y), (x, 148 - y), (210 - x, 148 - y)):
            assert all(abs(image[0] - u) + abs(image[1] - v) > 2 for u, v in discs)


MATERIAL = """thickness_mm = 0.5
young_modulus_pa = 72.9e9  # D263 borosilicate glass
poisson_ratio = 0.208
density_kg_m3 = 2510.0
"""
GLASS = "{ thickness_mm = 0.7, young_modulus_pa = 72.9e9, poisson_ratio = 0.208, density_kg_m3 = 2510 }"
SOFT = "{ thickness_mm = 0.1, young_modulus_pa = 1e6, poisson_ratio = 0.49, density_kg_m3 = 1000 }"
GLUE = "{ thickness_mm = 0.1, young_modulus_pa = 4e9, poisson_ratio = 0.35, density_kg_m3 = 1200 }"
AT_10_KHZ = "{ frequency_hz = 10e3, decay_time_ms = 1.0 }"


@each_row(
    ("was", "becomes", "said"),
    [
        ("thickness_mm = 0.5", "thick_mm = 0.5", r"plate\.thick_mm = 0\.5: unknown key; did you mean thickness_mm\?"),
        ("[limits]", "[limit]", r"limit: unknown key; did you mean limits\?"),
        ('name = "simulated"', 'name = "../../elsewhere"', r"name = '\.\./\.\./elsewhere'"),
        ('name = "simulated"', 'name = "a\\u0000b"', r"name = "),
        ("name", "x = " + "[" * 20_000 + "\nname", r"not valid TOML"),
        ("thickness_mm = 0.5", "thickness_mm = 1e-6", r"plate\.thickness_mm = 1e-06"),
        ("thickness_mm = 0.5", "thickness_mm = 1e300", r"plate\.thickness_mm = 1e\+300"),
        ("decay_time_ms = 1.0", "decay_time_ms = 20e3", r"plate\.decay_time_ms = 20000"),
        (
            "thickness_mm = 0.5\n",
            "",
            r"plate\.thickness_mm is missing: a number from 0\.05 to 20 mm",
        ),
        (
            'theory = "kirchhoff"',
            f"layers = [{GLASS}]",
            r"thickness_mm = 0\.5 beside layers, which make it 0\.7: leave it out",
        ),
        (MATERIAL, f"layers = [{GLASS}, {SOFT}, {GLASS}]\n", r"layers\[1\]\.young_modulus_pa = 1e\+06 is soft: .* slide on it"),
        (
            MATERIAL,
            f"layers = [{GLASS}, {GLUE}, {GLASS}]\n",
            r'layers\[1\]\.young_modulus_pa .* leaves out; set theory = "mindlin"',
        ),
        ("decay_time_ms = 1.0", "decay_time_ms = 1.0\ndamping = { loss_factor = 0.6 }", r"plate\.damping\.loss_factor = 0\.6"),
        (
            "decay_time_ms = 1.0",
            f"decay_time_ms = 1.0\ndamping = {{ decay_times = [{AT_10_KHZ}, {AT_10_KHZ}] }}",
            r"decay_times\[1\]\.frequency_hz = 10000 is not above the one before, 10000",
        ),
        ('theory = "kirchhoff"', 'theory = "reissner"', r"plate\.theory = 'reissner': must be one of 'kirchhoff', 'mindlin'"),
        ("capacitance_f = 2.0e-9", "capacitance_f = 1e26", r"driver\.capacitance_f = 1e\+26"),
        ("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 1e-6", r"limits\.heartbeat_timeout_ms = 1e-06"),
        ("length_mm = 210.0", 'length_mm = "210"', r"plate\.length_mm = '210': must be a number from 20 to 4000"),
        ("length_mm = 210.0", "length_mm = -210.0", r"plate\.length_mm = -210\.0: must be a number from 20 to \d+"),
        ("length_mm = 210.0", "length_mm = nan", r"plate\.length_mm = nan"),
        ("length_mm = 210.0", "length_mm = inf", r"plate\.length_mm = inf"),
        ("size_mm = 4.6", "size_mm = -4.6", r"actuators\[0\]\.size_mm = -4\.6"),
        ("x_mm =  26.5", "x_mm = 2.0", r"actuators\[0\]\.x_mm = 2\.0 .*off the plate"),
        ("y_mm =  12.5", "y_mm = 147.0", r"actuators\[0\]\.y_mm = 147\.0 .*off the plate"),
        ("channel =  1,", "channel = 0,", r"actuators\[1\]\.channel = 0 is taken by actuators\[0\]"),
        ("channel = 31,", "channel = 32,", "there are channels from 32 on, and FPGAs for 32"),
        ("channel = 31,", "channel = 128,", r"actuators\[31\]\.channel = 128"),
        ("channel = 31,", "channel = -1,", r"actuators\[31\]\.channel = -1"),
        ("band_high_hz = 70e3", "band_high_hz = 250e3", r"band_high_hz = 250000\.0 is not below half of bit_clock_hz"),
        ("band_high_hz = 70e3", "band_high_hz = 10e3", r"band_high_hz = 10000\.0 is not above band_low_hz"),
        ("supply_v = 60.0", "supply_v = 61.0", r"driver\.supply_v = 61\.0"),
        (
            "bit_clock_hz = 500e3",
            "bit_clock_hz = 99e3",
            r"waveform\.bit_clock_hz = 99000\.0: must be a number from 100000 to 2000000",
        ),
        (
            "bit_clock_hz = 500e3",
            "bit_clock_hz = 2.001e6",
            r"waveform\.bit_clock_hz = 2001000\.0: must be a number from 100000 to 2000000",
        ),
        ("clock_hz = 80_000_000", "clock_hz = 1_000_000", r"sck_hz = 25000000 is above half of clock_hz = 1000000"),
        ("sck_hz = 25_000_000", "sck_hz = 40_000_001", r"sck_hz = 40000001 is above half"),
        ("max_duty = 1.0", "max_duty = 1.01", r"limits\.max_duty = 1\.01"),
        ("max_duty = 1.0", "max_duty = 0.0", r"limits\.max_duty = 0\.0"),
        ("duty_budget_ms = 100.0", "duty_budget_ms = 19.0", r"limits\.duty_budget_ms = 19\.0: must be a number from 20 to \d+"),
        (
            "duty_budget_ms = 100.0",
            "duty_budget_ms = 1001.0",
            r"limits\.duty_budget_ms = 1001\.0: must be a number from 20 to 1000",
        ),
        (
            "longest_emission_ms = 2.5",
            "longest_emission_ms = 10.1",
            r"limits\.longest_emission_ms = 10\.1: must be a number above 0, at most 10",
        ),
        (
            "longest_emission_ms = 2.5",
            "longest_emission_ms = 1.9",
            r"duration_ms = 2 is longer than limits\.longest_emission_ms = 1\.9",
        ),
        ("min_pulse_us = 1.5", "min_pulse_us = 0.39", r"limits\.min_pulse_us = 0\.39: must be a number from 0\.4 to 10"),
        ("min_pulse_us = 1.5", "min_pulse_us = 2.01", r"min_pulse_us = 2\.01 is longer than a drive word, 2 us"),
        ("max_total_edge_rate_hz = 4e6\n", "", r"limits\.max_total_edge_rate_hz is missing: a number above 0, at most 16000000"),
        ("max_channel_edge_rate_hz = 150e3", "max_channel_edge_rate_hz = 501e3", r"limits\.max_channel_edge_rate_hz = 501000\.0"),
        ("max_channel_edge_rate_hz = 150e3", "max_channel_edge_rate_hz = 0.0", r"limits\.max_channel_edge_rate_hz = 0\.0"),
        ("max_total_edge_rate_hz = 4e6", "max_total_edge_rate_hz = 17e6", r"limits\.max_total_edge_rate_hz = 17000000\.0"),
        (
            'kind = "simulated"',
            'kind = "spy"',
            r"link\.kind = 'spy': must be one of 'serial', 'simulated', 'spi'; did you mean spi\?",
        ),
        ('kind = "simulated"', 'kind = "serial"', r"device is missing: the serial port"),
        ("slots = 4", "slots = 17", r"link\.slots = 17: must be a whole number from 1 to 16"),
        ("duration_ms = 2.0", "duration_ms = 3.0", r"duration_ms = 3\.0 is not 1 to 1000 samples"),
        ("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 251.0", r"heartbeat_timeout_ms = 251\.0"),
        ("[210.0, 0.0, 0.0]", "[210.0, 0.0]", r"touch\.x_mm_from_axes"),
        ('name = "simulated"', 'name = "simulated', r"not valid TOML"),
        ("[plate]", "[plate.plate]", r"plate"),
    ],
)
def test_refuses_what_cannot_be_meant(tmp_path, was, becomes, said):
    assert was in SHIPPED
    assert re.search(said, refused(tmp_path, SHIPPED.replace(was, becomes, 1)))


def test_a_bit_clock_need_not_divide_the_clock(tmp_path):
    """BIT_PERIOD is in 65536ths of a tick: every bit clock is met within 10 millionths."""
    for bit_clock_hz, period in ((500_000.0, 160 << 16), (300_000.0, 17_476_267), (2_000_000.0, 40 << 16), (333_333.0, 15_728_656)):
        text = SHIPPED.replace("bit_clock_hz = 500e3", f"bit_clock_hz = {bit_clock_hz}").replace(
            "duration_ms = 2.0", "duration_ms = 0.4"
        )
        (tmp_path / "board.toml").write_text(text.replace("min_pulse_us = 1.5", "min_pulse_us = 0.5"))
        board = load_board(tmp_path)
        assert board.bit_period == period
        assert board.link.clock_hz * 65536 / period == pytest.approx(bit_clock_hz, rel=10e-6)
        assert board.bit_ticks == round(period / 65536)


def test_the_shortest_drive_word_has_four_ticks(tmp_path):
    slow = SHIPPED.replace("sck_hz = 25_000_000", "sck_hz = 600_000").replace("clock_hz = 80_000_000", "clock_hz = 2_000_000")
    (tmp_path / "board.toml").write_text(slow)
    assert load_board(tmp_path).bit_ticks == 4
    slow = slow.replace("clock_hz = 2_000_000", "clock_hz = 1_999_999")
    assert "waveform.bit_clock_hz = 500000.0 is above a 4th of link.clock_hz = 1999999" in refused(tmp_path, slow)


def test_sck_may_be_half_of_the_clock(tmp_path):
    (tmp_path / "board.toml").write_text(SHIPPED.replace("sck_hz = 25_000_000", "sck_hz = 40_000_000"))
    assert load_board(tmp_path).link.sck_hz == 40_000_000


def test_a_serial_link_names_its_port(tmp_path):
    (tmp_path / "board.toml").write_text(SHIPPED.replace('kind = "simulated"', 'kind = "serial"\ndevice = "/dev/ttyUSB0"'))
    link = load_board(tmp_path).link
    assert (link.device, link.baud) == ("/dev/ttyUSB0", 1_000_000)


def test_refuses_more_than_32_channels(tmp_path):
    extra = "{ channel = 5, x_mm = 100.0, y_mm = 70.0, size_mm = 4.6, idle = 0 },\n]\n\n[plate]"
    assert "actuators are 33" in refused(tmp_path, SHIPPED.replace("]\n\n[plate]", extra, 1))


@each_row("content", [b"", b"\x00\xff\xfe", b"name = 1"])
def test_refuses_a_file_that_is_no_board(tmp_path, content):
    (tmp_path / "board.toml").write_bytes(content)
    with pytest.raises(ConfigError, match=re.escape(str(tmp_path))):
        load_board(tmp_path)


def test_an_absent_file_is_named(tmp_path):
    with pytest.raises(ConfigError, match=r"board\.toml: cannot be read"):
        load_board(tmp_path)


def test_an_unknown_board_lists_those_that_exist():
    with pytest.raises(ConfigError, match=r"'nothing' not found; there are: .*simulated"):
        find_board("nothing")


def test_a_board_is_found_by_name_by_folder_and_by_file():
    folder = find_board("simulated")
    assert find_board(str(folder)) == folder
    assert find_board(str(folder / "board.toml")) == folder


def test_the_digest_changes_with_what_a_bank_is_computed_from_and_with_nothing_else(tmp_path):
    def digest(was="", becomes=""):
        (tmp_path / "board.toml").write_text(SHIPPED.replace(was, becomes, 1))
        return load_board(tmp_path).digest()

    same = digest()
    assert digest("thickness_mm = 0.5", "thickness_mm = 0.501") != same
    assert digest("x_mm =  26.5", "x_mm =  26.6") != same
    assert digest("capacitance_f = 2.0e-9", "capacitance_f = 2.02e-9") != same
    assert digest("slots = 4", "slots = 3") == same
    assert digest("# beside", "# next to") == same


def test_a_heartbeat_that_one_frame_would_outlast_is_refused(tmp_path):
    slow = SHIPPED.replace("sck_hz = 25_000_000", "sck_hz = 100_000")
    said = refused(tmp_path, slow.replace("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 81.0"))
    assert "limits.heartbeat_timeout_ms = 81 is less than twice the 41 ms" in said
    (tmp_path / "board.toml").write_text(slow.replace("heartbeat_timeout_ms = 100.0", "heartbeat_timeout_ms = 82.0"))
    assert load_board(tmp_path).link.sck_hz == 100_000


def test_a_board_is_called_by_its_name_only_where_that_finds_it(tmp_path, board):
    assert board.called == "simulated"
    (tmp_path / "board.toml").write_text(SHIPPED)
    assert load_board(tmp_path).called == str(tmp_path)


def test_a_copied_board_finds_what_it_names_of_the_board_it_was_copied_beside(tmp_path):
    """`../simulated/scene.toml` of a board in /etc lies where boards are installed."""
    (tmp_path / "panel").mkdir()
    (tmp_path / "panel" / "board.toml").write_text((find_board("ulx3s") / "board.toml").read_text())
    board = load_board(tmp_path / "panel")
    shipped = find_board("simulated")
    assert find_scene(board).resolve() == (shipped / "scene.toml").resolve()
    assert recording_path(board, None).resolve() == (shipped / "demo.evemu").resolve()
    assert board.beside("scene.toml") == board.folder / "scene.toml", "nothing of its own is looked for elsewhere"
    (tmp_path / "simulated").mkdir()
    (tmp_path / "simulated" / "scene.toml").write_text("")
    assert find_scene(board).read_text() == "", "what is beside it comes first"


def test_a_boards_own_scene_is_not_taken_from_where_one_happens_to_be(tmp_path, monkeypatch, board):
    (tmp_path / "scene.toml").write_text("")
    monkeypatch.chdir(tmp_path)
    assert find_scene(board) == board.folder / "scene.toml"
    assert find_scene(board, "scene.toml") == Path("scene.toml"), "as asked for"


def test_patches_that_lie_on_each_other_are_refused_and_those_that_touch_are_not(tmp_path):
    """Thirty-two on one place were accepted: glass has room for one there."""
    piled, count = re.subn(r"x_mm = +[\d.]+, y_mm = +[\d.]+, size", "x_mm = 50.0, y_mm = 50.0, size", SHIPPED)
    assert count == 32
    assert "actuators[1] lies on actuators[0]" in refused(tmp_path, piled)
    (tmp_path / "board.toml").write_text(SHIPPED.replace("size_mm = 4.6", "size_mm = 5.0"))
    load_board(tmp_path)
    assert "5.01 mm" in refused(tmp_path, SHIPPED.replace("size_mm = 4.6", "size_mm = 5.01"))


def test_a_plate_of_layers_needs_neither_thickness_nor_material(tmp_path):
    folder = tmp_path / "layered"
    folder.mkdir()
    layered = SHIPPED.replace(MATERIAL, f"layers = [{GLASS}, {GLUE}, {GLASS}]\n").replace('"kirchhoff"', '"mindlin"')
    (folder / "board.toml").write_text(layered)
    plate = load_board(folder).plate
    assert plate.thickness_mm == pytest.approx(1.5)
    assert plate.density_kg_m3 == pytest.approx((2 * 0.7 * 2510 + 0.1 * 1200) / 1.5)


def test_the_digest_changes_where_a_key_of_the_plate_is_given_and_not_where_it_is_left_out(board):
    tables = (msgspec.to_builtins(board.plate), board.actuators, board.driver, msgspec.to_builtins(board.waveform))
    del tables[0]["layers"], tables[0]["damping"], tables[3]["slope"], tables[3]["drift_percent"]
    assert hashlib.sha256(msgspec.json.encode(tables)).digest() == board.digest()
    for change in ({"theory": "mindlin"}, {"damping": Damping()}, {"decay_time_ms": 1.1}):
        changed = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, **change))
        assert changed.digest() != board.digest()
