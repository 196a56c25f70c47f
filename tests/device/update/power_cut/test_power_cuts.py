"""Every state in which a power cut may leave a device: as root (or with sudo), on a loop device and FUSE."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
AS_ROOT = [] if os.geteuid() == 0 else ["sudo"]
PHASES = {"download", "install", "switch", "trial", "waiting", "promotion", "promoted", "fall-back", "fallen-back", "roll-back"}
POINTS_MIN = 1000


def power_cuts(*options):
    """Exit code, states of each phase, different crash points and all output of power_cuts.py."""
    subprocess.run([HERE.parents[2] / "kernel/install_packages.sh", "libfuse3-3", "e2fsprogs"], check=True, capture_output=True)
    command = [*AS_ROOT, "setpriv", "--pdeathsig", "TERM", sys.executable, HERE / "power_cuts.py", *options]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    phases = dict(re.findall(r"^(\S+): (\d+) states$", done.stdout, re.MULTILINE))
    points = re.search(r"^(\d+) different crash points", done.stdout, re.MULTILINE)
    assert points, done.stdout
    return done.returncode, {phase: int(count) for phase, count in phases.items()}, int(points[1]), done.stdout


@pytest.mark.kernel
def test_no_power_cut_loses_a_release_or_mixes_two():
    """A quarter of the states."""
    code, phases, points, output = power_cuts("--every", "4", "--subsets", "1", "--carry-on", "40")
    assert code == 0, output
    assert phases.keys() >= PHASES, output
    assert points >= POINTS_MIN // 4, output


@pytest.mark.parametrize(
    "how",
    [
        pytest.param("sync", marks=pytest.mark.kernel),
        *(pytest.param(how, marks=pytest.mark.slow) for how in ("install", "in-place")),
    ],
)
def test_what_is_done_wrong_is_found(how):
    code, _, _, output = power_cuts("--every", "5", "--break", how)
    assert code == 1, output


@pytest.mark.slow
def test_no_power_cut_loses_a_release_or_mixes_two_with_many_subsets():
    code, phases, points, output = power_cuts("--subsets", "10", "--carry-on", "40")
    assert code == 0, output
    assert phases.keys() >= PHASES, output
    assert points >= 2 * POINTS_MIN, output
