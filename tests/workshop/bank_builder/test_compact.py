"""Compact banks: what they lose, what they play, what is refused."""

import itertools
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from tables import each_row

from controller.device.bank.file_format import COMPACT_VERSION
from controller.device.bank.inspection import bank_info, verify_bank, wrong_pitch
from controller.device.bank.lookup import of_this_format
from controller.device.bank.packing import channel_bits
from controller.device.bank.provenance import Provenance
from controller.device.bank.reader import Bank
from controller.device.board.panel import AssumedFinger
from controller.device.kernel import compact_twin
from controller.device.scene.scene import load_scene
from controller.device.service.scenes.prepare_scene import populate
from controller.device.waveforms.composition import Composer
from controller.device.waveforms.pad import pad_places
from controller.device.waveforms.selection import Selection
from controller.errors import BankError, ConfigError
from controller.workshop.bank_builder import build
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.choice import choose
from controller.workshop.bank_builder.compact import design as module
from controller.workshop.bank_builder.compact import stencils
from controller.workshop.bank_builder.compact.design import compact_grid, compact_pitch_m
from controller.workshop.bank_builder.methods.aims import AIMS
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel
from controller.workshop.physics.responses.loaded_responses import words_source, yielding_alike
from tests.small_plate import small_board

PLACES = 24


@pytest.fixture(scope="module")
def board():
    return small_board()


@pytest.fixture(scope="module")
def model(board):
    return ResponseModel(board)


@pytest.fixture(scope="module")
def path(board, tmp_path_factory):
    file = tmp_path_factory.mktemp("compact") / "bank"
    build_bank(BankRequest(board, file, compact_pitch_m(board), compact=True))
    return file


@pytest.fixture(scope="module")
def plain(board, tmp_path_factory):
    return build_bank(BankRequest(board, tmp_path_factory.mktemp("plain") / "bank"))


@pytest.fixture
def bank(path, board):
    with Bank.open(path, board) as opened:
        yield opened


def places(seed):
    return np.random.default_rng(seed).uniform((8e-3, 8e-3), (62e-3, 42e-3), (PLACES, 2))


def kept(composer, model, points_m):
    """Share of the sum of absolute values of exact responses that words reach at each place: no bits reach more."""
    found = []
    for place, response in zip(points_m, model.drive_order_responses(points_m).astype(np.float64), strict=True):
        words = np.frombuffer(composer.compose([(*place.tolist(), 1.0)]), "<u4")
        signs = 2.0 * channel_bits(words) - 1
        found.append((signs * response).sum() / np.abs(response).sum())
    return np.array(found)


@pytest.mark.slow
def test_under_a_finger_all_points_yield_alike(board, tmp_path):
    """With the receptance of each point 0.83 would be kept at the median, 0.64 at least: it has parts shorter than waves."""
    under = msgspec.structs.replace(board, finger=AssumedFinger())
    assert under.finger.receptance == "point"
    report = build_bank(BankRequest(under, tmp_path / "bank", compact_pitch_m(under), compact=True))
    assert report.responses.endswith("under a finger of 70 mg on an endless plate")
    with Bank.open(tmp_path / "bank", under) as opened:
        composer = Composer(opened, under.idle_word)
        assert kept(composer, words_source(yielding_alike(under), ResponseModel(under)), places(3)).min() > 0.99
        assert kept(composer, ResponseModel(board), places(3)).max() < 0.97, "those of the bare plate"


def test_it_keeps_what_it_says_at_a_fraction_of_the_size(board, bank, plain, model, path):
    shares = kept(Composer(bank, board.idle_word), model, places(3))
    assert np.median(shares) > 0.99
    assert shares.min() > 0.98
    told = bank.header.parameters["interpolation_error"]
    assert told["places"] > PLACES
    assert -0.002 < told["interpolated"]["median"] < 0.015
    assert bank_info(path)["format"] == COMPACT_VERSION
    assert 10 * bank.file.size < plain.bytes


def test_words_for_a_plate_that_is_off_by_1_percent_are_seen(board, bank, monkeypatch):
    thicker = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, thickness_mm=0.505))
    shares = kept(Composer(bank, board.idle_word), ResponseModel(thicker), places(3))
    assert np.median(shares) < 0.9
    # The gain that a trial finds is that of the rest which is written
    design = SimpleNamespace(rows=lambda *_: ([], []), rest_rows=lambda _: ([], np.array([3.0])), tables=lambda _, scales: scales)
    written, no_cells = [], SimpleNamespace(board=board, source=None, wanted=None, numbers=np.array([], int))
    monkeypatch.setattr(build, "Trial", lambda *_: SimpleNamespace(rest_gain=lambda: 1.5, loss=lambda _: {}))
    entries = SimpleNamespace(set_tables=written.extend, require_motion=lambda _: None)
    build._write_compact(no_cells, design, entries)
    assert written == [4.5]
    # Errors of every two cells of a stencil count together
    fit = SimpleNamespace(table=lambda *_: np.zeros((1, 1, 9)), own=np.ones((9, 9)), error=np.zeros(1), let_through=0.0)
    monkeypatch.setattr(stencils, "_Waves", lambda *_: None)
    monkeypatch.setattr(stencils, "_Fit", lambda *_: fit)
    together = {(row, column) for row, column, _ in stencils.stencil(None, 1.0, 3, 1, None, None).together}
    assert together == set(itertools.product(range(-2, 3), repeat=2)) - {(0, 0)}


def test_amplitudes_and_several_fingers_come_out_as_from_a_plain_bank(board, bank, plain, model):
    """Alone at half, a quarter and a tenth, and three at a time: displacement of all modes by words of both banks."""
    idle = channel_bits(np.array([board.idle_word], np.uint32))[0].astype(np.float64)
    points_m = places(4)
    responses = model.responses(points_m)[:, ::-1]

    def moved(composer, some, amplitude):
        words = np.frombuffer(composer.compose([(*points_m[i].tolist(), amplitude) for i in some]), "<u4")
        return [abs(((channel_bits(words) - idle) * responses[i]).sum()) for i in some]

    def figures(opened):
        composer = Composer(opened, board.idle_word)
        alone = np.array([[moved(composer, [i], amplitude)[0] for i in range(PLACES)] for amplitude in (0.5, 0.25, 0.1)])
        return alone, np.array([moved(composer, range(i, i + 3), 1.0) for i in range(0, PLACES, 3)])

    with Bank.open(plain.path, board) as opened:
        known_alone, known_three = figures(opened)
    alone, three = figures(bank)
    off = alone / known_alone - 1
    assert (np.abs(off.mean(axis=1)) < (0.01, 0.01, 0.013)).all()
    assert (np.abs(off).max(axis=1) < (0.06, 0.06, 0.1)).all()
    shares = three / known_three
    assert (shares.max(axis=1) / shares.min(axis=1)).max() < 1.055, "1.063 where halves were rounded down"
    assert shares.mean() > 0.98


def test_a_faint_finger_and_a_pad_that_is_kept_still_are_as_from_a_plain_bank(board, bank, plain, model):
    """A finger at a tenth beside three at full amplitude; the motion of a pad around T without and with a null, in dB."""
    idle = channel_bits(np.array([board.idle_word], np.uint32))[0].astype(np.float64)
    random, scenes = np.random.default_rng(8), []
    while len(scenes) < 12:
        points_m = random.uniform((8e-3, 8e-3), (62e-3, 42e-3), (4, 2))
        if (np.hypot(*(points_m[:, None] - points_m).transpose(2, 0, 1)) + np.eye(4)).min() > 8e-3:
            scenes.append((points_m, *(model.responses(near)[:, ::-1] for near in (points_m, pad_places(*points_m[3].tolist())))))

    def moved(words, responses):
        return np.abs(((channel_bits(np.frombuffer(words, "<u4")) - idle) * responses).sum(axis=(1, 2)))

    def figures(opened):
        composer, faint, stiller = Composer(opened, board.idle_word), [], []
        for points_m, responses, pad in scenes:
            points = [(*place, amplitude) for place, amplitude in zip(points_m.tolist(), (1, 1, 1, 0.1), strict=True)]
            faint.append(moved(composer.compose(points), responses)[3])
            words = composer.compose(points[:1])
            before = np.linalg.norm(moved(words, pad))
            composer.keep_still(points[:1], points[3:])
            stiller.append(20 * np.log10(before / np.linalg.norm(moved(words, pad))))
        return np.array(faint), np.median(stiller)

    with Bank.open(plain.path, board) as opened:
        known_faint, known_stiller = figures(opened)
    faint, stiller = figures(bank)
    assert np.sqrt(np.mean((faint / known_faint - 1) ** 2)) < 0.15, "0.21 where halves were rounded down"
    assert stiller > known_stiller - 2.5, "half of it with sums that lose three bits"


def test_with_a_slope_the_device_knows_what_it_leaves_out(board, tmp_path, monkeypatch):
    """Half of full amplitude is half of the displacement of all modes; by cells alone it is not."""
    sloped = msgspec.structs.replace(board, waveform=msgspec.structs.replace(board.waveform, slope=-1.0))
    model, points_m = ResponseModel(sloped), places(6)
    idle = channel_bits(np.array([sloped.idle_word], np.uint32))[0].astype(np.float64)
    whole = model.responses(points_m)[:, ::-1]
    most = [((response > 0) - idle) for response in model.drive_order_responses(points_m)]

    def errors(name):
        build_bank(BankRequest(sloped, tmp_path / name, compact_pitch_m(sloped), compact=True))
        found = []
        with Bank.open(tmp_path / name, sloped) as opened:
            composer = Composer(opened, sloped.idle_word)
            for place, moves, bits in zip(points_m.tolist(), whole, most, strict=True):
                words = np.frombuffer(composer.compose([(*place, 0.5)]), "<u4")
                found.append(((channel_bits(words) - idle) * moves).sum() / (bits * moves).sum() / 0.5 - 1)
        return float(np.sqrt(np.mean(np.square(found))))

    assert errors("made") < 0.02
    monkeypatch.setattr(module, "of_band", lambda *_: compact_twin.OfBand())
    assert errors("cells") > 0.03


def test_selection_composes_every_place_and_checks_the_cells_it_needs(board, bank):
    selection = Selection(bank, bank.snap_m(board), board.idle_word)
    selection.prepare()
    x_m, y_m = bank.grid.place(bank.grid.nx * 3 + 4)
    key = selection.key([(x_m, y_m, 1.0)])
    assert not isinstance(key, int), "a cell has no waveform of its own"
    assert len(selection.waveform(key)) == 4 * bank.samples
    before = bank.counters.response_checked
    selection.waveform(selection.key([(40e-3, 30e-3, 1.0)]))
    assert bank.counters.response_checked - before == module.ACROSS**2
    with pytest.raises(BankError, match="compact: it holds no waveforms of cells"):
        bank.drive.frames(0)
    with pytest.raises(BankError, match="compact: it holds no samples"):
        bank.responses.response(0)


def test_a_flip_of_any_bit_is_found(path, tmp_path):
    assert verify_bank(path)["good"]
    whole = path.read_bytes()
    with Bank.open(path) as bank:
        places_of = {name: (section.offset, section.size) for name, section in bank.sections.items() if section.size}
    assert {"response", "tables"} <= set(places_of)
    for name, (offset, size) in places_of.items():
        for at in (offset, offset + size // 2, offset + size - 1):
            damaged = bytearray(whole)
            damaged[at] ^= 1
            (tmp_path / name).write_bytes(damaged)
            with pytest.raises(BankError, match="damaged"):
                verify_bank(tmp_path / name)


def test_a_damaged_cell_or_table_is_not_played(path, board, tmp_path):
    with Bank.open(path) as bank:
        offsets = [bank.sections[name].offset for name in ("response", "tables")]
    for offset in offsets:
        damaged = bytearray(path.read_bytes())
        damaged[offset + 5] ^= 4
        (tmp_path / "bank").write_bytes(damaged)
        with Bank.open(tmp_path / "bank", board) as bank, pytest.raises(BankError, match="is damaged; rebuild"):
            Composer(bank, board.idle_word).compose([(*bank.grid.place(0), 1.0)])


def test_cells_that_are_not_built_are_missing_with_their_neighbours(board, tmp_path):
    grid = compact_grid(board, compact_pitch_m(board))
    there = grid.points()[:, 0] < 40e-3
    build_bank(BankRequest(board, tmp_path / "half", grid.pitch_m, there, compact=True))
    with Bank.open(tmp_path / "half", board) as bank:
        selection = Selection(bank, bank.snap_m(board), board.idle_word)
        selection.prepare()
        selection.waveform(selection.key([(20e-3, 25e-3, 1.0)]))
        assert bank.responses.has(20e-3, 25e-3)
        assert not bank.responses.has(39e-3, 25e-3)
        with pytest.raises(BankError, match="no entry for cell"):
            selection.waveform(selection.key([(39e-3, 25e-3, 1.0)]))


@each_row(
    ("change", "why"),
    [
        ({"waveform": {"bit_clock_hz": 200e3}}, "band_high_hz = 70000 is too near to half of bit_clock_hz = 200000"),
        ({"plate": {"length_mm": 70.0, "width_mm": 24.0}}, "too few for a compact bank: build a plain one"),
    ],
)
def test_what_cannot_be_compact_is_refused_in_a_line(board, tmp_path, change, why):
    for table, values in change.items():
        board = msgspec.structs.replace(board, **{table: msgspec.structs.replace(getattr(board, table), **values)})
    board = msgspec.structs.replace(board, actuators=tuple(a for a in board.actuators if a.y_mm < 20))
    with pytest.raises(ConfigError, match=why) as raised:
        build_bank(BankRequest(board, tmp_path / "bank", compact_pitch_m(board), compact=True))
    assert "\n" not in str(raised.value)
    assert not (tmp_path / "bank").exists()


def test_entries_of_a_compact_bank_cannot_be_optimised(board, tmp_path):
    with pytest.raises(ConfigError, match="holds no waveforms"):
        build_bank(BankRequest(board, tmp_path / "bank", compact=True, aim=AIMS["contrast"]))


def test_a_board_can_ask_for_it(board, tmp_path):
    asks = msgspec.structs.replace(board, compose=msgspec.structs.replace(board.compose, method="compact"))
    file = tmp_path / "all.toml"
    file.write_text(
        '[[regions]]\nname = "all"\nshape = "rectangle"\nx_mm = 5.0\ny_mm = 5.0\nwidth_mm = 60.0\nheight_mm = 40.0\n'
        'effects = ["click"]\n'
    )
    scene = load_scene(file, asks)
    choice = choose(asks, scene, file, 5e-3)
    assert choice["compact"]
    assert "a compact bank of the whole plate" in choice["why"]
    build_bank(BankRequest(asks, tmp_path / "bank", choice["pitch_mm"] * 1e-3, choice=choice, compact=True))
    assert of_this_format(tmp_path / "bank"), "it is found where the board's bank lies"
    with Bank.open(tmp_path / "bank", asks) as bank:
        assert wrong_pitch(bank, asks) == ""
        assert "compact" in wrong_pitch(bank, board)
        assert populate(bank, scene, "all", responses=True) > 0
        told = bank.header.parameters["interpolation_error"]["interpolated"]["worst"]
        assert told < 2 * choice["error"]


def test_measured_responses_make_one_of_their_own_plate(board, model, tmp_path):
    stiffer = msgspec.structs.replace(board, plate=msgspec.structs.replace(board.plate, young_modulus_pa=74.4e9))
    measured = ResponseModel(stiffer)
    measured.provenance = Provenance("measured", "arrays of a test")
    build_bank(BankRequest(board, tmp_path / "bank", compact_pitch_m(board), compact=True, source=measured))
    with Bank.open(tmp_path / "bank", board) as bank:
        composer = Composer(bank, board.idle_word)
        assert np.median(kept(composer, measured, places(5))) > 0.99
        assert np.median(kept(composer, model, places(5))) < 0.9
        assert bank.header.provenance.from_measurements
        assert wrong_pitch(bank, board) == "it is compact, as compose.method chose"
