#!/bin/bash
# Makes the file tree in which systemd runs the service, in a container or in the guest: /usr is to be this machine's own,
# read-only, with TREE/over laid over it, what the Debian package puts there; /etc is empty but for what is needed to boot; this
# checkout is at /checkout and is installed as the release in use, below /opt/haptic-panel.
# usage: make_tree.sh PYTHON TREE FILE.py...     the files are run by run_tests.py; TREE/binds lists what is to be bound where
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../..")
python=$1 tree=$2
shift 2
chmod 755 "$tree"
mkdir -p "$tree"/{usr,checkout,dev,proc,sys,run,tmp,home,root,mnt,var/lib/haptic-panel,var/tmp,etc/systemd/system,opt/python,opt/packages}
mkdir -p "$tree"/{opt/haptic-panel/{releases,state,requests,store,download},etc/haptic-panel/boards,over/bin,over/lib/haptic-panel}
chmod 1777 "$tree/tmp" "$tree/var/tmp"
ln -s usr/bin usr/sbin usr/lib usr/lib64 "$tree/"
echo 00000000000000000000000000000001 >"$tree/etc/machine-id" # a known machine: not every unit of /usr is enabled
echo 'root:x:0:0:root:/root:/bin/sh' >"$tree/etc/passwd"
echo 'root:x:0:' >"$tree/etc/group"
echo /opt/python/lib >"$tree/etc/ld.so.conf"
cp /etc/os-release "$tree/etc/"

# a release as it is on a device: the package as `pip install` leaves it in a virtual environment; its dependencies from the one
# that runs the tests
base=$("$python" -c 'import sys; print(sys.base_prefix)')
version=$("$python" -c 'import sys; print(f"python3.{sys.version_info[1]}")')
packages=$("$python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
printf '%s %s\n' /usr /usr "$checkout" /checkout "$packages" /opt/packages >"$tree/binds"
if [[ "$*" == *commissioning* ]]; then # what it installs by itself
  wheels=$("$here/make_wheels.sh")
  mkdir "$tree/opt/wheels"
  echo "$wheels /opt/wheels" >>"$tree/binds"
fi
interpreter=/usr/bin
case $base in
  /usr) ;;
  *) interpreter=/opt/python/bin && echo "$base /opt/python" >>"$tree/binds" ;;
esac
export PYTHONPATH=$checkout
release=$("$python" -c 'from controller import __version__; print(__version__)')
folder=$tree/opt/haptic-panel/releases/$release
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
board=$tree/etc/haptic-panel/boards/panel
cp -r "$checkout/boards/simulated" "$board"
sed -i 's/^pitch_mm = .*/pitch_mm = 15.0\ncoarse = true/; s/^snap_mm = .*/snap_mm = 7.0/; s/^bit_clock_hz = .*/bit_clock_hz = 250e3/' "$board/board.toml"
STATE_DIRECTORY=$tree/var/lib/haptic-panel OPENBLAS_NUM_THREADS=1 "$python" -m controller bank build --board "$board" --scene scene --json >/dev/null

"$here/boot_into_tests.sh" "$tree" "/opt/haptic-panel/releases/$release/venv/bin/python" "$@"
