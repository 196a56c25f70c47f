"""Sessions in a document: its ```console blocks, run as they stand and held to the lines that they show.

A line that begins with `# ` is typed by root on the device, one with `$ ` where releases are made; the lines under it are what is
printed, in full: `…` within a line is anything, and alone it is any lines.
"""

import re
import subprocess


def blocks(document, heading):
    """Blocks of a section (of `## heading`, to the next of its kind), each a list of (prompt, command, lines shown)."""
    section = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", document.read_text(), re.MULTILINE | re.DOTALL)[1]
    return [_commands(block) for block in re.findall(r"^```console\n(.*?)^```", section, re.MULTILINE | re.DOTALL)]


def _commands(block):
    commands = []
    for line in block.splitlines():
        if line.startswith(("# ", "$ ")):
            commands.append((line[0], line[2:], []))
        else:
            commands[-1][2].append(line)
    return commands


def follow(command, shown, **how):
    """Run a command in a shell, and hold what it prints to what is shown."""
    done = subprocess.run(command, shell=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **how)
    assert re.fullmatch(pattern(shown), done.stdout), (
        f"{command}: exit code {done.returncode}; printed:\n{done.stdout}shown:\n{shown}"
    )
    return done


def pattern(shown):
    """Regular expression of output, from the lines shown."""
    lines = (r"(?:.*\n)*" if line == "…" else re.escape(line).replace("…", ".*") + r"\n" for line in shown)
    return "".join(lines)
