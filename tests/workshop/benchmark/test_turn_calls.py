"""How many calls a turn of the loop takes: an upper bound, the same on every machine."""

from controller.device.bank.reader import Bank
from tests.workshop.benchmark.turn_calls import SCENE, profile

CHANGES = 100  # of module, as measured; fewer are welcome: lower it then


def test_a_turn_with_two_fingers_does_not_wander_through_more_modules(board, bank_file, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    with Bank.open(bank_file, board) as bank:
        counted = profile(board, bank, scene)
    assert 0 < counted.changes <= CHANGES
    assert counted.changes < counted.calls
    assert counted.edges["controller.device.loop.playing.sending", "controller.device.fpga.session:upload_and_play"] == 1
