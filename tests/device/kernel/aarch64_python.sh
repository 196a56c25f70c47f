#!/bin/bash
# Debian's Python for 64-bit ARM, for qemu-aarch64-static: unpacked into a folder, nothing of it is installed. With NumPy and what tests need
# beside it as wheels. usage: aarch64_python.sh PYTHON FOLDER     FOLDER/root is the root folder, FOLDER/packages goes into PYTHONPATH
set -euo pipefail
python=$1
missing=
for package in qemu-user-static unzip; do [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing=1; done
if [ "$missing" ]; then
  as_root=$([ "$(id -u)" = 0 ] || echo sudo)
  $as_root apt-get update -q
  $as_root apt-get install -y -q --no-install-recommends qemu-user-static unzip
fi
mkdir -p "$2"/{root,packages,apt/{lists/partial,cache/archives/partial}}
cd "$2"
: >apt/status # as of a machine on which nothing is installed
printf '%s "%s";\n' Dir::State::lists "$PWD/apt/lists" Dir::State::status "$PWD/apt/status" Dir::Cache "$PWD/apt/cache" \
  APT::Architecture arm64 APT::Architectures:: arm64 Acquire::Languages none Debug::NoLocking 1 >apt/apt.conf
export APT_CONFIG=$PWD/apt/apt.conf
apt-get -q update
apt-get -q -y install --download-only --no-install-recommends python3-minimal libpython3-stdlib libstdc++6
for package in apt/cache/archives/*.deb; do dpkg-deb -x "$package" root; done
version=$(basename "$(readlink root/usr/bin/python3)")
platforms=(--platform manylinux_2_28_aarch64 --platform manylinux_2_27_aarch64 --platform manylinux_2_17_aarch64 --platform manylinux2014_aarch64)
"$python" -m pip download -q --disable-pip-version-check --no-deps -d wheels --only-binary=:all: --implementation cp --python-version "${version#python}" \
  --abi "cp${version//[!0-9]/}" --abi abi3 --abi none "${platforms[@]}" numpy pytest pluggy iniconfig packaging pygments hypothesis sortedcontainers attrs
for wheel in wheels/*.whl; do unzip -qo "$wheel" -d packages; done
