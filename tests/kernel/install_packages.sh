#!/bin/bash
# Installs those Debian packages that are missing, as root or by sudo; one run at a time.
# usage: install_packages.sh PACKAGE...
set -euo pipefail
dpkg -s "$@" >/dev/null 2>&1 && exit
as_root=(env DEBIAN_FRONTEND=noninteractive)
[ "$(id -u)" = 0 ] || as_root=(sudo "${as_root[@]}")
"${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update -q
"${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 install -y -q --no-install-recommends "$@"
