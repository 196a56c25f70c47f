"""Memory of banks and foci: within what was allowed, by the peak of a process of its own, or refused before the work."""

import json
import subprocess
import sys

import numpy as np
import pytest
from stress.boards import changed, focus_on

from controller.errors import ConfigError
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics import audible
from controller.workshop.physics.audible import surface_spectrum

RUN = """
import json, sys
from pathlib import Path
from stress.boards import changed, focus_on
from controller.workshop.bank_builder.build import build_bank, peak_memory_mb
from controller.workshop.bank_builder.request import BankRequest
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
plate, what, allowed_mb, file = json.loads(sys.argv[1])
board = changed(load_board(find_board("simulated")), plate=plate)
if what == "bank":
    modes = build_bank(BankRequest(board, Path(file), 15e-3, memory_mb=allowed_mb)).modes
else:
    modes = focus_on(board, [(0.08, 0.06), (0.1, 0.09)], allowed_mb)[0].modes.count
print(json.dumps([peak_memory_mb(), modes]))
"""


def peak_mb(tests_folder, *reported):
    done = subprocess.run([sys.executable, "-c", RUN, json.dumps(reported)], capture_output=True, check=True, cwd=tests_folder)
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    ("plate", "what", "allowed_mb", "modes"),
    [
        pytest.param({"decay_time_ms": 10.0}, "focus", 500, 1900, marks=pytest.mark.stress),  # 1.9 GB before
        pytest.param({"decay_time_ms": 10.0}, "bank", 350, 1900, marks=pytest.mark.stress),
        pytest.param({"decay_time_ms": 10e3}, "bank", 350, 1900, marks=pytest.mark.stress),
        pytest.param({"thickness_mm": 0.05}, "bank", 600, 19_400, marks=pytest.mark.stress),  # over 5 GB
        pytest.param({"thickness_mm": 0.05}, "focus", 1100, 19_400, marks=pytest.mark.stress),
    ],
)
def test_the_peak_of_a_process_is_within_what_it_was_allowed(request, tmp_path, plate, what, allowed_mb, modes):
    tests_folder = request.config.rootpath / "tests"
    peak, found = peak_mb(tests_folder, plate, what, allowed_mb, str(tmp_path / "bank"))
    assert found == pytest.approx(modes, rel=0.02)
    assert peak <= allowed_mb


@pytest.mark.parametrize("memory_mb", [100, float("nan")])
def test_what_cannot_fit_is_refused_with_what_it_needs_and_nothing_is_left(board, tmp_path, memory_mb):
    thin = changed(board, plate={"thickness_mm": 0.05})
    with pytest.raises(
        ConfigError, match=r"a bank of 'simulated' with 19\d\d\d modes .* takes \d+ MB, .* give --memory-mb \d+ or more"
    ):
        build_bank(BankRequest(thin, tmp_path / "bank", 10e-3, memory_mb=memory_mb))
    with pytest.raises(ConfigError, match=r"a focus on 'simulated' with 19\d\d\d modes takes \d+ MB"):
        focus_on(thin, [(0.08, 0.06)], memory_mb)
    assert not list(tmp_path.iterdir())


def test_the_bank_is_the_same_whatever_memory_it_was_built_in(board, tmp_path):
    few = changed(board, plate={"thickness_mm": 5.0})
    for name, memory_mb in (("roomy", None), ("narrow", 214)):
        build_bank(BankRequest(few, tmp_path / name, 10e-3, memory_mb=memory_mb))
    assert (tmp_path / "roomy").read_bytes() == (tmp_path / "narrow").read_bytes()
    with pytest.raises(ConfigError, match="give --memory-mb"):
        build_bank(BankRequest(few, tmp_path / "narrow", 10e-3, memory_mb=205))


def test_sound_is_the_same_whatever_number_of_frequencies_is_transformed_at_once(board, monkeypatch):
    """A plate that rings for 10 s has 1.6 million frequencies below 16 kHz: 2 GB of spectra of 32 channels at once."""
    thick = changed(board, plate={"thickness_mm": 20.0})
    words = np.random.default_rng(9).integers(0, 1 << 32, 1000, np.uint64).astype(np.uint32)
    whole, step_hz = surface_spectrum(thick, words, thick.idle_word)[1:]
    assert len(whole) > 128
    monkeypatch.setattr(audible, "TRANSFORMED", 64)
    parts, same_hz = surface_spectrum(thick, words, thick.idle_word)[1:]
    assert same_hz == step_hz
    assert np.abs(parts - whole).max() <= 1e-9 * whole.max()
