"""The file of the live page's field view: read back by a decoder of its own, it gives what `focus` and the plate twin give."""

import json
import os
import resource

import msgspec
import numpy as np
import pytest

from controller.cli import main
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
from controller.errors import ConfigError
from controller.workshop.benchmark.focus.focus_emission import emission_at
from controller.workshop.benchmark.focus.focus_figures import emit
from controller.workshop.physics.pictures.field_file import BYTES_MAX, encoded_field, kept_field, write_field

BOARD = load_board(find_board("simulated"))
POINT_M = (0.1033, 0.0671)


class Decoded:
    """What a page has of it."""

    def __init__(self, data):
        assert data[:8] == b"HPfield1"
        end = 12 + int.from_bytes(data[8:12], "little")
        self.head = json.loads(data[12:end])
        assert end % 8 == 0
        for name, section in self.head["sections"].items():
            at = end + section["offset"]
            assert section["offset"] % 8 == 0
            setattr(self, name, np.frombuffer(data, np.dtype(section["type"]).newbyteorder("<"), section["count"], at))
        self.forces = self.forces.reshape(32, -1).T.astype(float)
        self.turn = self.term_turn.astype(float).reshape(-1, 2) @ [1, 1j]
        self.residue = self.term_residue.astype(float).reshape(-1, 2) @ [1, 1j]

    def shapes(self, x_m, y_m):
        along_x = np.sin(np.pi * self.half_waves_x * x_m / self.head["length_m"])
        return along_x * np.sin(np.pi * self.half_waves_y * y_m / self.head["width_m"])

    def words(self, x_m, y_m):
        weights = (self.shapes(x_m, y_m) * self.response_scale)[:, None] * self.forces
        response = self.response.reshape(-1, self.head["samples"]).astype(float)
        bits = (weights.T @ response)[:, ::-1] > 0
        return np.array([sum(int(bit) << q for q, bit in enumerate(column)) for column in bits.T], np.uint32)

    def modal(self, words):
        """Displacement of each mode at T."""
        bits = lambda word: (int(word) >> np.arange(32)) & 1  # noqa: E731
        volts = np.array([bits(word) for word in words], float) * self.head["supply_v"]
        before = bits(self.head["idle_word"]) * self.head["supply_v"]
        state = np.zeros(len(self.turn), complex)
        for now in volts:
            state = (state + (self.forces @ (now - before))[self.term_mode]) * self.turn
            before = now
        level = self.static * (self.forces @ (volts[-1] - bits(self.head["idle_word"]) * self.head["supply_v"]))
        np.add.at(level, self.term_mode, (self.residue * state).real)
        return level


@pytest.fixture(scope="module")
def decoded():
    data = encoded_field(BOARD)
    assert len(data) <= 3e6
    return Decoded(data)


@pytest.fixture(scope="module")
def emission():
    return emission_at(BOARD, [POINT_M])


def test_its_words_are_those_of_focus_but_where_a_response_is_next_to_zero(decoded, emission):
    words = decoded.words(*POINT_M)
    differing = np.bitwise_count(words ^ emission.words).sum() / (32 * len(words))
    assert 0 < differing < 0.01
    assert emit(emission.twin, words).at([POINT_M])[0] == pytest.approx(emission.field.at([POINT_M])[0], rel=2e-3)


def test_its_modes_move_as_those_of_the_plate_twin(decoded, emission):
    """The twin sums steps at the ticks of pin changes, in another form and in double precision."""
    found, twins = decoded.modal(emission.words), emission.field.modal
    assert np.abs(found - twins).max() < 1e-4 * np.abs(twins).max()
    slower = decoded.turn.copy()
    decoded.turn = slower ** (1 + 1e-4)  # the bound would show that
    assert np.abs(decoded.modal(emission.words) - twins).max() > 1e-3 * np.abs(twins).max()
    decoded.turn = slower


def changed(**plate):
    return msgspec.structs.replace(BOARD, plate=msgspec.structs.replace(BOARD.plate, **plate))


def test_a_plate_whose_shapes_are_no_sines_or_too_many_is_refused():
    with pytest.raises(ConfigError, match=r"shapes that are products of sines.*--movie` shows any plate"):
        encoded_field(changed(edges="free", thickness_mm=3.0))
    with pytest.raises(ConfigError, match=f"a field view has at most {BYTES_MAX >> 20}"):
        encoded_field(changed(length_mm=700.0, width_mm=600.0))


def test_the_command_writes_it_and_says_which_setting_serves_it(tmp_path, capsys):
    file = tmp_path / "plate.field"
    assert main(["focus", "--field-out", str(file), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said == {"file": str(file), "bytes": file.stat().st_size, "setting": f'field = "{file}"'}
    assert Decoded(file.read_bytes()).head["board"] == "simulated"
    assert main(["focus", "--field-out", str(tmp_path / "absent/plate.field")]) == 78
    assert capsys.readouterr().err.count("\n") == 1


def test_a_full_disk_leaves_the_file_before(tmp_path):
    """A limit of the process stands for it."""
    file = tmp_path / "plate.field"
    file.write_bytes(b"before")
    child = os.fork()
    if child == 0:
        code = 9
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
            write_field(BOARD, file)
        except ConfigError as error:
            code = 7 if "cannot be written" in str(error) else 8
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    assert (file.read_bytes(), [path.name for path in tmp_path.iterdir()]) == (b"before", ["plate.field"])


def test_it_is_kept_in_the_cache_under_what_it_was_computed_from(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    path = kept_field(BOARD)
    written = path.stat().st_mtime_ns
    assert kept_field(BOARD) == path
    assert path.stat().st_mtime_ns == written
    assert kept_field(changed(thickness_mm=0.6)) != path
