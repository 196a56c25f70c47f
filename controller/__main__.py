"""The command `haptic-panel`, and `python -m controller` for a release's environment, whose scripts are not used."""

import os
import signal
import sys
from types import FrameType

INTERRUPTED = 130  # as of `console`, which is not imported yet


def main() -> int:
    """Run the command line; a Ctrl-C while it is imported ends it as one later does, in one line."""
    ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    if not ignored:
        signal.signal(signal.SIGINT, _end)
    from controller.cli import main as command_line

    code = command_line()
    if not ignored:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # all is done and printed; what is left is Python's own end
    return code


def _end(_number: int, _frame: FrameType | None) -> None:
    os.write(2, b"haptic-panel: interrupted\n")
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    sys.exit(main())
