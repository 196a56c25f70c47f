"""`haptic-panel update repository`: keys, drafts, signatures and publication of signed releases, where their owner keeps them."""

from __future__ import annotations

import argparse
import getpass
import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.arguments import seconds
from controller.commands.common.output import show
from controller.console import tell
from controller.errors import UpdateError, UsageError
from controller.text_file import read_text

if TYPE_CHECKING:
    from securesystemslib.signer import CryptoSigner

    from controller.workshop.publish.publisher import Repository

PASSPHRASE = "HAPTIC_PANEL_PASSPHRASE"
ROLES = ("root", "targets", "snapshot", "timestamp")


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

    key = action("key", make_key, "make a key that a passphrase protects: KEY, and its public part *.pub beside it", folder=False)
    key.add_argument("key", type=Path, metavar="KEY", help="file to write, such as alice.pem; never in a repository")
    init = action("init", make_repository, "draft a repository without releases, to be signed by all")
    init.add_argument("--root", nargs="+", required=True, type=Path, metavar="PUB", help="keys that say which keys count")
    init.add_argument("--targets", nargs="+", type=Path, metavar="PUB", help="keys that sign releases (default: those of root)")
    init.add_argument(
        "--publisher", nargs="+", required=True, type=Path, metavar="PUB", help="keys that sign which release is the newest"
    )
    init.add_argument("--threshold", type=int, default=2, metavar="N", help="people who must sign root and releases (default: 2)")
    release = action("add", add_releases, "draft the release of folders that make-release made into a channel")
    release.add_argument("release", nargs="+", type=Path, metavar="RELEASE", help="folder; one for each platform")
    release.add_argument("--channel", default="stable", metavar="C", help="default: stable")
    declare_shares(release)
    rollout = action("rollout", change_rollout, "draft other steps of a release that is published")
    stop = action("stop", stop_release, "draft a timestamp by which no further device takes a release, for good")
    opening = action("open", open_step, "draft a timestamp that opens the next step of a release: it comes at its time")
    for parser in (rollout, opening, stop):
        parser.add_argument("version", metavar="VERSION")
    opening.add_argument("--all", dest="everything", action="store_true", help="all its steps: nobody needs to look before each")
    declare_shares(rollout, required=True)
    fleet = action("status", fleet_status, "count devices by release and health, and propose the next step of a rollout, or a stop")
    _declare_reports(fleet)
    sign = action("sign", sign_draft, "show the draft, sign it, and publish it once all signatures are there")
    _declare_signing(sign)
    rotate = action("rotate", change_keys, "draft other keys, or another number of people")
    _declare_rotation(rotate)
    renewal = action("renew", renew, "draft a longer life of what is published")
    export = action("export", export_stick, "copy what the channels offer into a folder, such as on a stick, valid for a year")
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


def make_key(options: argparse.Namespace) -> int:
    """Make a key."""
    from controller.workshop.publish.keys import check_outside, new_key

    check_outside(options.key, *options.key.absolute().parents)
    public = new_key(options.key, _passphrase(options, options.key, new=True))
    show(
        options,
        {"key": str(options.key), "public": str(public)},
        lambda said: f"{said['key']}: keep it apart; {said['public']} is public",
    )
    return 0


def make_repository(options: argparse.Namespace) -> int:
    """Draft a repository."""
    from controller.workshop.publish.keys import read_public
    from controller.workshop.publish.publications import draft_first
    from controller.workshop.publish.publisher import Repository, now

    root, publisher = [read_public(file) for file in options.root], [read_public(file) for file in options.publisher]
    targets = [read_public(file) for file in options.targets or options.root]
    keys = {"root": root, "targets": targets, "snapshot": publisher, "timestamp": publisher}
    with Repository.opened(options.repository, new=True) as repository:
        draft_first(repository, keys, options.threshold, now())
        return _tell(options, repository, published=False)


def add_releases(options: argparse.Namespace) -> int:
    """Draft releases into a channel."""
    from controller.workshop.publish.publications import draft_releases
    from controller.workshop.publish.publisher import Repository, now
    from controller.workshop.publish.shares import rollout_of

    with Repository.opened(options.repository, dated=options.date) as repository:
        draft_releases(repository, options.release, options.channel, now(), rollout_of(options.shares))
        return _tell(options, repository, published=False)


def change_rollout(options: argparse.Namespace) -> int:
    """Draft other steps."""
    from controller.workshop.publish.publications import draft_rollout
    from controller.workshop.publish.publisher import Repository, now
    from controller.workshop.publish.shares import rollout_of

    rollout = rollout_of(options.shares)
    assert rollout is not None  # --share is required
    with Repository.opened(options.repository, dated=options.date) as repository:
        draft_rollout(repository, options.version, rollout, now())
        return _tell(options, repository, published=False)


def open_step(options: argparse.Namespace) -> int:
    """Draft the next step's opening."""
    from controller.workshop.publish.publications import draft_open
    from controller.workshop.publish.publisher import Repository, now

    with Repository.opened(options.repository, dated=options.date) as repository:
        draft_open(repository, options.version, now(), everything=options.everything)
        return _tell(options, repository, published=False)


def stop_release(options: argparse.Namespace) -> int:
    """Draft a stop."""
    from controller.workshop.publish.publications import draft_stop
    from controller.workshop.publish.publisher import Repository, now

    with Repository.opened(options.repository, dated=options.date) as repository:
        draft_stop(repository, options.version, now())
        return _tell(options, repository, published=False)


def sign_draft(options: argparse.Namespace) -> int:
    """Show a draft, sign it, publish it if nothing is lacking."""
    from controller.workshop.publish.draft import describe, must_be, must_be_of_today
    from controller.workshop.publish.publisher import Repository, now

    with Repository.opened(options.repository, dated=options.date) as repository:
        for part in describe(repository):
            tell(part)
        must_be(repository, options.same_as)
        for copy in options.copies:
            repository.take(copy)
        if options.key:
            must_be_of_today(repository, now())
            repository.sign(_signer(options, options.repository))
        return _tell(options, repository, published=repository.publish())


def fleet_status(options: argparse.Namespace) -> int:
    """Show how many devices each release serves; 1 if one should be stopped or held."""
    from controller.workshop.publish.fleet import fleet_table, read_fleet, rollout_figures
    from controller.workshop.publish.publisher import Repository, now

    with Repository.opened(options.repository) as repository:
        fleet = read_fleet(options.reports, now(), options.silent_s)
        figures = rollout_figures(repository, options.channel, fleet, now())
    show(options, figures, fleet_table)
    return 1 if any(offer["propose"] in ("stop", "hold") for offer in figures["offers"]) else 0


def change_keys(options: argparse.Namespace) -> int:
    """Draft a root with other keys."""
    from controller.workshop.publish.keys import known, read_public
    from controller.workshop.publish.publications import draft_keys
    from controller.workshop.publish.publisher import Repository, now

    if not (options.drop or options.add or options.threshold):
        raise UsageError("nothing to change: give --drop, --add or --threshold")
    with Repository.opened(options.repository, dated=options.date) as repository:
        root = repository.root
        drop = [known(repository.root, name, repository.folder) for name in options.drop]
        new = [read_public(file) for file in options.add]
        roles = options.role or [role for role in ROLES if any(key.keyid in root.roles[role].keyids for key in drop)]
        if new and not roles:
            raise UsageError("what shall the added keys count for? give --role, or --drop the keys whose place they take")
        dropped = {role: [key for key in drop if options.role or key.keyid in root.roles[role].keyids] for role in roles}
        draft_keys(repository, dict.fromkeys(roles, new), dropped, options.threshold, now())
        return _tell(options, repository, published=False)


def renew(options: argparse.Namespace) -> int:
    """Draft a longer life."""
    from controller.workshop.publish.publications import draft_renewal
    from controller.workshop.publish.publisher import Repository, now

    with Repository.opened(options.repository, dated=options.date) as repository:
        draft_renewal(repository, now())
        return _tell(options, repository, published=False)


def export_stick(options: argparse.Namespace) -> int:
    """Copy a repository onto a stick."""
    from controller.workshop.publish.publisher import Repository, now
    from controller.workshop.publish.stick import export

    with Repository.opened(options.repository, dated=options.date) as repository:
        copied_bytes = export(repository, options.folder, _signer(options, options.repository, options.folder), now())
    show(
        options,
        {"folder": str(options.folder), "bytes": copied_bytes},
        lambda said: f"{said['folder']}: {said['bytes']:,} bytes, for a year",
    )
    return 0


def _tell(options: argparse.Namespace, repository: Repository, *, published: bool) -> int:
    """Say what is published, or what the draft lacks."""
    lacking = "" if published else repository.lacking()
    state = "published" if published else "a draft"
    if lacking:
        state += f": {lacking}: haptic-panel update repository sign"
    elif not published:
        state += ", signed by all: take it back to the repository: haptic-panel update repository sign REPOSITORY --from FOLDER"
    show(
        options,
        {"repository": str(options.repository), "published": published, "lacking": lacking},
        lambda said: f"{said['repository']}: {state}",
    )
    return 0


def _signer(options: argparse.Namespace, *apart: Path) -> CryptoSigner:
    from controller.workshop.publish.keys import check_outside, open_key

    check_outside(options.key, *apart)
    return open_key(options.key, _passphrase(options, options.key))


def _date(text: str) -> str:
    if not re.fullmatch("[0-9]{4}-[0-9]{2}-[0-9]{2}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is no date such as 2027-03-28")
    return text


def _passphrase(options: argparse.Namespace, key: Path, *, new: bool = False) -> str:
    """The passphrase: of a file, of the environment, or asked at the terminal (twice for a new key)."""
    if options.passphrase_file:
        try:
            text = read_text(options.passphrase_file)
        except (OSError, ValueError) as error:
            raise UpdateError(f"{options.passphrase_file}: the passphrase cannot be read: {error}") from error
        return text.rstrip("\n")
    if PASSPHRASE in os.environ:
        return os.environ[PASSPHRASE]
    if not sys.stdin.isatty():
        raise UpdateError(f"{key}: its passphrase is asked at a terminal; without one give --passphrase-file, or ${PASSPHRASE}")
    typed = getpass.getpass(f"Passphrase of {key}: ")
    if new and getpass.getpass("Once more: ") != typed:
        raise UpdateError(f"{key}: the two passphrases differ: nothing was written")
    return typed
