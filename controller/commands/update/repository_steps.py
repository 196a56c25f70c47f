"""Steps of `haptic-panel update repository`: each opens it, has it changed, and says what is published or lacking."""

from __future__ import annotations

import argparse
import getpass
import os
import sys
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from controller.commands.common.output import show
from controller.console import tell
from controller.errors import UpdateError, UsageError
from controller.text_file import read_text

if TYPE_CHECKING:
    from securesystemslib.signer import CryptoSigner

    from controller.workshop.publish.publisher import Repository

PASSPHRASE = "HAPTIC_PANEL_PASSPHRASE"
ROLES = ("root", "targets", "snapshot", "timestamp")


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

    root, publisher = [read_public(file) for file in options.root], [read_public(file) for file in options.publisher]
    targets = [read_public(file) for file in options.targets or options.root]
    keys = {"root": root, "targets": targets, "snapshot": publisher, "timestamp": publisher}
    return _drafted(options, lambda repository, now: draft_first(repository, keys, options.threshold, now), new=True)


def add_releases(options: argparse.Namespace) -> int:
    """Draft releases into a channel."""
    from controller.workshop.publish.publications import draft_releases
    from controller.workshop.publish.shares import rollout_of

    def draft(repository: Repository, now: datetime) -> None:
        draft_releases(repository, options.release, options.channel, now, rollout_of(options.shares))

    return _drafted(options, draft)


def change_rollout(options: argparse.Namespace) -> int:
    """Draft other steps."""
    from controller.workshop.publish.publications import draft_rollout
    from controller.workshop.publish.shares import rollout_of

    rollout = rollout_of(options.shares)
    assert rollout is not None  # --share is required
    return _drafted(options, lambda repository, now: draft_rollout(repository, options.version, rollout, now))


def open_step(options: argparse.Namespace) -> int:
    """Draft the next step's opening."""
    from controller.workshop.publish.publications import draft_open

    return _drafted(options, lambda repository, now: draft_open(repository, options.version, now, everything=options.everything))


def stop_release(options: argparse.Namespace) -> int:
    """Draft a stop."""
    from controller.workshop.publish.publications import draft_stop

    return _drafted(options, lambda repository, now: draft_stop(repository, options.version, now))


def sign_draft(options: argparse.Namespace) -> int:
    """Show a draft, sign it, publish it if nothing is lacking."""
    from controller.workshop.publish.draft import describe, must_be, must_be_of_today
    from controller.workshop.publish.metadata import now
    from controller.workshop.publish.publisher import Repository

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
    from controller.workshop.publish.metadata import now
    from controller.workshop.publish.publisher import Repository

    with Repository.opened(options.repository) as repository:
        fleet = read_fleet(options.reports, now(), options.silent_s)
        figures = rollout_figures(repository, options.channel, fleet, now())
    show(options, figures, fleet_table)
    return 1 if any(offer["propose"] in ("stop", "hold") for offer in figures["offers"]) else 0


def change_keys(options: argparse.Namespace) -> int:
    """Draft a root with other keys."""
    from controller.workshop.publish.keys import known, read_public
    from controller.workshop.publish.publications import draft_keys

    if not (options.drop or options.add or options.threshold):
        raise UsageError("nothing to change: give --drop, --add or --threshold")

    def draft(repository: Repository, now: datetime) -> None:
        root = repository.root
        drop = [known(root, name, repository.folder) for name in options.drop]
        new = [read_public(file) for file in options.add]
        roles = options.role or [role for role in ROLES if any(key.keyid in root.roles[role].keyids for key in drop)]
        if new and not roles:
            raise UsageError("what shall the added keys count for? give --role, or --drop the keys whose place they take")
        dropped = {role: [key for key in drop if options.role or key.keyid in root.roles[role].keyids] for role in roles}
        draft_keys(repository, dict.fromkeys(roles, new), dropped, options.threshold, now)

    return _drafted(options, draft)


def renew(options: argparse.Namespace) -> int:
    """Draft a longer life."""
    from controller.workshop.publish.publications import draft_renewal

    return _drafted(options, draft_renewal)


def export_stick(options: argparse.Namespace) -> int:
    """Copy a repository onto a stick."""
    from controller.workshop.publish.metadata import now
    from controller.workshop.publish.publisher import Repository
    from controller.workshop.publish.stick import export

    with Repository.opened(options.repository, dated=options.date) as repository:
        copied_bytes = export(repository, options.folder, _signer(options, options.repository, options.folder), now())
    show(
        options,
        {"folder": str(options.folder), "bytes": copied_bytes},
        lambda said: f"{said['folder']}: {said['bytes']:,} bytes, for a year",
    )
    return 0


def _drafted(options: argparse.Namespace, draft: Callable[[Repository, datetime], None], *, new: bool = False) -> int:
    """Draft something in a repository, or in a new one, and say what the draft lacks."""
    from controller.workshop.publish.metadata import now
    from controller.workshop.publish.publisher import Repository

    with Repository.opened(options.repository, new=new, dated=None if new else options.date) as repository:
        draft(repository, now())
        return _tell(options, repository, published=False)


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
