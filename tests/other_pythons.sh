#!/bin/bash
# The quick tests where others will run this: in Debian 13 (trixie: Python 3.13, as Raspberry Pi OS has it, Icarus 12) and sid
# (Python 3.14, Icarus 13), each a small Debian in a folder, and here with the oldest version of every package that pyproject.toml
# allows. As root or with sudo; takes from 10 minutes up for each, and what is committed.
# usage: tests/other_pythons.sh trixie | sid | lowest... [-- ARGUMENT OF PYTEST...]     exit code: 1 if any of them fails
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(dirname "$here")
where=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do where+=("$1") && shift; done
[ ${#where[@]} -gt 0 ] || { sed -n 's/^# usage: //p' "$0" >&2 && exit 2; }
shift $(($# > 0))
as_root=(env)
[ "$(id -u)" = 0 ] || as_root=(sudo env)
work=$(mktemp -d)
trap '"${as_root[@]}" rm -rf --one-file-system "$work"' EXIT
failed=0

in_debian() { # SUITE ARGUMENT...
  local suite=$1 root=$work/$1 packages
  shift
  packages=python3,python3-venv,python3-dev,g++,make,iverilog,strace,git,procps,ca-certificates
  "$here/kernel/install_packages.sh" mmdebstrap >/dev/null
  # from where this machine has its own Debian; sid's lists on a mirror may be older than they call valid
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' "Codename: $(. /etc/os-release && echo "$VERSION_CODENAME")" | sed -n 1p)
  "${as_root[@]}" mmdebstrap --quiet --mode=root --format=directory --variant=minbase --include=$packages \
    --aptopt='APT::Sandbox::User "root"' --aptopt='Acquire::Check-Valid-Until "false"' --aptopt='Acquire::Languages "none"' \
    --dpkgopt='path-exclude=/usr/share/locale/*' --dpkgopt='path-exclude=/usr/share/doc/*' "$suite" "$root" "$mirror"
  "${as_root[@]}" git -c safe.directory='*' clone -q "$checkout" "$root/checkout"
  "${as_root[@]}" env | grep -E '^PIP_' >"$work/pip" || true
  "${as_root[@]}" unshare --mount --fork bash -euo pipefail -c '
    root=$1 pip=$2
    shift 2
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    for file in /etc/resolv.conf /etc/hosts /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
      [ ! -e $file ] || cp -L $file "$root$file"
    done
    mapfile -t settings <"$pip"
    exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "${settings[@]}" sh -euc "
      cd /checkout
      python3 --version
      iverilog -V 2>/dev/null | sed -n 1p
      python3 -m venv .venv
      .venv/bin/pip install -q --disable-pip-version-check -e .[test]
      exec .venv/bin/pytest -q \"\$@\"" - "$@"' - "$root" "$work/pip" "$@"
}

with_the_oldest() { # ARGUMENT...
  chmod 755 "$work" # some tests are another user
  git clone -q "$checkout" "$work/lowest"
  cd "$work/lowest"
  python3 -m venv "$work/uv"
  "$work/uv/bin/pip" install -q --disable-pip-version-check uv
  python3 -m venv .venv
  "$work/uv/bin/uv" pip install -q --python .venv/bin/python --native-tls --resolution lowest-direct -e '.[test]'
  # style and types are those of the newest tools, and what old packages do is deprecated by what they rest on
  .venv/bin/pytest -q -W ignore::DeprecationWarning --ignore tests/test_project.py "$@"
}

for place in "${where[@]}"; do
  echo "== $place"
  set +e # a condition would let each step of them fail unnoticed
  case $place in
    lowest) (set -e && with_the_oldest "$@") ;;
    *) (set -e && in_debian "$place" "$@") ;;
  esac
  [ $? = 0 ] || failed=1
  set -e
done
exit $failed
