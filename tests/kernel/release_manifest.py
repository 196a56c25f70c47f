"""Prints the manifest of this checkout as a release, for trees of make_tree.sh.

usage: release_manifest.py VERSION
"""

import platform
import sys

from controller.device.bank.file_format import VERSION as BANK_FORMAT
from controller.device.fpga.registers import PROTOCOL_VERSION
from controller.device.service.drivers import gateware_hash
from controller.device.update.manifest import SETTINGS_FORMAT, Manifest

manifest = Manifest(
    version=sys.argv[1], counter=1, python=f"3.{sys.version_info[1]}", architecture=platform.machine(), protocol=PROTOCOL_VERSION,
    gateware_hash=f"{gateware_hash():08x}", bank_format=BANK_FORMAT, settings_format=SETTINGS_FORMAT, files=[],
)  # fmt: skip
sys.stdout.write(manifest.to_json().decode())
