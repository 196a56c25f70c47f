#!/bin/bash
# Installs those Debian packages that are missing, as root or by sudo; one run at a time.
# usage: install_packages.sh PACKAGE...
set -euo pipefail
dpkg -s "$@" >/dev/null 2>&1 && exit
as_root=(env DEBIAN_FRONTEND=noninteractive)
[ "$(id -u)" = 0 ] || as_root=(sudo "${as_root[@]}")
# In containers apt's own user may lack what checking a signature needs: root checks it.
options=(-o DPkg::Lock::Timeout=300 -o APT::Sandbox::User=root)
"${as_root[@]}" apt-get "${options[@]}" update -q
"${as_root[@]}" apt-get "${options[@]}" install -y -q --no-install-recommends "$@"
