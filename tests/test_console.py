"""What commands print: in a locale that lacks characters, into full files and closed pipes, and when Ctrl-C is early."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tables import each_row

import controller

PACKAGE = Path(controller.__file__).parent
COMMAND = [sys.executable, "-m", "controller"]


def run(*arguments, **how):
    """A command: exit code, standard output, standard error; no other setting of Python's than those given."""
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "env": in_locale("utf-8")} | how
    done = subprocess.run([*COMMAND, *arguments], check=False, **how)
    said = (done.stderr or b"").decode(errors="replace")
    assert "Traceback" not in said, said
    assert "Exception ignored" not in said, said
    return done.returncode, done.stdout, said


def in_locale(encoding):
    others = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return others | {"PYTHONIOENCODING": encoding}


@each_row("encoding", ["latin-1", "ascii", "cp1252"])
def test_a_locale_that_lacks_characters_prints_similar_ones(encoding):
    code, out, said = run("board", "reference", env=in_locale(encoding))
    assert (code, said) == (0, "")
    assert "≤" not in out.decode(encoding)
    assert len(out) > 10_000
    code, out, _ = run("board", "check", "simulated", env=in_locale(encoding))
    assert code == 0
    assert ("µs" if encoding != "ascii" else "us") in out.decode(encoding)


def test_a_schema_is_the_same_in_every_locale():
    import json

    reported = {encoding: run("board", "schema", env=in_locale(encoding))[1].decode(encoding) for encoding in ("utf-8", "latin-1")}
    assert json.loads(reported["utf-8"]) == json.loads(reported["latin-1"])


def test_a_message_is_printed_in_any_locale_too():
    code, _, said = run("board", "check", "nöwhere→", env=in_locale("ascii"))
    assert code == 78
    assert "->' not found" in said
    assert said.count("\n") == 1


SHORT, LONG = ("board", "check", "simulated"), ("board", "reference")


@each_row("arguments", [SHORT, LONG, ("--help",), ("--version",)])
def test_output_that_is_full_is_one_line_and_exit_code_1(arguments):
    with Path("/dev/full").open("wb") as full:
        code, _, said = run(*arguments, stdout=full)
    assert code == 1
    assert said == "haptic-panel: the output cannot be written (No space left on device)\n"


@each_row("arguments", [SHORT, LONG, ("--help",)])
def test_output_that_nobody_reads_any_more_is_exit_code_1_in_silence(arguments):
    reading, writing = os.pipe()
    os.close(reading)
    code, _, said = run(*arguments, stdout=writing)
    os.close(writing)
    assert (code, said) == (1, "")


@pytest.mark.parametrize("arguments", [SHORT, LONG])
def test_without_standard_output_the_work_is_done(arguments):
    code, _, said = run(*arguments, stdout=None, preexec_fn=lambda: os.close(1))
    assert (code, said) == (0, "")


def test_messages_that_cannot_be_written_change_no_exit_code():
    with Path("/dev/full").open("wb") as full:
        assert run("board", "check", "nowhere", stderr=full)[0] == 78
    assert run("board", "check", "nowhere", stderr=None, preexec_fn=lambda: os.close(2))[0] == 78


def test_an_interrupt_while_the_command_line_is_imported_is_one_line():
    """Sent by what is imported at that time, so that it comes neither sooner nor later."""
    code = (
        "import importlib.abc, os, signal, sys\n"
        "class Early(importlib.abc.MetaPathFinder):\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'controller.cli': os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Early())\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # whoever runs the tests may have it ignored
        "from controller.__main__ import main\nsys.exit(main())"
    )
    done = subprocess.run([sys.executable, "-c", code, "--version"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "haptic-panel: interrupted\n")


def test_an_interrupt_that_a_shell_has_switched_off_stays_so():
    command = f"trap '' INT; {sys.executable} -m controller board check simulated & kill -INT $!; wait $!"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "PASS" in done.stdout


def test_every_program_prints_through_one_writer():
    """So that the next one holds in any locale too."""
    for path in PACKAGE.rglob("*.py"):
        text = path.read_text()
        if path.name not in {"console.py", "log.py"}:
            assert "sys.stdout.write" not in text, path
            assert "sys.stderr.write" not in text, path
            assert "print(" not in text.replace("fingerprint(", ""), path
