"""Memory of banks and foci: within what was allowed, by the peak of a process of its own, or refused before the work."""

import json
import subprocess
import sys

import pytest
from stress.boards import changed

from controller.bank_builder.build import build_bank
from controller.benchmark.focus_figures import focus_on
from controller.errors import ConfigError

RUN = """
import json, sys
from pathlib import Path
from stress.boards import changed
from controller.bank_builder.build import build_bank, peak_memory_mb
from controller.benchmark.focus_figures import focus_on
from controller.board.board import load_board
from controller.board.lookup import find_board
plate, what, allowed_mb, file = json.loads(sys.argv[1])
board = changed(load_board(find_board("simulated")), plate=plate)
if what == "bank":
    modes = build_bank(board, Path(file), 15e-3, measure_sgemm=False, memory_mb=allowed_mb).modes
else:
    modes = focus_on(board, [(0.08, 0.06), (0.1, 0.09)], allowed_mb)[0].modes.count
print(json.dumps([peak_memory_mb(), modes]))
"""


def peak_mb(tests_folder, *told):
    done = subprocess.run([sys.executable, "-c", RUN, json.dumps(told)], capture_output=True, check=True, cwd=tests_folder)
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    ("plate", "what", "allowed_mb", "modes"),
    [
        pytest.param({"decay_time_ms": 10.0}, "focus", 500, 1900, marks=pytest.mark.stress),  # 1.9 GB before
        pytest.param({"decay_time_ms": 10.0}, "bank", 350, 1900, marks=pytest.mark.stress),
        pytest.param({"decay_time_ms": 10e3}, "bank", 350, 1900, marks=pytest.mark.stress),
        pytest.param({"thickness_mm": 0.05}, "bank", 600, 19_400, marks=pytest.mark.stress),  # over 5 GB
        pytest.param({"thickness_mm": 0.05}, "focus", 900, 19_400, marks=pytest.mark.stress),
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
        build_bank(thin, tmp_path / "bank", 10e-3, measure_sgemm=False, memory_mb=memory_mb)
    with pytest.raises(ConfigError, match=r"a focus on 'simulated' with 19\d\d\d modes takes \d+ MB"):
        focus_on(thin, [(0.08, 0.06)], memory_mb)
    assert not list(tmp_path.iterdir())


def test_the_bank_is_the_same_whatever_memory_it_was_built_in(board, tmp_path):
    few = changed(board, plate={"thickness_mm": 5.0})
    for name, memory_mb in (("roomy", None), ("narrow", 214)):
        build_bank(few, tmp_path / name, 10e-3, measure_sgemm=False, memory_mb=memory_mb)
    assert (tmp_path / "roomy").read_bytes() == (tmp_path / "narrow").read_bytes()
    with pytest.raises(ConfigError, match="give --memory-mb"):
        build_bank(few, tmp_path / "narrow", 10e-3, measure_sgemm=False, memory_mb=205)
