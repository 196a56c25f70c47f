#!/bin/bash
# Makes the file tree of a machine with a dpkg of its own, which the Debian package is installed on: a small Debian, this checkout
# at /checkout, and the packages of make_packages.sh at /packages. Debian's Python runs the tests, with what the environment of this machine's tests has at /opt/packages.
# usage: make_debian_tree.sh PYTHON TREE [--slow] FILE.py...     the files are run by run_tests.py; TREE/binds lists what is to be bound where
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../..")
python=$1 tree=$2
shift 2
as_root=()
[ "$(id -u)" = 0 ] || as_root=(sudo)
"${as_root[@]}" tar xf "$("$here/make_debian.sh")" -C "$tree"
"${as_root[@]}" chown "$(id -u)" "$tree" "$tree"/etc/systemd/system
version=$("$python" -c 'import sys; print(f"python3.{sys.version_info[1]}")')
[ -e "$tree/usr/bin/$version" ] || { echo "make_debian_tree.sh: this Debian has no $version, for which $python has its packages" >&2; exit 1; }
"${as_root[@]}" mkdir "$tree/checkout" "$tree/packages" "$tree/opt/packages"
echo 00000000000000000000000000000001 | "${as_root[@]}" tee "$tree/etc/machine-id" >/dev/null # a known machine: it boots for the second time
debs=$("$here/make_packages.sh" "$python")
packages=$("$python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
printf '%s %s\n' "$checkout" /checkout "$packages" /opt/packages "$debs" /packages >"$tree/binds"
"$here/boot_into_tests.sh" "$tree" "/usr/bin/env PYTHONPATH=/checkout:/opt/packages /usr/bin/$version" "$@"
