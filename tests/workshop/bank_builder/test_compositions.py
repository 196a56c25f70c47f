import msgspec
import pytest

from controller.device.bank.grid import Grid
from controller.device.bank.inspection import bank_info, verify_bank
from controller.device.bank.reader import Bank
from controller.device.fpga.frames import ReadyFrames
from controller.device.kernel import unpack_loads
from controller.device.scene.scene import FixedEmitter
from controller.device.waveforms.selection import Selection
from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.compositions import compositions, played_together
from controller.workshop.bank_builder.methods.exact_composition import ExactComposition
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.responses.impulse_response import ResponseModel

PITCH_M = 35e-3  # 5 x 3 cells
SPOTS = [FixedEmitter(0.06, 0.054, 20.0, "a"), FixedEmitter(0.15, 0.1, 20.0, "b"), FixedEmitter(0.11, 0.03, 20.0, "c", 0.5)]
POINTS = [(emitter.x_m, emitter.y_m, emitter.amplitude) for emitter in SPOTS]
SCENE = "".join(
    f"""
[[regions]]
name = "{emitter.region}"
shape = "circle"
x_mm = {emitter.x_m * 1e3}
y_mm = {emitter.y_m * 1e3}
radius_mm = 3.0
effects = [{{ effect = "always", rate_hz = 20.0, amplitude = {emitter.amplitude} }}]
"""
    for emitter in SPOTS
)


@pytest.fixture(scope="module")
def built(board, tmp_path_factory):
    path = tmp_path_factory.mktemp("banks") / "bank"
    return build_bank(BankRequest(board, path, PITCH_M, emitters=SPOTS)), path


def test_what_spots_play_together_is_taken_from_the_bank_as_exact_composition_made_it(built, board):
    report, path = built
    assert bank_info(path)["compositions"] == 1
    assert verify_bank(path)["good"]
    exact = ExactComposition(board, ResponseModel(board)).design(POINTS).words.tobytes()
    with Bank.open(path, board) as bank:
        assert report.worst_edge_rate_hz * board.waveform.duration_s <= bank.worst_edges[0]
        selection = Selection(bank, 1e-3, board.idle_word)
        for points in (POINTS, POINTS[::-1], [(x_m + 0.01e-3, y_m, amplitude) for x_m, y_m, amplitude in POINTS]):
            waveform = selection.waveform(selection.key(points))
            assert isinstance(waveform, ReadyFrames)
            words = bytearray(4000)
            assert unpack_loads(words, waveform.frames) == waveform.crc
            assert words == exact
        assert not selection.composes
        assert isinstance(selection.waveform(selection.key(POINTS[:2])), memoryview)  # not what they play together


def test_a_damaged_composition_is_composed_on_the_device(built, board, tmp_path):
    copy = tmp_path / "bank"
    data = bytearray(built[1].read_bytes())
    with Bank.open(built[1], board) as bank:
        data[bank.sections["composed"].offset + 100] ^= 1
    copy.write_bytes(data)
    with Bank.open(copy, board) as bank:
        selection = Selection(bank, 1e-3, board.idle_word)
        assert isinstance(selection.waveform(selection.key(POINTS)), memoryview)
        assert bank.counters.bad == 1


def test_the_loop_counts_what_it_took_ready_from_the_bank(built, board, perform):
    script = [(0.0, {0: (10.0, 10.0)}), (0.05, {0: None}), (0.3, {0: (10.0, 10.0)}), (0.35, {0: None})]
    on = msgspec.structs.replace(board, bank=msgspec.structs.replace(board.bank, pitch_mm=PITCH_M * 1e3, coarse=True))
    run = perform(script, SCENE, on=on, bank=built[1])
    assert run.counters.composed_beforehand == run.counters.uploads == run.counters.skipped.compositions == 1
    assert not run.response_mapped


def test_fixed_emitters_meet_by_their_pulses():
    a, b, c = SPOTS
    assert played_together([], 2e-3) == []
    assert played_together([a], 2e-3) == [tuple(POINTS[:1])]
    assert list(map(set, played_together(SPOTS, 2e-3))) == [set(POINTS)]
    assert list(map(set, played_together([a, b._replace(phase=0.5)], 2e-3))) == [{POINTS[0]}, {POINTS[1]}]
    slow = list(map(set, played_together([a, c._replace(rate_hz=8.0)], 2e-3)))
    assert slow == [{POINTS[0], POINTS[2]}, {POINTS[0]}, {POINTS[2]}]
    assert list(map(set, played_together([a, b._replace(alternate=True)], 2e-3))) == [{POINTS[0]}, {POINTS[1]}]
    assert len(played_together([FixedEmitter(0.02 + 0.001 * n, 0.05, 1.0 + 0.1 * n, str(n)) for n in range(80)], 2e-3)) == 64


def test_a_spot_that_nothing_can_move_is_refused(board, tmp_path):
    with pytest.raises(ConfigError, match=r"fixed emitters at \(0, 50\) mm cannot be composed: nothing can move"):
        build_bank(BankRequest(board, tmp_path / "bank", PITCH_M, emitters=[FixedEmitter(0.0, 0.05, 20.0, "rim")]))
    assert not list(tmp_path.iterdir())


def test_the_bank_of_a_spot_on_a_cell_has_its_entry_and_no_composition(board):
    grid = Grid.of(board.plate, PITCH_M)
    model = ResponseModel(board)
    assert compositions(board, grid, model, [FixedEmitter(*grid.place(7), 20.0, "cell")]) == []
    ((key, _),) = compositions(board, grid, model, [FixedEmitter(*grid.place(7), 20.0, "cell", 0.5)])
    assert [step for _, _, step in key] == [128]
