#!/bin/sh
# Sets up a checkout: Debian packages that are missing (as root, or with sudo), then .venv with the package and an extra.
# usage: sh controller/set_up.sh offline | test | test,gateware
set -eu
cd "$(dirname "$0")/.."
extra=${1:-}
packages='build-essential python3-dev python3-venv' megabytes=80
case $extra in
  offline) ;;
  test) packages="$packages iverilog liblz4-dev strace zlib1g-dev" megabytes=250 ;;
  test,gateware) packages="$packages iverilog liblz4-dev strace zlib1g-dev ngspice" megabytes=280 ;;
  *) echo "usage: sh controller/set_up.sh offline | test | test,gateware" >&2 && exit 2 ;;
esac
echo "haptic-panel: Debian packages, then Python packages (about $megabytes MB): 1 to 4 minutes"
missing= as_root=
for package in $packages; do # of a package that was removed dpkg still has the settings, and knows its name
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
done
if ! command -v apt-get >/dev/null; then
  echo "no apt-get here; needed are a C compiler, and Python 3.11 or later with its headers and venv" >&2
elif [ "$missing" ]; then
  lacking() { echo "set_up.sh: $1: ask the administrator for: apt-get install$missing; then call this again" >&2 && exit 1; }
  if [ "$(id -u)" != 0 ]; then
    as_root=sudo
    command -v sudo >/dev/null || lacking "Debian packages are missing, and there is no sudo here"
  fi
  { $as_root apt-get update -q && $as_root apt-get install -y -q --no-install-recommends $missing; } ||
    lacking "Debian packages are missing, and ${as_root:-apt-get} did not install them"
fi
python3 -m venv .venv
exec .venv/bin/pip install --disable-pip-version-check -e ".[$extra]"
