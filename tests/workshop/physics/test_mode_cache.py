"""Solved plates are kept, found again bit for bit, and never trusted further than their files can be read."""

from io import BytesIO
from zipfile import ZipFile

import numpy as np
import pytest

from controller.workshop.physics.modes import mode_cache, ritz
from controller.workshop.physics.modes.mode_cache import solved
from controller.workshop.physics.modes.ritz import PlateShape

SHAPES = [
    PlateShape((0.1, 0.07), (("free", "free"), ("clamped", "clamped")), 0.2),
    PlateShape((0.1, 0.07), (("free", "clamped"), ("foam", "foam")), 0.2, 1e6, 5e-3),
]
K = 200.0


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    monkeypatch.setattr(mode_cache, "WORTH_KEEPING", 0)
    return tmp_path / "modes"


@pytest.fixture
def computed(monkeypatch):
    """Plates that were computed, in the order of time."""
    plates, solve = [], ritz.solve
    monkeypatch.setattr(ritz, "solve", lambda plate, k: (plates.append(plate), solve(plate, k))[1])
    return plates


def same(one, other):
    assert one.condition == other.condition
    assert len(one.classes) == len(other.classes)
    for a, b in zip(one.classes, other.classes, strict=True):
        for name in ("wavenumber4", "coefficients", "foam_share"):
            assert np.array_equal(getattr(a, name), getattr(b, name))
        x = np.linspace(0, 0.1, 7)
        assert np.array_equal(a.x.values(x, 1), b.x.values(x, 1))
        assert np.array_equal(a.y.values(0.7 * x, -1), b.y.values(0.7 * x, -1))
    return True


@pytest.mark.parametrize("shape", SHAPES)
def test_what_was_computed_once_is_read_again_bit_for_bit(folder, computed, shape):
    first = solved(shape, K)
    assert same(first, solved(shape, K))
    assert computed == [shape]
    solved(shape, K * 1.0001)
    solved(PlateShape(shape.lengths_m, shape.ends, 0.2001, shape.foam, shape.foam_width_m), K)
    assert len(computed) == 3
    assert len(list(folder.glob("*.npz"))) == 3
    assert len(list(folder.iterdir())) == 3, "no temporary file is left"


def damaged(whole):
    """The same file cut short anywhere, empty, with a bit changed in an array, or something else."""
    yield from (whole[:length] for length in (0, 10, len(whole) // 2, len(whole) - 1))
    largest = max(ZipFile(BytesIO(whole)).infolist(), key=lambda member: member.file_size)
    end = whole.index(b"PK", largest.header_offset + largest.file_size)  # of the header that follows its data
    for at in np.linspace(end - largest.file_size // 2, end - 1, 5).astype(int):
        yield whole[:at] + bytes([whole[at] ^ 16]) + whole[at + 1 :]
    yield b"PK\x03\x04 but no archive"
    yield np.arange(3).tobytes()


def test_a_damaged_file_is_computed_again_and_replaced(folder, computed):
    first = solved(SHAPES[0], K)
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    for content in damaged(whole):
        file.write_bytes(content)
        assert same(first, solved(SHAPES[0], K))
        assert same(first, solved(SHAPES[0], K))
    assert len(computed) == 1 + len(list(damaged(whole))), "each was noticed, and computed once"


def test_modes_of_other_code_are_not_used(folder, computed, monkeypatch, tmp_path):
    solved(SHAPES[0], K)
    changed = tmp_path / "ritz.py"
    changed.write_text("other code")
    monkeypatch.setattr(ritz, "__file__", str(changed))
    solved(SHAPES[0], K)
    assert len(computed) == 2


def test_without_a_place_to_keep_them_modes_are_computed(monkeypatch, tmp_path, computed):
    occupied = tmp_path / "a file"
    occupied.touch()
    monkeypatch.setenv("STATE_DIRECTORY", str(occupied))
    monkeypatch.setattr(mode_cache, "WORTH_KEEPING", 0)
    assert same(solved(SHAPES[0], K), solved(SHAPES[0], K))
    assert len(computed) == 2


def test_the_oldest_of_many_files_go(folder, monkeypatch):
    monkeypatch.setattr(mode_cache, "KEPT_FILES", 2)
    for number in range(4):
        solved(SHAPES[0], K + number)
        assert len(list(folder.iterdir())) == min(number + 1, 2)


def test_what_is_computed_at_once_is_not_kept(monkeypatch, tmp_path):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    solved(SHAPES[0], K)
    assert not list(tmp_path.iterdir())
