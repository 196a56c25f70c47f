#!/bin/bash
# Installs those Debian packages that are missing, as root or by sudo; a second run waits for the first, as apt itself would not.
# usage: install_packages.sh PACKAGE...
set -euo pipefail
are_installed() { # a package that was removed may have left its settings: dpkg knows it, too
  for package; do [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || return; done
}
are_installed "$@" && exit
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel
mkdir -p "$cache"
exec 8>"$cache/install.lock"
flock 8
are_installed "$@" && exit
as_root=(env DEBIAN_FRONTEND=noninteractive)
[ "$(id -u)" = 0 ] || as_root=(sudo "${as_root[@]}")
# In containers apt's own user may lack what checking a signature needs: root checks it.
options=(-o DPkg::Lock::Timeout=300 -o APT::Sandbox::User=root)
"${as_root[@]}" apt-get "${options[@]}" update -q 8>&-
"${as_root[@]}" apt-get "${options[@]}" install -y -q --no-install-recommends "$@" 8>&-
