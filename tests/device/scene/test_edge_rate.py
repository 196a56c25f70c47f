"""Warnings for scenes that would exceed the edge limits of the board."""

import msgspec
from device.scene.scenes import BOARD, CLICK, TEXTURE, TRAIN, square

from controller.device.scene.edge_rate import edge_warnings
from controller.device.scene.scene import load_scene


def on_board(tmp_path, text, **limits):
    """The scene on the simulated board with other limits."""
    file = tmp_path / "scene.toml"
    file.write_text(text)
    board = msgspec.structs.replace(BOARD, limits=msgspec.structs.replace(BOARD.limits, **limits))
    return load_scene(file, board), board


def test_repetitions_that_the_fpgas_edge_limits_would_end_are_warned_of(tmp_path):
    emitters = [
        square(f'{{ effect = "always", rate_hz = {rate_hz} }}', name, x_mm) for name, rate_hz, x_mm in (("a", 20, 0), ("b", 30, 50))
    ]
    train = square(TRAIN, "c", 100)
    text = "".join(f"[[regions]]\n{region}\n" for region in (*emitters, train))  # 20 + 30 + 100 emissions a second
    scene, board = on_board(tmp_path, text, max_channel_edge_rate_hz=15_000.0, max_total_edge_rate_hz=400_000.0)
    assert edge_warnings(scene, board, 100, 2666) == []
    (channel,) = edge_warnings(scene, board, 101, 2666)
    assert "up to 150 emissions a second make 1.515e+04 edges a second on one channel" in channel
    assert "limits.max_channel_edge_rate_hz = 15000 of board 'simulated': the FPGA will switch off" in channel
    (together,) = edge_warnings(scene, board, 100, 2667)
    assert "on all channels, above limits.max_total_edge_rate_hz = 400000" in together
    assert len(edge_warnings(scene, board, 101, 2667)) == 2


def test_fixed_emitters_of_one_rate_are_one_emission_and_no_scene_plays_more_than_the_duty_allows(tmp_path):
    emitters = [square('{ effect = "always", rate_hz = 50 }', name, x_mm) for name, x_mm in (("a", 0), ("b", 50))]
    text = "".join(f"[[regions]]\n{region}\n" for region in emitters)
    assert edge_warnings(*on_board(tmp_path, text, max_channel_edge_rate_hz=5000.0), 100, 100) == []
    text += f"[[regions]]\n{square(TRAIN, 'c', 100)}\n"
    assert edge_warnings(*on_board(tmp_path, text, max_duty=0.2, max_channel_edge_rate_hz=10_000.0), 100, 100) == []
    assert edge_warnings(*on_board(tmp_path, text, max_duty=0.202, max_channel_edge_rate_hz=10_000.0), 100, 100)


def test_a_scene_without_repetitions_is_warned_of_nothing(tmp_path):
    scene, board = on_board(tmp_path, f"[[regions]]\n{square(CLICK + ',' + TEXTURE)}\n", max_channel_edge_rate_hz=1.0)
    assert edge_warnings(scene, board, 1000, 32_000) == []
