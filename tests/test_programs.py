"""Programs of others: one that fails, hangs, is missing or talks is reported in one line, and has no second life."""

import os
import signal
import sys

import pytest
from tables import each_row

from controller.programs import CannotStart, ProgramError, run_program

PYTHON = [sys.executable, "-c"]


def failed(*command, limit_s=60.0, **how):
    with pytest.raises(ProgramError) as caught:
        run_program(command, limit_s, **how)
    assert "\n" not in str(caught.value)
    return caught.value


def test_what_a_program_writes_is_kept_apart():
    assert run_program([*PYTHON, "import sys; print('out'); print('err', file=sys.stderr)"], 60.0) == ("out\n", "err\n")


@each_row(
    ("code", "said"),
    [
        ("import sys; print('much'); sys.exit('first\\nlast of all\\n\\n')", "ended with exit code 1: last of all"),
        ("print('on stdout'); exit(3)", "ended with exit code 3: on stdout"),
        ("import sys; sys.stdout.buffer.write(b'caf\\xe9 \\x1b[31mred'); exit(3)", "ended with exit code 3: caf\ufffd [31mred"),
        ("exit(4)", "ended with exit code 4"),
        ("import os; os.kill(os.getpid(), 11)", "was ended by SIGSEGV"),
    ],
)
def test_a_failure_has_how_it_ended_and_the_last_line(code, said):
    error = failed(*PYTHON, code)
    assert str(error) == f"{sys.executable} {said}"
    assert error.exit_code == 1


def test_all_that_it_said_is_kept_for_who_looks_for_more():
    error = failed(*PYTHON, "import sys; print('line one'); sys.exit('line two')")
    assert (error.code, error.said) == (1, "line two\nline one\n")


def test_one_that_is_missing_is_named_with_its_package_and_has_no_second_attempt(tmp_path):
    assert str(failed("/no/such", attempts=3)) == "/no/such cannot be started (No such file or directory)"
    error = failed("/no/such", package="such")
    assert str(error) == "/no/such is not installed: apt-get install such"
    assert isinstance(error, CannotStart)
    assert error.exit_code == 78
    (tmp_path / "plain").write_text("")
    assert "Permission denied" in str(failed(tmp_path / "plain"))


def test_one_that_hangs_is_ended_with_all_that_it_started(tmp_path):
    """The grandchild holds the standard output open, and a pipe that shows whether it lives."""
    alive = tmp_path / "alive"
    os.mkfifo(alive)
    reading = os.open(alive, os.O_RDONLY | os.O_NONBLOCK)
    error = failed("sh", "-c", f"echo begun; exec 9>{alive}; sleep infinity & wait", limit_s=0.5)
    assert str(error) == "sh did not end within 0.5 s: begun"
    os.set_blocking(reading, True)
    assert os.read(reading, 1) == b"", "nobody has it open any more"
    os.close(reading)


def test_one_that_leaves_a_child_behind_is_not_waited_for():
    child = int(run_program(["sh", "-c", "sleep infinity & echo $!"], 60.0).out)
    os.kill(child, signal.SIGKILL)


@pytest.fixture
def fails_twice(tmp_path):
    """A program that succeeds when it is run the third time."""
    program = tmp_path / "program"
    program.write_text('#!/bin/sh\necho . >>"$0.runs"; [ $(wc -l <"$0.runs") = 3 ] || { echo busy >&2; exit 1; }\necho done\n')
    program.chmod(0o755)
    return program


def test_another_attempt_is_made_where_it_may_help(fails_twice):
    assert run_program([fails_twice], 60.0, attempts=3).out == "done\n"


def test_the_last_failure_is_reported_with_the_number_of_attempts(fails_twice):
    assert str(failed(fails_twice, attempts=2)).endswith("ended with exit code 1: busy (2 attempts)")
    assert fails_twice.with_suffix(".runs").read_text().count(".") == 2


def test_exit_codes_that_are_answers_are_no_failures():
    assert run_program(["sh", "-c", "echo inactive; exit 3"], 60.0, good=(0, 3)).out == "inactive\n"


def test_what_is_shown_appears_on_standard_error_too(capfd):
    assert run_program(["sh", "-c", "echo 50 %; echo 100 % >&2"], 60.0, shown=True).out == "50 %\n100 %\n"
    assert capfd.readouterr().err == "50 %\n100 %\n"
    assert "100 %" in str(failed("sh", "-c", "echo 100 %; exit 1", shown=True))


def test_ctrl_c_ends_it_too(tmp_path, monkeypatch):
    started = []
    monkeypatch.setattr("controller.programs.subprocess.Popen.wait", lambda self, *_: started.append(self) or _interrupt())
    with pytest.raises(KeyboardInterrupt):
        run_program(["sleep", "infinity"], 60.0)
    monkeypatch.undo()
    assert started[0].wait() == -signal.SIGKILL


def _interrupt():
    raise KeyboardInterrupt
