"""A person at a pseudo-terminal, who answers what a command asks."""

import os
import pty
import subprocess


def at_terminal(command, talk, environment=None):
    """Run a command at a pseudo-terminal, each of its questions answered; all that stood on it, once it has ended with exit code 0.

    Parameters
    ----------
    talk : list of (str, str)
        What each question, a line that ends with `): `, has in it, and the answer.
    """
    terminal, its_end = pty.openpty()
    with subprocess.Popen(
        command, env=environment, stdin=its_end, stdout=its_end, stderr=its_end, start_new_session=True
    ) as asking:
        os.close(its_end)
        screen, asked = "", list(talk)
        while read := read_some(terminal):
            screen += read
            if asked and screen.rpartition("\n")[2].endswith("): "):
                wanted, answer = asked.pop(0)
                assert wanted in screen.rpartition("\n")[2]
                screen += "\n"
                os.write(terminal, f"{answer}\n".encode())
    os.close(terminal)
    assert asking.returncode == 0, screen
    assert not asked
    return screen


def read_some(terminal):
    """What stands on a terminal next; nothing once its program has ended."""
    try:
        return os.read(terminal, 4096).decode()
    except OSError:
        return ""
