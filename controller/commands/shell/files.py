"""Completions and manual page from the argument parser (`controller.generate` writes them).

They are committed beside this module, because the packages that make them (shtab, argparse-manpage: of the extra `test`) are not
for a device; a test compares them with the parser.
"""

import argparse
import os
from collections.abc import Iterator

from controller import __version__
from controller.cli import parser
from controller.commands.completion import COMPLETIONS

MANUAL = "haptic-panel.1"
COLUMNS = "100"  # of the help texts that both packages take over


def shell_files() -> dict[str, str]:
    """Text of each file by its name."""
    import shtab
    from argparse_manpage.manpage import Manpage

    os.environ["COLUMNS"] = COLUMNS
    completed = parser()
    for action in arguments(completed):
        if action.metavar in ("FILE", "F"):
            setattr(action, "complete", shtab.FILE)  # noqa: B010 - argparse does not declare what shtab reads
    found = {name: shtab.complete(completed, shell=shell) for shell, name in COMPLETIONS.items()}
    data = {
        "prog": "haptic-panel",
        "project_name": "haptic-panel",
        "description": "controller of a glass panel that pushes back under each finger",
        "version": __version__,
        "date": f"version {__version__}",
        "manual_title": "haptic-panel",
        "format": "single-commands-section",
    }
    found[MANUAL] = str(Manpage(parser(), format=data["format"], _data=data))
    return {name: "\n".join(line.rstrip() for line in text.splitlines()) + "\n" for name, text in found.items()}


def arguments(of: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Every argument of a parser and of its commands."""
    for action in of._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for command in dict.fromkeys(action.choices.values()):
                yield from arguments(command)
