"""`haptic-panel update repository`: keys, drafts, signatures and publication of signed releases, where their owner keeps them."""

import argparse
import re
from pathlib import Path

from controller.commands.common.arguments import seconds
from controller.commands.update import repository_steps as steps
from controller.commands.update.repository_steps import PASSPHRASE, ROLES


def add(step: argparse.ArgumentParser) -> None:
    """Declare the actions."""
    actions = step.add_subparsers(title="actions", metavar="ACTION", required=True)

    def action(name: str, run: object, text: str, *, folder: bool = True) -> argparse.ArgumentParser:
        made = actions.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.")
        if folder:
            made.add_argument("repository", type=Path, metavar="REPOSITORY", help="its folder")
        made.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="as of `update repository --json`")
        made.set_defaults(command=run)
        return made

    key = action(
        "key", steps.make_key, "make a key that a passphrase protects: KEY, and its public part *.pub beside it", folder=False
    )
    key.add_argument("key", type=Path, metavar="KEY", help="file to write, such as alice.pem; never in a repository")
    init = action("init", steps.make_repository, "draft a repository without releases, to be signed by all")
    init.add_argument("--root", nargs="+", required=True, type=Path, metavar="PUB", help="keys that say which keys count")
    init.add_argument("--targets", nargs="+", type=Path, metavar="PUB", help="keys that sign releases (default: those of root)")
    init.add_argument(
        "--publisher", nargs="+", required=True, type=Path, metavar="PUB", help="keys that sign which release is the newest"
    )
    init.add_argument("--threshold", type=int, default=2, metavar="N", help="people who must sign root and releases (default: 2)")
    release = action("add", steps.add_releases, "draft the release of folders that make-release made into a channel")
    release.add_argument("release", nargs="+", type=Path, metavar="RELEASE", help="folder; one for each platform")
    release.add_argument("--channel", default="stable", metavar="C", help="default: stable")
    declare_shares(release)
    rollout = action("rollout", steps.change_rollout, "draft other steps of a release that is published")
    stop = action("stop", steps.stop_release, "draft a timestamp by which no further device takes a release, for good")
    opening = action("open", steps.open_step, "draft a timestamp that opens the next step of a release: it comes at its time")
    for parser in (rollout, opening, stop):
        parser.add_argument("version", metavar="VERSION")
    opening.add_argument("--all", dest="everything", action="store_true", help="all its steps: nobody needs to look before each")
    declare_shares(rollout, required=True)
    fleet = action(
        "status", steps.fleet_status, "count devices by release and health, and propose the next step of a rollout, or a stop"
    )
    _declare_reports(fleet)
    sign = action("sign", steps.sign_draft, "show the draft, sign it, and publish it once all signatures are there")
    _declare_signing(sign)
    rotate = action("rotate", steps.change_keys, "draft other keys, or another number of people")
    _declare_rotation(rotate)
    renewal = action("renew", steps.renew, "draft a longer life of what is published")
    export = action(
        "export", steps.export_stick, "copy what the channels offer into a folder, such as on a stick, valid for a year"
    )
    export.add_argument("folder", type=Path, metavar="FOLDER")
    export.add_argument("--key", required=True, type=Path, metavar="KEY", help="a key of the publisher")
    for parser in (release, rollout, opening, stop, sign, rotate, renewal, export):
        parser.add_argument(
            "--date",
            type=_date,
            metavar="YYYY-MM-DD",
            help="date of the new timestamp, if it is right although the last one is later, or more than 90 days older",
        )
    for parser in (key, sign, export):
        parser.add_argument(
            "--passphrase-file", type=Path, metavar="F", help=f"file with the passphrase (default: ${PASSPHRASE}, or asked)"
        )


def _declare_reports(fleet: argparse.ArgumentParser) -> None:
    fleet.add_argument(
        "--from",
        dest="reports",
        required=True,
        type=Path,
        metavar="FOLDER",
        help="a file NAME.json for each device, what `haptic-panel status --json` prints there, or NAME.prom, what `haptic-panel "
        "metrics` or Prometheus gives; its date says when",
    )
    fleet.add_argument("--channel", default="stable", metavar="C", help="default: stable")
    fleet.add_argument(
        "--silent-s",
        default=86_400.0,
        type=seconds,
        metavar="S",
        help="age of a report from which its device is silent (default: 86400)",
    )


def _declare_signing(sign: argparse.ArgumentParser) -> None:
    sign.add_argument("--key", type=Path, metavar="KEY", help="sign with this key")
    sign.add_argument(
        "--from", dest="copies", nargs="+", default=[], type=Path, metavar="COPY", help="take the signatures of copies"
    )
    sign.add_argument(
        "--same-as",
        nargs="+",
        default=[],
        type=Path,
        metavar="RELEASE",
        help="sign only if the draft has these releases, made here",
    )


def _declare_rotation(rotate: argparse.ArgumentParser) -> None:
    rotate.add_argument("--drop", nargs="+", default=[], metavar="PUB|NAME", help="keys that shall not count any more")
    rotate.add_argument("--add", nargs="+", default=[], type=Path, metavar="PUB", help="keys that shall count")
    rotate.add_argument(
        "--role", nargs="+", choices=ROLES, metavar="ROLE", help="for what (default: what the dropped keys count for)"
    )
    rotate.add_argument("--threshold", type=int, metavar="N", help="people who must sign root and releases (default: as it is)")


def declare_shares(parser: argparse.ArgumentParser, *, required: bool = False) -> None:
    """Declare --share."""
    parser.add_argument(
        "--share",
        dest="shares",
        action="append",
        default=[],
        required=required,
        metavar="PERCENT@TIME",
        help="share of the devices that may take it from a time on, such as 1%%@2026-12-01T08:00Z; once for each step: a later "
        "one waits for `open` too",
    )


def _date(text: str) -> str:
    if not re.fullmatch("[0-9]{4}-[0-9]{2}-[0-9]{2}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is no date such as 2027-03-28")
    return text
