"""Files of every format with damaged bytes: an effect or one line with exit code 78, never a traceback."""

import random
from pathlib import Path

import pytest

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.errors import ConfigError
from controller.workshop.clips.importing import READERS, imported

FILES = sorted(file for file in (Path(__file__).parent / "files").iterdir() if file.suffix in READERS)
BOARD = load_board(find_board("simulated"))
WORDS = (
    b"null",
    b"-1",
    b"1e999",
    b"NaN",
    b"[]",
    b"{}",
    b'""',
    b"99999999999999999999",
    b"1e-400",
    b"\xff\xfe",
    b"\x00",
    b"&#0;",
    b"<a>",
)


def mutated(data, chance):
    """Bytes with one to four changes: of a bit, cut out, doubled, cut off, or replaced by what parsers dislike."""
    changed = bytearray(data)
    for _ in range(chance.randint(1, 4)):
        start = chance.randrange(len(changed) + 1)
        end = min(start + chance.choice((1, 3, 20, 200)), len(changed))
        match chance.randrange(6):
            case 0 if start < len(changed):
                changed[start] ^= 1 << chance.randrange(8)
            case 1:
                del changed[start:end]
            case 2:
                changed[start:start] = changed[start:end]
            case 3 if chance.random() < 0.2:
                del changed[start:]
            case 4:
                changed[start:end] = chance.choice(WORDS)
            case _:
                digits = [place for place, byte in enumerate(changed) if byte in b"0123456789"]
                if digits:
                    changed[chance.choice(digits)] = chance.choice(b"0123456789-.eE")
    return bytes(changed)


@pytest.mark.parametrize("count", [3_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_a_mutated_file_is_an_effect_or_one_line(count, tmp_path, capsys):
    """The reading of all, and the whole command of every hundredth, since the command line itself takes most of the time."""
    chance = random.Random(count)
    whole = {file: file.read_bytes() for file in FILES}
    refused = 0
    for number in range(count):
        origin = FILES[number % len(FILES)]
        file = tmp_path / f"mutated{origin.suffix}"
        file.write_bytes(mutated(whole[origin], chance))
        said = refusal(file)
        refused += bool(said)
        assert not said or (said.startswith(f"{file}: ") and "\n" not in said and said.isprintable()), f"{number}: {said!r}"
        if number % 100 == 0:
            assert main(["effect", "import", str(file), "--json"]) == (78 if said else 0)
            out, err = capsys.readouterr()
            assert err == (f"haptic-panel: {said}\n" if said else "")
            assert bool(out) is not bool(said)
    assert count / 5 < refused < count, "changes that matter, and some that do not"


def refusal(file):
    """Why a file is refused; empty: it is not."""
    try:
        imported([file], BOARD, "command", 50, 150)
    except ConfigError as error:
        return str(error)
    return ""
