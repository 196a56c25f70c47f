#!/usr/bin/env python3
"""The device's own classes behind the command line of the conformance suite of The Update Framework (its CLIENT-CLI.md).

The test that runs the suite calls this through the interpreter of the tests.
"""

import argparse
import shutil
import sys
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import quote

from tuf.api.exceptions import DownloadError, RepositoryError
from tuf.ngclient import UpdaterConfig

from controller.device.update.download.http_source import HttpSource
from controller.device.update.download.part_file import complete
from controller.device.update.trust.trust import DeviceUpdater, refusal, sync_tree
from controller.errors import UpdateError


def main():
    parser = argparse.ArgumentParser()
    for name in ("--metadata-url", "--target-dir", "--target-base-url"):
        parser.add_argument(name, default="")
    parser.add_argument("--metadata-dir", type=Path, required=True)
    parser.add_argument("--target-name", action="append", default=[])
    parser.add_argument("command", choices=["init", "refresh", "download"])
    parser.add_argument("root", nargs="?")
    options = parser.parse_args()
    trusted_root = options.metadata_dir.with_name("trusted_root.json")  # outside of what a client keeps
    if options.command == "init":
        shutil.copy(options.root, trusted_root)
        shutil.copy(options.root, options.metadata_dir / "root.json")
        return 0
    address = options.metadata_url.rstrip("/").removesuffix("/metadata")
    assert not options.target_base_url or options.target_base_url.rstrip("/") == f"{address}/targets"
    try:
        # The suite tries more delegations and rotations than a device of ours allows.
        updater = DeviceUpdater(
            options.metadata_dir,
            HttpSource(address, 60.0, retries=0),
            trusted_root.read_bytes(),
            datetime(1970, 1, 1, tzinfo=UTC),
            config=UpdaterConfig(),
        )
        updater.refresh()
        sync_tree(options.metadata_dir)
        for name in options.target_name:
            target = updater.target(name)
            stored = Path(options.target_dir) / quote(name, "")
            if updater.find_cached_target(target, str(stored)):
                continue
            part = options.metadata_dir.with_name("part")
            complete(part, updater, target, lambda _: None)
            part.replace(stored)
    except (UpdateError, RepositoryError, DownloadError, OSError) as error:
        print(refusal(error, address), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
