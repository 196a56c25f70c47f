"""What other releases have in place of lines of ours: each way in which an update can fail, as changes to files of the wheel."""

import re


def ends_with(lines):
    """A module with these lines at its end."""
    return lambda text: f"{text}\n\n{lines}\n"


def other_number(name):
    """A module in which a constant is larger by one."""
    return lambda text: re.sub(rf"(?<=^{name} = )\d+", lambda number: str(int(number[0]) + 1), text, flags=re.MULTILINE)


def at_serving(lines):
    """The service with these lines before it serves."""
    return {
        "controller/device/service/run.py": ends_with(
            f"_serve = serve\n\n\ndef serve(*arguments, **named):\n    import os, signal, threading, time\n    {lines}\n"
            "    return _serve(*arguments, **named)"
        )
    }


def once_it_serves(lines):
    """The service with these lines in a turn of its loop, 1 s after it was ready."""
    return {
        "controller/device/service/housekeeping.py": ends_with(
            "_progress, _since_s = Housekeeping.progress, []\n\n\n"
            "def progress(self, now_s):\n    import os, signal, time\n    _progress(self, now_s)\n"
            "    if self._ready and not _since_s:\n        _since_s.append(now_s)\n"
            f"    if _since_s and now_s > _since_s[0] + 1.0:\n        {lines}\n\n\nHousekeeping.progress = progress"
        )
    }


GOOD = {"controller/device/service/run.py": ends_with("# a release that is as good")}
FAILS = {
    "exits with 78": at_serving("from controller.errors import ConfigError; raise ConfigError('made to end with 78')"),
    "crashes": once_it_serves("os.abort()"),
    "hangs": once_it_serves("os.kill(os.getpid(), signal.SIGSTOP)"),
    "is never ready": at_serving("threading.Event().wait()"),
    "finds no FPGA": {
        "controller/device/service/drivers.py": ends_with(
            "def open_link(board, now_s, *, unhurried=False):\n    from controller.errors import LinkError\n\n"
            "    raise LinkError('this release looks for it elsewhere')"
        )
    },
    "lets the FPGA wait": once_it_serves(
        "_since_s[:] = [now_s]; time.sleep(0.4)"
    ),  # longer than its heartbeat's limit, now and again
    "wants other gateware": {"haptic_panel-{version}.data/data/share/haptic-panel/fpga_rtl/haptic_core.v": ends_with("// other")},
    "reads other banks": {"controller/device/bank/file_format.py": other_number("VERSION")},
    "cannot be evaluated": {"controller/device/update/judge.py": ends_with("raise SystemExit(1)")},
    "is evaluated for ever": {"controller/device/update/trial.py": ends_with("def judge_trial(*_, **__):\n    time.sleep(1e6)")},
    "cannot update again": {"controller/device/update/download/fetch.py": ends_with("import no_such_module")},
}
