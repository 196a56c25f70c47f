"""`haptic-panel update`: signed releases on a device, and their repository. Each of its steps is a module beside this one."""

import argparse
from importlib import import_module

from controller.commands.common.arguments import Declare

STEPS: dict[str, str] = {  # in the order of --help, which prints these texts; each is a module of this package
    "check": "what the repository offers this device, and why it is refused if it is",
    "download": "fetch the release that is offered, without installing it",
    "install": "fetch the release that is offered, build it beside the one in use, and try it",
    "status": "which releases this device has, and how a trial stands",
    "rollback": "go back to the release before",
    "judge": "decide on the release on trial by the health of its service (haptic-panel-trial.service runs it)",
    "make-release": "make a release: wheels, boards, banks, gateware, and a manifest of them all",
    "repository": "keep the repository of releases: keys, drafts, signatures, publication, sticks",
}


def add(declare: Declare, _: argparse.ArgumentParser) -> None:
    """Declare the steps."""
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--json", action="store_true", help="print one JSON object and nothing else on stdout")
    steps = declare(
        example="haptic-panel update check",
        description="A release is the software of a device with its boards, banks and gateware, signed by its publishers. A device "
        "fetches, installs and tries it, and rolls it back if it fails; make-release and repository are for the publishers.",
    ).add_subparsers(title="steps", metavar="STEP", required=True)
    for name, text in STEPS.items():
        step = steps.add_parser(name, parents=[common], help=text, description=f"{text[0].upper()}{text[1:]}.")
        import_module(f"controller.commands.update.{name.replace('-', '_')}").add(step)
