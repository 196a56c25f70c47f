#!/bin/bash
# Makes the file tree in which systemd runs the service, in a container or in the guest: /usr is to be this machine's own,
# read-only, with TREE/over laid over it, what the Debian package puts there; /etc is empty but for what is needed to boot; this
# checkout is at /checkout and is installed as the release in use, below /opt/haptic-panel. All but the tests is made once for each
# state of the checkout; what was made for one of yesterday is removed.
# usage: make_tree.sh PYTHON TREE [--slow] FILE.py...     the files are run by run_tests.py; TREE/binds lists what is to be bound where
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../..")
python=$1 tree=$2
shift 2
base=$("$python" -c 'import sys; print(sys.base_prefix)')
version=$("$python" -c 'import sys; print(f"python3.{sys.version_info[1]}")')
packages=$("$python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
multiarch=$("$python" -c 'import sysconfig; print(sysconfig.get_config_var("MULTIARCH") or "")')
export PYTHONPATH=$checkout
release=$("$python" -c 'from controller import __version__; print(__version__)')
interpreter=/usr/bin
[ "$base" = /usr ] || interpreter=/opt/python/bin

make() { # TREE
  local tree=$1
  mkdir -p "$tree"/{usr,checkout,dev,proc,sys,run,tmp,home,root,mnt,var/lib/haptic-panel,var/tmp,etc/systemd/system,opt/python,opt/packages,opt/wheels}
  mkdir -p "$tree"/{opt/haptic-panel/{releases,state,requests,store,download},etc/haptic-panel/boards,over/bin,over/lib/{haptic-panel,$multiarch}}
  chmod 1777 "$tree/tmp" "$tree/var/tmp"
  ln -s usr/bin usr/sbin usr/lib usr/lib64 "$tree/"
  echo 00000000000000000000000000000001 >"$tree/etc/machine-id" # a known machine: not every unit of /usr is enabled
  echo 'root:x:0:0:root:/root:/bin/sh' >"$tree/etc/passwd"
  echo 'root:x:0:' >"$tree/etc/group"
  cp /etc/os-release /etc/ld.so.cache "$tree/etc/"
  [ "$base" = /usr ] || for library in "$base"/lib/libpython*.so.*; do # found in place of Debian's own, which may be another version
    [ ! -e "$library" ] || ln -s "/opt/python/lib/${library##*/}" "$tree/over/lib/$multiarch/"
  done

  # a release as it is on a device: the package as `pip install` leaves it in a virtual environment; its dependencies from the one
  # that runs the tests
  local folder=$tree/opt/haptic-panel/releases/$release
  mkdir -p "$folder/venv/bin"
  "$python" -m pip install -q --root-user-action ignore --disable-pip-version-check --no-deps --no-build-isolation --no-index \
    --ignore-installed --no-warn-script-location --prefix "$folder/venv" "$checkout"
  rm "$folder/venv/bin/haptic-panel" # no script of an environment is used
  ln -s "$interpreter/$version" "$folder/venv/bin/python"
  printf 'home = %s\n' "$interpreter" >"$folder/venv/pyvenv.cfg"
  echo /opt/packages >"$folder/venv/lib/$version/site-packages/packages.pth"
  "$python" "$here/release_manifest.py" "$release" >"$folder/release.json"
  touch "$folder/.complete"
  ln -s "releases/$release" "$tree/opt/haptic-panel/current"
  echo "$release" >"$tree/opt/haptic-panel/state/current"
  install -m 755 "$checkout/systemd/haptic-panel" "$tree/over/bin/"
  ln -s /run/tools/openFPGALoader "$tree/over/bin/" # where a test may put one: as-user gives a command no PATH of root's
  install -m 755 "$checkout"/systemd/{fall-back,as-user,set-touch} "$tree/over/lib/haptic-panel/"

  # the simulated board with a coarse bank, and a bit clock for which compiled Verilog is fast enough; the test files write what else their board has
  local board=$tree/etc/haptic-panel/boards/panel
  cp -r "$checkout/boards/simulated" "$board"
  sed -i 's/^pitch_mm = .*/pitch_mm = 15.0\ncoarse = true/; s/^snap_mm = .*/snap_mm = 7.0/; s/^bit_clock_hz = .*/bit_clock_hz = 250e3/' "$board/board.toml"
  STATE_DIRECTORY=$tree/var/lib/haptic-panel OPENBLAS_NUM_THREADS=1 "$python" -m controller bank build --board "$board" --scene scene --json >/dev/null
}

cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/trees
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
made=$cache/$("$here/state_of_checkout.sh" make_tree.sh release_manifest.py)-$(echo "$base $version $packages" | sha256sum | cut -c1-8)
if [ ! -e "$made" ]; then
  find "$cache" -mindepth 1 -maxdepth 1 -type d -mtime +0 -exec rm -rf {} +
  work=$(mktemp -d "$cache/making.XXXXXX")
  trap 'rm -rf "$work"' EXIT
  make "$work/tree"
  mv -T "$work/tree" "$made" # whole or not there
fi
cp -a --reflink=auto "$made/." "$tree"
exec 9>&-
chmod 755 "$tree"

printf '%s %s\n' /usr /usr "$checkout" /checkout "$packages" /opt/packages >"$tree/binds"
[ "$base" = /usr ] || echo "$base /opt/python" >>"$tree/binds"
if [[ "$*" == *commissioning* ]]; then # what it installs by itself
  wheels=$("$here/make_wheels.sh")
  echo "$wheels /opt/wheels" >>"$tree/binds"
  mkdir -p "$tree/root/.cache"
  cp -r "$wheels/YoWASP" "$tree/root/.cache/"
fi
"$here/boot_into_tests.sh" "$tree" "/opt/haptic-panel/releases/$release/venv/bin/python" "$@"
