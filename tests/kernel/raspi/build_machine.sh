#!/bin/bash
# Builds what the emulated Pi boots from, once: QEMU with a Pi 4, the FPGA's wires for it, Debian's arm64 kernel, Python and wheels.
# usage: build_machine.sh PYTHON     prints the folder; Debian 12 amd64; PYTHON: one with pip. 230 MB are downloaded.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../../..")
python=$1
[ "$(uname -m)" = x86_64 ] || { echo "build_machine.sh: its QEMU is amd64, this machine is $(uname -m)" >&2; exit 1; }
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[ "$release" = bookworm ] || { echo "build_machine.sh: needs Debian 12, whose Python is that of the machine; this is ${release:-none}" >&2; exit 1; }
requirements() { # of the device, or of an extra; not `$1`, which are compiled here
  python3 - "$checkout/pyproject.toml" "$1" "${2:-}" <<'P'
import re, sys, tomllib
with open(sys.argv[1], "rb") as file:
    project = tomllib.load(file)["project"]
wanted = project["optional-dependencies"][sys.argv[3]] if sys.argv[3] else project["dependencies"]
wanted = [each.split(";")[0].strip() for each in wanted]
print(*(each for each in wanted if not re.fullmatch(sys.argv[2], re.split("[^a-z0-9]", each)[0])), sep="\n")
P
}
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/raspi
recipe=$({ cat "$here"/{build_machine.sh,device_tree.sh,fpga_wire.c,probe.c} && requirements '' && requirements '' offline; } | sha256sum | cut -c1-16)
done=$cache/$recipe
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
[ ! -e "$done" ] || { echo "$done" && exit; }

work=$(mktemp -d "$cache/building.XXXXXX")
log=$cache/build.log
trap 'rm -rf "$work"' EXIT
trap 'echo "build_machine.sh: failed; the end of $log:" >&2; tail -n 15 "$log" >&2' ERR
apt=$work/apt
mkdir -p "$work"/{ready,boot} "$apt"/{sources,lists/partial,cache,archives-amd64/partial,archives-arm64/partial}
export DEBIAN_FRONTEND=noninteractive
apt_for() { # ARCHITECTURE STATUS ARGUMENTS...: apt with lists of its own; STATUS says what is installed already
  local architecture=$1 status=$2
  shift 2
  APT_CONFIG=$apt/apt.conf apt-get -q -o APT::Architecture="$architecture" -o Dir::State::status="$status" \
    -o Dir::Cache::archives="$apt/archives-$architecture/" "$@"
}
compiled() { python3 -m compileall -q -j 0 --invalidation-mode unchecked-hash "$@" || true; } # in the machine that takes minutes
packed() { (cd "$1" && find . | cpio -o -H newc --quiet) >"$2"; }

build() {
  "$here/../install_packages.sh" gcc gcc-aarch64-linux-gnu libc6-dev-arm64-cross pkg-config libglib2.0-dev device-tree-compiler cpio xz-utils
  # This machine's sources, and beside them the same with the suite bookworm-backports
  local file name
  for file in /etc/apt/sources.list.d/*.sources; do
    [ -e "$file" ] || continue
    cp "$file" "$apt/sources/"
    awk -v RS= -v ORS='\n\n' -v n="$release" '$0 ~ "(^|\n)Suites:([^\n]* )?" n "( |\n|$)"' "$file" |
      sed "s/^Suites:.*/Suites: $release-backports/; s/^Types:.*/Types: deb deb-src/" >"$apt/sources/backports-$(basename "$file")"
  done
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -e "$file" ] || continue
    name=$(basename "$file" .list)
    cp "$file" "$apt/sources/$name-.list"
    sed -nE "/^deb +(\[[^]]*\] +)?[^ ]+ +$release +/{s/ $release / $release-backports /;p;s/^deb /deb-src /;p}" "$file" >"$apt/sources/backports-$name.list"
  done
  find "$apt/sources" -empty -delete
  : >"$apt/empty"
  printf '%s\n' 'Dir::Etc::sourcelist "/dev/null";' "Dir::Etc::sourceparts \"$apt/sources\";" "Dir::State::lists \"$apt/lists\";" \
    "Dir::Cache \"$apt/cache\";" 'APT::Architectures { "amd64"; "arm64"; };' 'Acquire::Languages "none";' 'APT::Sandbox::User "root";' \
    'Debug::NoLocking "1";' >"$apt/apt.conf"
  apt_for amd64 /var/lib/dpkg/status update
  build_qemu
  build_wires
  build_kernel
  build_userland
  build_wheels
}

build_qemu() { # bookworm's own has no Pi 4; libraries that this machine lacks come with it
  local package missing qemu=$work/ready/qemu
  mkdir -p "$qemu" "$work/deb" && cd "$work/deb"
  apt_for amd64 /var/lib/dpkg/status download "qemu-system-arm/$release-backports" "qemu-system-common/$release-backports" "qemu-system-data/$release-backports"
  missing=$(for package in *.deb; do dpkg-deb -f "$package" Depends | tr , '\n'; done | sed 's/^ *//; s/[ (|:].*//' | sort -u | while read -r package; do
    case $package in
      qemu* | seabios | ipxe* | "") ;;
      *) dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || echo "$package" ;;
    esac
  done)
  # shellcheck disable=SC2086 # one word a package
  [ -z "$missing" ] || apt_for amd64 /var/lib/dpkg/status -y install --download-only --no-install-recommends $missing
  apt_for amd64 /var/lib/dpkg/status download qemu-user-static
  for package in *.deb "$apt"/archives-amd64/*.deb; do [ ! -e "$package" ] || dpkg-deb -x "$package" "$qemu"; done
  find "$qemu/usr/bin" -type f ! -name qemu-system-aarch64 ! -name qemu-aarch64-static -delete
  test -x "$qemu/usr/bin/qemu-system-aarch64"
  test -x "$qemu/usr/bin/qemu-aarch64-static"
}

build_wires() { # of QEMU's source only headers are used, and what generates some of them
  local source=$work/source generated=$work/generated
  mkdir -p "$source/x" "$generated/qapi" && cd "$source"
  APT_CONFIG=$apt/apt.conf apt-get -q source --download-only --tar-only "qemu/$release-backports"
  tar xf qemu_*.orig.tar.xz -C x --strip-components=1 --anchored --wildcards --no-wildcards-match-slash \
    'qemu-*/include' 'qemu-*/host' 'qemu-*/qapi' 'qemu-*/scripts/qapi*' 'qemu-*/tcg/i386'
  for name in CONFIG_{LINUX,POSIX,TCG,PLUGIN,IOVEC,ATOMIC64,INT128,INT128_TYPE,SYSMACROS} HAVE_{STRCHRNUL,SYSTEM_FUNCTION}; do
    echo "#define $name 1"
  done >"$generated/config-host.h"
  : >"$generated/config-poison.h"
  PYTHONPATH=x/scripts python3 x/scripts/qapi-gen.py -o "$generated/qapi" -b x/qapi/qapi-schema.json
  # shellcheck disable=SC2046 # flags are words
  gcc -O2 -fPIC -shared -Wall -Werror -D_GNU_SOURCE -D_FILE_OFFSET_BITS=64 -I"$generated" -I"$generated/qapi" -Ix/include -Ix \
    -Ix/host/include/x86_64 -Ix/host/include/generic -Ix/tcg/i386 $(pkg-config --cflags glib-2.0) -o "$work/ready/fpga_wire.so" "$here/fpga_wire.c"
}

build_kernel() { # Debian's own, with its driver of the SPI; the probe of its interfaces beside it
  local package root=$work/root
  mkdir -p "$work/k" "$root"/{bin,m,proc,sys,dev,tmp,root} && cd "$work/k"
  package=$(APT_CONFIG=$apt/apt.conf apt-cache -o APT::Architecture=arm64 -o Dir::State::status="$apt/empty" show "linux-image-arm64/$release-backports" |
    sed -n 's/^Depends: \(linux-image-[^ ,]*\).*/\1/p' | head -n 1)
  apt_for arm64 "$apt/empty" download "$package/$release-backports"
  dpkg-deb --fsys-tarfile linux-image-*.deb | tar x --wildcards './boot/vmlinuz-*' '*/bcm2711-rpi-4-b.dtb' '*/spi-bcm2835.ko*'
  mv boot/vmlinuz-* "$work/ready/vmlinuz"
  find . -name 'spi-bcm2835.ko.xz' -exec xz -d {} +
  find . -name 'spi-bcm2835.ko' -exec mv {} "$root/m/" \;
  test -s "$root/m/spi-bcm2835.ko"
  "$here/device_tree.sh" "$(find . -name bcm2711-rpi-4-b.dtb)" "$work/ready/pi4.dtb"
  apt_for arm64 "$apt/empty" download busybox-static
  dpkg-deb -x busybox-static*.deb busybox
  cp "$(find busybox -type f -path '*/bin/busybox')" "$root/bin/busybox"
  aarch64-linux-gnu-gcc -O2 -static -Wall -Werror -o "$root/bin/probe" "$here/probe.c"
  packed "$root" "$work/ready/small.cpio"
}

build_userland() { # Python and its evdev for arm64, unpacked only
  local package root=$work/ready/arm64
  mkdir -p "$root" "$work/headers"
  apt_for arm64 "$apt/empty" -y install --download-only --no-install-recommends python3-evdev libstdc++6
  for package in "$apt"/archives-arm64/*.deb; do
    case ${package##*/} in python3* | libpython3* | lib[a-z]* | zlib* | media-types*) dpkg-deb -x "$package" "$root" ;; esac
  done
  cd "$work" && apt_for arm64 "$apt/empty" download libpython3.11-dev
  dpkg-deb --fsys-tarfile libpython3.11-dev_*.deb | tar x -C "$work/headers" ./usr/include
  cp -r "$work/headers/usr/include" "$work/ready/include"
  cd "$root"
  rm -rf usr/share usr/include usr/lib/gcc usr/lib/python3.*/{test,idlelib,lib2to3,ensurepip,pydoc_data} usr/lib/aarch64-linux-gnu/{gconv,perl*}
  test -x usr/bin/python3.11
  compiled usr/lib/python3.11 usr/lib/python3
  packed "$root" "$work/ready/userland.cpio"
}

build_wheels() { # what the package depends on; spidev is compiled, as on a Pi; of the extra `offline` what builds banks
  local wanted platform platforms=() wheels=$work/wheels
  for platform in manylinux_2_{36,28,27,17}_aarch64 manylinux2014_aarch64; do platforms+=(--platform "$platform"); done
  for wanted in device offline; do
    mkdir -p "$wheels/$wanted/usr/lib/$wanted"
    # `arguments`: a list, one requirement a line
    local arguments
    if [ $wanted = device ]; then mapfile -t arguments < <(requirements 'spidev|evdev'); else mapfile -t arguments < <(requirements matplotlib offline); fi
    "$python" -m pip download -q --disable-pip-version-check --no-deps -d "$wheels" --only-binary=:all: --implementation cp --python-version 3.11 \
      --abi cp311 --abi abi3 --abi none "${platforms[@]}" "${arguments[@]}"
    python3 -c 'import sys, zipfile; [zipfile.ZipFile(each).extractall(sys.argv[1]) for each in sys.argv[2:]]' "$wheels/$wanted/usr/lib/$wanted" "$wheels"/*.whl
    rm "$wheels"/*.whl
  done
  cd "$wheels"
  "$python" -m pip download -q --disable-pip-version-check --no-deps --no-binary=:all: "$(requirements '(?!spidev).*')"
  tar xzf spidev-*.tar.gz
  aarch64-linux-gnu-gcc -O2 -shared -fPIC -w -I"$work/headers/usr/include/python3.11" -I"$work/headers/usr/include" \
    -o device/usr/lib/device/spidev.cpython-311-aarch64-linux-gnu.so spidev-*/spidev_module.c
  for wanted in device offline; do
    find $wanted \( -name tests -o -name '*.pyi' -o -name '*.a' -o -name '*.h' \) -prune -exec rm -rf {} +
    compiled "$wanted"
    cp -r "$wanted"/usr "$work/ready/arm64/"
  done
  packed device "$work/ready/wheels.cpio"
}

build >"$log" 2>&1 & # `set -e` holds in a process of its own, not behind ||
wait $!
sync
mv -T "$work/ready" "$done" # whole or not there
echo "$done"
