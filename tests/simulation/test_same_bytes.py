"""A device sends the same bytes at the same times with the compiled kernel and with NumPy alone."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("sent_digest.py")
RECORDINGS = Path(__file__).parents[1] / "touch/recordings"


def sent(kernel, bank_file, recording):
    environment = os.environ | {"HAPTIC_PANEL_KERNEL": kernel, "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, SCRIPT, bank_file, RECORDINGS / recording]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return run.stdout.split()


@pytest.mark.skipif(importlib.util.find_spec("controller.kernel._kernel") is None, reason="built without a C compiler")
def test_the_same_bytes_are_sent_with_either_kernel(bank_file):
    compiled, alone = (sent(kernel, bank_file, "ep0430m09.4-finger-drag-down.events") for kernel in ("compiled", "numpy"))
    assert compiled[0] == "True"
    assert alone == ["False", *compiled[1:]]
    uploads, composed = map(int, compiled[2:])
    assert uploads >= composed > 10
