"""A device sends the same bytes at the same times with either kernel, and in virtual time whatever the host's clocks say."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("sent_digest.py")
RECORDINGS = Path(__file__).parents[2] / "device/touch/recordings"


def sent(kernel, bank_file, recording, *seed):
    environment = os.environ | {"HAPTIC_PANEL_KERNEL": kernel, "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, SCRIPT, bank_file, RECORDINGS / recording, *seed]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return run.stdout.split()


@pytest.mark.skipif(importlib.util.find_spec("controller.device.kernel._kernel") is None, reason="built without a C compiler")
def test_the_same_bytes_are_sent_with_either_kernel(bank_file):
    compiled, alone = (sent(kernel, bank_file, "ep0430m09.4-finger-drag-down.events") for kernel in ("compiled", "numpy"))
    assert compiled[0] == "True"
    assert alone == ["False", *compiled[1:]]
    uploads, composed = map(int, compiled[2:])
    assert uploads >= composed > 10


def test_in_virtual_time_nothing_depends_on_the_hosts_clocks(bank_file):
    recording = "ep0430m09.4-finger-drag-down.events"
    assert sent("compiled", bank_file, recording) == sent("compiled", bank_file, recording, "7")
