"""How this package came onto this machine, and the line for a shell that completes it.

Never by the package's name: what a registry has under that name need not be ours.
"""

from __future__ import annotations

import importlib.metadata
import json
import shlex
import sys
from urllib.parse import unquote, urlsplit

DISTRIBUTION = "haptic-panel"
OFFLINE = frozenset({"scipy", "matplotlib", "mpl_toolkits", "tqdm", "threadpoolctl"})  # what the extra `offline` brings
DRIVERS = frozenset(
    {"spidev", "gpiod", "evdev", "smbus2", "serial", "cobs"}
)  # what the package itself brings, partly on Linux only


def install_line(extra: str = "") -> str:
    """Line for a shell that installs this package again from where it came, with what an extra needs."""
    source, options = _source()
    wanted = f"{source}[{extra}]" if extra else source
    return shlex.join([sys.executable, "-m", "pip", "install", *options, wanted])


def missing_package(name: str | None) -> str | None:
    """What is to be done where a package cannot be imported; None where it is not one that this package needs."""
    package = (name or "").partition(".")[0]
    if package in OFFLINE:
        return f"{package} is missing, one of the offline tools that this needs: {install_line('offline')}"
    if package in DRIVERS:
        return f"{package} is missing, the driver that this device needs (Linux only): {install_line()}"
    return None


def _source() -> tuple[str, list[str]]:
    """Folder or wheel that this package was installed from, as far as pip has noted it, and the options to do so again."""
    distribution = importlib.metadata.distribution(DISTRIBUTION)
    wheel = f"{DISTRIBUTION.replace('-', '_')}-{distribution.version}-py3-none-any.whl"
    noted = json.loads(distribution.read_text("direct_url.json") or "{}")
    url = urlsplit(noted.get("url", ""))
    if url.scheme != "file":
        return f"./{wheel}", []
    return unquote(url.path), ["-e"] if noted.get("dir_info", {}).get("editable") else []
