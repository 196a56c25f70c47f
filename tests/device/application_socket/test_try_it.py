"""The lines of the README's "Try it", pasted one after the other into a shell."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from controller.workshop.simulation.conformance import CONVERSATION, steps_of

README = Path(__file__).parents[3] / "controller" / "device" / "application_socket" / "README.md"

PROGRAMS = {"python": sys.executable, "haptic-panel": f"{sys.executable} -m controller"}


@pytest.fixture
def lines(tmp_path):
    """As written, with the interpreter that runs the tests and a socket of their own."""
    section = re.search(r"^## Try it\n(.*?)^## ", README.read_text(), re.MULTILINE | re.DOTALL)[1]
    block = "".join(re.findall(r"^```sh.*?\n(.*?)^```", section, re.MULTILINE | re.DOTALL))
    own = re.sub(r"^\.venv/bin/(haptic-panel|python)", lambda m: PROGRAMS[m[1]], block, flags=re.MULTILINE)
    text = own.replace("/tmp/panel.sock", str(tmp_path / "panel.sock"))
    return text.splitlines()


def shell(line):
    return subprocess.run(["sh", "-c", line], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def test_each_line_works_when_it_is_pasted(lines, tmp_path):
    first, second, third, conformance = lines
    begun = shell(first)  # which reads both pipes to their end: the panel that goes on does not hold them
    text = begun.stderr
    assert begun.returncode == 0, text
    assert text.startswith("haptic-panel: building a bank"), "it says at once what it does"
    pid = int(re.search(r"`kill (\d+)`", text)[1])
    try:
        done = shell(second)
        assert (done.returncode, done.stderr) == (0, "")
        assert '"played"' in done.stdout
        with subprocess.Popen(["sh", "-c", f"exec {third}"], stdout=subprocess.PIPE, text=True) as touches:
            assert '"kind":"touch"' in touches.stdout.readline()
            touches.terminate()
        done = shell(conformance)
        assert (done.returncode, done.stderr) == (0, ""), done.stdout + done.stderr
        assert done.stdout.endswith(f"{len(steps_of(CONVERSATION))} steps, all as recorded\n")
        wrong = tmp_path / "wrong.json"
        wrong.write_text(json.dumps({"steps": [{"say": {"kind": "hello", "id": 1}, "answer": {"length_mm": 211.0}}]}))
        done = shell(f"{conformance} --conversation {wrong}")
        assert done.returncode == 1
        assert 'step 1: {"kind": "hello", "id": 1}: answered with' in done.stderr
    finally:
        os.kill(pid, signal.SIGTERM)


def test_what_cannot_begin_ends_with_its_own_code(lines):
    done = shell(lines[0].replace("#", "--board nothing #"))
    assert done.returncode == 78
    assert "board 'nothing' not found" in done.stderr
