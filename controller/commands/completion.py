"""`haptic-panel completion`: print a shell's completion of this command line."""

import argparse
from pathlib import Path

from controller.commands.common.arguments import Declare
from controller.console import say

SHELL_FILES = Path(__file__).with_name("shell")
COMPLETIONS = {"bash": "haptic-panel.bash", "zsh": "_haptic-panel", "tcsh": "haptic-panel.tcsh"}


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    command = declare(
        example="haptic-panel completion bash",
        description="Print the completion for a shell. For one session: source <(haptic-panel completion bash). The wheel also "
        "installs it below share/bash-completion and share/zsh, and the manual page below share/man.",
    )
    command.add_argument("shell", choices=list(COMPLETIONS))
    command.set_defaults(command=completion)


def completion(options: argparse.Namespace) -> int:
    """Print the file that `shell.files` has generated: the device needs no package for it."""
    say((SHELL_FILES / COMPLETIONS[options.shell]).read_text(encoding="utf-8"), end="")
    return 0
