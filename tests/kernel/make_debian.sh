#!/bin/bash
# A small Debian of this machine's own release, with systemd, Python and a dpkg that tests may use: made once, as a tar.
# usage: make_debian.sh     prints the tar's path
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/debian
done=$cache/$suite-$(sha256sum <"$0" | cut -c1-16).tar
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
if [ ! -e "$done" ]; then
  "$here/install_packages.sh" mmdebstrap >"$cache/log" 2>&1
  as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  sources=()
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do [ ! -e "$file" ] || sources+=("$file"); done
  "${as_root[@]}" mmdebstrap --mode=root --format=tar --variant=minbase --include=systemd,systemd-sysv,udev,kmod,procps,python3 \
    --aptopt='APT::Sandbox::User "root"' --aptopt='Acquire::Languages "none"' --dpkgopt='path-exclude=/usr/share/locale/*' \
    --customize-hook='rm -r "$1"/var/lib/apt/lists/* "$1"/etc/apt/sources.list*' \
    "$suite" "$done.new" "${sources[@]}" >>"$cache/log" 2>&1 || { tail -n 15 "$cache/log" >&2; exit 1; }
  sync "$done.new"
  mv "$done.new" "$done" # whole or not there
fi
echo "$done"
