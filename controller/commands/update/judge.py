"""`haptic-panel update judge`: what haptic-panel-trial.service runs, from the release on trial."""

import argparse
import signal

from controller.device.service.systemd import Notifier
from controller.device.update.identity import refuse_root
from controller.device.update.layout import Layout, running_release
from controller.device.update.settings import load_settings
from controller.device.update.trial import judge_trial
from controller.log import log


def add(step: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    step.set_defaults(command=run)


def run(_: argparse.Namespace) -> int:
    """Judge the release on trial until the verdict is handed over, or this is ended."""
    layout = Layout.from_environment()
    running, trial = running_release(), layout.word("trial")
    if running is None or running.name != trial:
        log(f"nothing to judge: on trial is {trial or 'no release'}, and this is {running.name if running else 'none'}")
        return 0
    refuse_root(layout)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # at once: no verdict, and TimeoutStopSec= is a failure
    with Notifier.from_environment() as notifier:

        def reported(words: str) -> None:
            notifier.status(words)
            notifier.alive()

        notifier.ready("looks at the service")
        judge_trial(layout, load_settings().healthy_s, reported)
    return 0
