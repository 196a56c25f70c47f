"""What a device gets, which is fetched and built: installed from the lock files, and a release with its compiled loop."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from compiled_copy import copy_with
from workshop.publish.test_make_release import contents

from controller.workshop.publish.release_folder import read_release

ROOT = Path(__file__).parents[3]
LOCKS = ROOT / "systemd"

pytestmark = pytest.mark.kernel


def run(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, **more)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_fresh_environment_is_installed_from_the_lock_files(tmp_path):
    run(sys.executable, "-m", "venv", tmp_path / "venv")
    python = tmp_path / "venv/bin/python"
    install = (python, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-deps")
    for name in ("build.lock", "requirements.lock"):
        run(*install, "--require-hashes", "--no-build-isolation", "-r", LOCKS / name)
    run(*install, "--no-build-isolation", ROOT)
    assert "No broken requirements" in run(python, "-m", "pip", "check")
    said = run(python, "-I", "-c", "import numpy, spidev, evdev, gpiod, msgspec, tuf.ngclient, prometheus_client, pip; print('ok')")
    assert said == "ok\n"
    assert run(python, "-I", "-m", "controller", "--version", cwd=tmp_path).startswith("haptic-panel ")


@pytest.fixture(scope="module")
def make(tmp_path_factory):
    """A function that makes a release at a place below one folder, for a time zone."""
    program = [sys.executable, "-m", "controller", "update", "make-release"]
    about = ["--version", "1.0.0", "--counter", 1, "--board", "simulated"]
    pip_cache = run(sys.executable, "-m", "pip", "cache", "dir").strip()
    folder = tmp_path_factory.mktemp("releases")

    def made(name, umask, zone):
        out = folder / name
        out.parent.mkdir(exist_ok=True)
        environment = os.environ | {"XDG_CACHE_HOME": str(out.parent / "cache"), "PIP_CACHE_DIR": pip_cache, "TZ": zone}
        run(*program, out, *about, cwd=ROOT, env=environment, umask=umask)
        return out

    return made


@pytest.fixture(scope="module")
def release(make):
    return make("a", 0o022, "UTC")


def test_a_release_made_twice_is_the_same_to_the_byte(release, make):
    """Everything, the compiled loop too, is built again, in another folder, by another cache, umask and time zone."""
    other = make("b/deeper", 0o077, "Pacific/Auckland")
    wheels = {file.path.removeprefix("wheels/") for file in read_release(release).files if file.path.startswith("wheels/")}
    bill = json.loads((release / "sbom.cdx.json").read_bytes())
    parts = [part for part in [*bill["components"], bill["metadata"]["component"]] if "purl" in part]
    named = {(part["name"].replace("-", "_"), part["version"]) for part in parts}
    assert all(part["licenses"] for part in parts), "each wheel tells its licence"
    (numpy,) = [part for part in parts if part["name"] == "numpy"]
    assert any("openblas" in library["name"] for library in numpy["components"]), "and what it brings along"
    assert named == {tuple(wheel.split("-")[:2]) for wheel in wheels}
    assert "serialNumber" not in bill
    made, again = contents(release), contents(other)
    assert made.keys() == again.keys()
    assert [name for name in made if made[name] != again[name]] == []  # the bytes themselves would be compared for minutes


def test_the_compiled_loop_of_a_release_passes_its_tests(release, tmp_path):
    (wheel,) = (release / "wheels").glob("haptic_panel-*.whl")
    assert re.search(r"-(cp\d+)-\1-linux_", wheel.name), "for this version of CPython alone"
    copy = tmp_path / "checkout"
    copy_with(wheel, copy)
    code = "from controller.device.loop import event_loop\nfrom controller.device.loop.playing import playback\n"
    code += "print(event_loop, playback)"
    environment = os.environ | {"PYTHONPATH": str(copy)}
    assert run(sys.executable, "-c", code, cwd=copy, env=environment).count(".so") == 2
    rooms = [f"tests/device/{room}" for room in ("loop", "touch", "scene", "fpga", "waveforms", "bank", "application_socket")]
    rooms += ["tests/workshop/simulation/test_same_bytes.py", "tests/test_metrics.py"]
    chosen = "not slow and not stress and not kernel and not gateware and not interpreted"
    run(sys.executable, "-m", "pytest", "-q", "-n0", "-m", chosen, *rooms, cwd=copy, env=environment)
