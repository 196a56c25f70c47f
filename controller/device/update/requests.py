"""What an update asks of the fall-back script, which runs as root: a file of one word for each wish."""

from __future__ import annotations

from typing import Literal

from controller.device.update.layout import RELEASE_NAME, Layout
from controller.durable import write_durably
from controller.errors import UpdateError

Request = Literal["trial", "good", "bad", "stands", "rollback"]


def ask(layout: Layout, what: Request, version: str) -> None:
    """Ask for something.

    What: trial: try this release; good, bad: the trial is to stay, or to go for good; stands: it starts well and is not evaluated
    yet, so that its starts so far do not count; rollback: back to the release before. `version` is the release that it is about; of
    a rollback the one to leave, so that a request read twice is not two steps. Raises UpdateError if it cannot be written.
    """
    if not RELEASE_NAME.fullmatch(version):
        raise UpdateError(f"{version!r} is no name of a release")
    try:
        write_durably(layout.requests / what, f"{version}\n".encode("ascii"))
    except OSError as error:
        raise UpdateError(f"{layout.requests / what}: cannot be written ({error.strerror})") from error
