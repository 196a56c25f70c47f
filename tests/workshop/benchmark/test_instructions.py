"""Instructions of an upload and of a play from a slot: upper bounds, the same however busy the machine is."""

import platform
import shutil

import pytest
from compiled_kernels import COMPILED

from controller.device import kernel
from tests.workshop.benchmark.instructions import count

EMISSIONS = 300
# Medians, of an interpreted loop; fewer are welcome: lower them then. Since waveforms are sent ahead, uploads are those that could
# not be: 586,000 on 2026-11-27, when all of them had been 456,000 the day before
MOST = {"uploads": 475_000 if len(COMPILED) > 1 else 508_000, "resident": 198_000}

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(shutil.which("valgrind") is None, reason="apt-get install valgrind"),
    pytest.mark.skipif(not kernel.COMPILED, reason="the bounds are the compiled kernel's"),
    pytest.mark.skipif(platform.machine() != "x86_64", reason="the bounds are x86's"),
]


def test_an_emission_takes_no_more_instructions_than_it_did(bank_file, tmp_path):
    counted = count(bank_file, EMISSIONS, tmp_path)
    for kind, most in MOST.items():
        assert counted[kind]["count"] >= 10
        assert 1_000 < counted[kind]["p50"] <= most
