#!/bin/bash
# Boots systemd in a container (as root, or by sudo) on a tree of make_tree.sh and runs the tests of files in it as root; files that
# import the_package get a tree of make_debian_tree.sh: a Debian, on which dpkg installs the package.
# usage: run_container.sh [--slow] PYTHON container_FILE.py...     exit code: of run_tests.py, or 99 where the container came to no end
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
slow=()
[ "$1" != --slow ] || { slow=(--slow) && shift; }
"$here/install_packages.sh" systemd systemd-sysv systemd-container procps udev python3-dev python3-venv >/dev/null
as_root=()
[ "$(id -u)" = 0 ] || as_root=(sudo)
tree=$(mktemp -d)
name=haptic-panel-$$
# A control group of its own, below that of this script: the systemds of containers that share one kill each other's services.
groups=$(findmnt -t cgroup2 -n -o TARGET | head -n 1)
group=$groups$(sed -n 's/^0:://p' /proc/self/cgroup | sed 's:/$::')/$name
machine=
trap 'test -z "$machine" || "${as_root[@]}" kill $machine 2>/dev/null && wait $machine || true; "${as_root[@]}" rm -rf --one-file-system "$tree" "/run/systemd/nspawn/propagate/$name"; "${as_root[@]}" find "$group" -depth -type d -exec rmdir {} +' EXIT
trap 'exit 99' HUP INT TERM
make=make_tree.sh
! grep -qE '^(import|from) the_package' "${@:2}" || make=make_debian_tree.sh
"$here/$make" "$1" "$tree" "${slow[@]}" "${@:2}"
binds=()
while read -r from to; do
  if [ "$to" = /usr ]; then binds+=("--overlay-ro=$from:$tree/over:$to"); else binds+=("--bind-ro=$from:$to"); fi
done <"$tree/binds"
exec 3> >(exec sed -u 's/\r//g' | tee "$tree/log")
printer=$!
"${as_root[@]}" mkdir "$group"
"${as_root[@]}" setpriv --pdeathsig TERM sh -c 'echo $$ >"$0/cgroup.procs" && exec env "$@"' "$group" SYSTEMD_NSPAWN_UNIFIED_HIERARCHY=1 \
  systemd-nspawn -q -b -D "$tree" -M "$name" --register=no --keep-unit --console=interactive --private-network --suppress-sync=yes "${binds[@]}" \
  systemd.show_status=false </dev/null >&3 2>&1 3>&- &
machine=$!
exec 3>&-
"$1" "$here/../patience.py" $machine "$tree/log" "${LIMIT_S:-900}" &
wait $machine || true
wait $printer || true
exit "$(sed -n 's/^ENDS WITH \([0-9]*\)$/\1/p' "$tree/log" | tail -n 1 | grep . || echo 99)"
