#!/bin/bash
# Makes the systemd of a file tree run the tests of files, as root, and nothing else; it tells their exit code and powers off.
# usage: boot_into_tests.sh TREE INTERPRETER [--slow] FILE.py...     INTERPRETER: path in the tree
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../..")
tree=$1 interpreter=$2
shift 2
files=()
[ "$1" != --slow ] || { files=(--slow) && shift; }
for file in "$@"; do files+=("/checkout/$(realpath --relative-to="$checkout" "$file")"); done
cat >"$tree/etc/systemd/system/tests.service" <<U
[Unit]
Requires=basic.target
After=basic.target
[Service]
Type=oneshot
TimeoutStartSec=infinity
Environment=PATH=/usr/sbin:/usr/bin PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
# a container copies the mode of this machine's, where a program run as root may have spoilt it
ExecStartPre=/bin/chmod 666 /dev/null
ExecStart=/bin/sh -c 'exec >/dev/console 2>&1; "\$@"; echo "ENDS WITH \$\$?"; sync; systemctl poweroff -ff' sh \\
  $interpreter /checkout/tests/kernel/run_tests.py ${files[*]}
U
printf '[Unit]\nRequires=tests.service\nAllowIsolate=yes\n' >"$tree/etc/systemd/system/tests.target"
ln -s tests.target "$tree/etc/systemd/system/default.target"
for unit in systemd-hwdb-update.service ldconfig.service console-getty.service getty.target; do
  ln -s /dev/null "$tree/etc/systemd/system/$unit"
done
