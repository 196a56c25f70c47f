"""Work for workers of `map_kept` that forks: each of their processes asks a program of its checkout, which has one thread.

A program is a module that answers each line of stdin with a line, both JSON, until its stdin ends: with the process that asks.
"""

import hashlib
import json
import os
import platform
import subprocess
import sys
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).parent.parent
CODE = ("controller", "tests", "fpga_rtl")


def source():
    """Hash of all that decides the answers."""
    digest = hashlib.sha256()
    for path in sorted(path for folder in CODE for path in (ROOT / folder).rglob("*.*")):
        if path.suffix in {".py", ".c", ".toml", ".v", ".vh", ".cpp", ".sby"} and path.is_file():
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@dataclass(frozen=True)
class Asked:
    """The function that workers compute: what a program answers to each item."""

    command: tuple[str, ...]  # behind `python -m`, in the checkout of the worker
    source: str = field(default_factory=source)  # of the checkout of who asks

    def __call__(self, items):
        from controller.errors import WorkersError  # here: a program's tests may import another checkout's

        if source() != self.source:
            raise WorkersError(f"{ROOT} on {platform.node()}: is not the checkout of who asks: bring it to the same files")
        program, answers = program_of(self.command), []
        for item in items:
            print(json.dumps(item), file=program.stdin, flush=True)
            if not (answer := program.stdout.readline()):
                raise WorkersError(f"python -m {self.command[0]}, in {ROOT} on {platform.node()}, has ended: its errors are above")
            answers.append(answer.encode())
        return answers


@lru_cache(maxsize=1)
def program_of(command):
    """That of a process."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    return subprocess.Popen([sys.executable, "-m", *command], cwd=ROOT, **pipes)


def serve(answer):
    """Answer lines until there are no more. What else is started has neither these lines nor the place of answers."""
    asked, answers = os.fdopen(os.dup(0)), os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    for line in asked:
        print(json.dumps(answer(json.loads(line))), file=answers, flush=True)
