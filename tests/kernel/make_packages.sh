#!/bin/bash
# Debian packages of this checkout with two releases, 1.0 and 2.0, whose board `panel` is the simulated one with a coarse bank and a
# touch panel at the serial port /run/touch; lintian looks over one. Made once for each state of the checkout; those of yesterday are removed.
# usage: make_packages.sh PYTHON     prints their folder
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../..")
python=$1
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/packages
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
done=$cache/$("$here/state_of_checkout.sh" make_packages.sh)
if [ ! -e "$done" ]; then
  "$here/install_packages.sh" debhelper fakeroot lintian unzip >&2
  find "$cache" -mindepth 1 -maxdepth 1 -type d -mtime +0 -exec rm -rf {} +
  work=$(mktemp -d "$cache/making.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  mkdir "$work/ready"
  export SOURCE_DATE_EPOCH=1700000000 PYTHONPATH=$checkout:$checkout/tests/device/update:$here OPENBLAS_NUM_THREADS=1
  board=$work/panel
  cp -r "$checkout/boards/simulated" "$board"
  sed -i 's/^pitch_mm = .*/pitch_mm = 15.0\ncoarse = true/; s/^snap_mm = .*/snap_mm = 7.0/; s/^bit_clock_hz = .*/bit_clock_hz = 250e3/' "$board/board.toml"
  "$python" - "$work" <<'P'
import sys
from pathlib import Path

import panel_board
from repository_fixture import Publisher

work = Path(sys.argv[1])
panel_board.BOARD = work / "panel/board.toml"
panel_board.write('kind = "serial_panel"\ndevice = "/run/touch"')
for_pages = '[application_socket]\ngroup = "haptic-play"\nmode = "660"\nregions_group = "haptic-play"\noperate_group = "haptic-operate"\n'
panel_board.BOARD.write_text(panel_board.BOARD.read_text().replace("[application_socket]\n", for_pages))
(work / "root.json").write_bytes(Publisher(work / "owner").root)
P
  "$python" -m controller bank build --board "$board" --scene scene --out "$work/panel.bank" --json >/dev/null 2>&1
  wheels=()
  for number in 1 2; do
    "$python" -m controller update make-release "$work/$number.0" --version $number.0 --counter $number --board "$board" --bank "$work/panel.bank" --no-mypyc "${wheels[@]}" >&2 # the compiled loop is that of a checkout, in container_commissioning.py
    OUT=$work/ready "$checkout/systemd/package/build.sh" "$work/$number.0" "$work/root.json" >&2
    wheels=(--wheels "$work/$number.0/wheels")
  done
  lintian --allow-root --display-level '>=info' --fail-on error,warning,info "$work"/ready/*_1.0-1_*.deb >&2
  mv -T "$work/ready" "$done" # whole or not there
fi
echo "$done"
