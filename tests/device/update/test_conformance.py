"""The conformance suite of The Update Framework (theupdateframework/tuf-conformance) against the device's own classes.

The suite is not part of this repository. With a checkout of it, and faketime installed:

    TUF_CONFORMANCE=/path/to/tuf-conformance .venv/bin/pytest -n0 -m slow tests/device/update/test_conformance.py -s
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SUITE = os.environ.get("TUF_CONFORMANCE", "")


@pytest.mark.slow
@pytest.mark.skipif(not SUITE, reason="set TUF_CONFORMANCE to a checkout of theupdateframework/tuf-conformance")
@pytest.mark.skipif(not shutil.which("faketime"), reason="the suite changes its clock by faketime: apt install faketime")
def test_the_suite_passes(tmp_path):
    client = tmp_path / "client"
    client.write_text(f'#!/bin/sh\nexec {sys.executable} {Path(__file__).with_name("conformance_client.py")} "$@"\n')
    client.chmod(0o755)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tuf_conformance", "--entrypoint", str(client)]
    done = subprocess.run(command, cwd=SUITE, capture_output=True, text=True, check=False)
    print(done.stdout.splitlines()[-1])
    assert done.returncode == 0, done.stdout
