"""A scene from the lines of its regions."""

import pytest
from device.scene.scenes import BOARD

from controller.device.scene.scene import load_scene


@pytest.fixture
def scene_of(tmp_path):
    """Loads a scene from the lines of its regions, with effects of its own, on a board."""

    file = tmp_path / "scene.toml"

    def load(*regions, effects="", board=BOARD):
        file.write_text(effects + "".join(f"[[regions]]\n{region}\n" for region in regions))
        return load_scene(file, board)

    load.file = file
    return load
