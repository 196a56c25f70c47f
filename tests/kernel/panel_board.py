"""The board of the service under test: the simulated panel with another touch panel and another link."""

import re
from pathlib import Path

BOARD = Path("/etc/haptic-panel/boards/panel/board.toml")


def table(text, name, lines):
    """A board's text with a table replaced."""
    replaced, count = re.subn(rf"^\[{name}\]\n(?:(?!\[).*\n)*", f"[{name}]\n{lines}\n", text, flags=re.MULTILINE)
    assert count == 1, name
    return replaced


def write(touch, link="", **limits):
    """Give the board a touch panel, other lines of its link, other limits, and time for a slow machine."""
    text = table(BOARD.read_text(), "touch", f"x_mm_from_axes = [210.0, 0.0, 0.0]\ny_mm_from_axes = [0.0, 148.0, 0.0]\n{touch}")
    text = table(text, "link", link) if link else text
    for name, value in {"heartbeat_timeout_ms": 250.0, **limits}.items():
        text, count = re.subn(rf"^{name} = .*", f"{name} = {value}", text, flags=re.MULTILINE)
        assert count == 1, name
    if "[application_socket]" not in text:
        text += '\n[application_socket]\npath = "/run/haptic-panel/panel.sock"\n'
    BOARD.write_text(text)
