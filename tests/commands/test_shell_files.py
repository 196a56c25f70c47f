"""The committed completions and manual page are made of the argument parser as it is."""

import argparse
import re
import shutil
import subprocess

import pytest
from tables import each_row

from controller.cli import main, parser
from controller.commands.completion import COMPLETIONS, SHELL_FILES
from controller.commands.shell.files import MANUAL, arguments, shell_files

ELSE = "run `python -m controller.generate`"


def words(text):
    """Letters and digits, without roff's fonts: line breaks and hyphens depend on the version of Python."""
    return re.sub(r"\\f[A-Z]|[^A-Za-z0-9]", "", text)


def options():
    return {name for action in arguments(parser()) for name in action.option_strings}


def helps():
    for action in arguments(parser()):
        if isinstance(action, argparse._SubParsersAction):
            yield from (choice.help for choice in action._choices_actions)
        elif action.help and action.help != argparse.SUPPRESS and action.option_strings not in (["-h", "--help"], ["--version"]):
            yield action.help


@each_row("name", [*COMPLETIONS.values(), MANUAL])
def test_the_committed_files_are_made_of_this_parser(name):
    committed, made = (SHELL_FILES / name).read_text(), shell_files()[name]
    assert words(committed) == words(made), ELSE


def test_every_option_and_its_help_stand_in_the_manual():
    manual = words((SHELL_FILES / MANUAL).read_text())
    for text in [*helps(), *(options() - {"-h", "--help"})]:
        assert words(text) in manual, (text, ELSE)


@each_row("shell", sorted(COMPLETIONS))
def test_every_option_stands_in_the_completion(shell, capsys):
    assert main(["completion", shell]) == 0
    text = capsys.readouterr().out
    assert text == (SHELL_FILES / COMPLETIONS[shell]).read_text()
    long = {option for option in options() if option.startswith("--")}
    offered = set(re.findall(r"--?[a-z][a-z0-9-]+", text)) | {f"--{name}" for name in re.findall(r"[a-z0-9-]+", text)}
    assert long <= offered, ELSE


@pytest.mark.skipif(not shutil.which("bash"), reason="no bash")
def test_bash_completes_commands_options_and_boards_actions():
    script = """
source "$1"; COMP_WORDS=(haptic-panel $2); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
$(complete -p haptic-panel | sed -E 's/.*-F ([^ ]+).*/\\1/') haptic-panel "${COMP_WORDS[COMP_CWORD]}"
echo "${COMPREPLY[@]}"
"""

    def completed(line):
        command = ["bash", "-c", script, "-", str(SHELL_FILES / COMPLETIONS["bash"]), line]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()

    assert completed("calibrate-") == ["calibrate-touch"]
    assert "plan" in completed("calibrate p")
    assert completed("board ch") == ["check"]
    assert "--replay" in completed("run --rep")
