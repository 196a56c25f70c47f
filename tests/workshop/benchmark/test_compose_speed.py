"""The plain C beside which composing is timed does the same work: its words are equal."""

import pytest

from controller.device.bank.grid import Grid
from controller.device.bank.reader import Bank
from controller.device.waveforms.composition import Composer
from controller.workshop.benchmark.device.plain_c import PlainC
from tests.workshop.benchmark.compose_speed import bank_for, compared, scenes_of


@pytest.mark.parametrize("on_grid", [False, True])
def test_plain_c_composes_the_same_words(board, tmp_path, on_grid):
    grid = Grid.of(board.plate, board.bank.pitch_mm * 1e-3)
    scenes = [scene for fingers in (1, 2, 4, 10) for scene in scenes_of(grid, fingers, on_grid, 1.0, scenes=2)]
    with Bank.open(bank_for(tmp_path, scenes)) as bank:
        composer = Composer(bank, board.idle_word)
        words = [composer.compose(scene).tobytes() for scene in scenes]
        reference = PlainC(tmp_path, bank, board.idle_word)
        for scene, expected in zip(scenes, words, strict=True):
            ours_us, plain_us = compared(composer, reference, scene, turns=1)
            assert ours_us > 0
            assert plain_us > 0
            assert reference.words_bytes() == expected
