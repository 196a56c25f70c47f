#!/bin/bash
# Boots a virtual machine with real evdev/uinput, gpio-sim, spidev and i2c-dev, and runs the tests of files in it as root.
# Its / is this machine's own, read-only, so it has the same Python, packages and checkout; /run and /mnt are its own.
# With --systemd its / is the tree of make_tree.sh, and systemd and udev run in it.
# usage: run_guest.sh [--systemd] PYTHON FILE.py...     exit code: of run_tests.py, or 99 where the guest came to no end
# Variables whose names begin with GUEST_ are handed on (not with --systemd); LIMIT_S ends a guest that hangs: seconds without a
# word from it that this machine had to spare (patience.py).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
systemd=
[ "$1" != --systemd ] || { systemd=1 && shift; }
python=$1
shift
guest=$("$here/build_guest.sh")
run=$(mktemp -d)
machine= gateware=
trap 'kill $machine $gateware 2>/dev/null || true; rm -rf "$run"' EXIT
trap 'exit 99' HUP INT TERM
PYTHONPATH=$(realpath "$here/../..") setpriv --pdeathsig TERM "$python" "$here/host_gateware.py" "$run/gateware" "$run/monitor" &
gateware=$!
{
  echo '#!/bin/sh'
  echo 'exec >/dev/ttyS0 2>&1'
  echo 'export PATH=/usr/sbin:/usr/bin:/sbin:/bin'
  echo 'mount -t proc proc /proc; mount -t sysfs sys /sys; mkdir -p /dev/pts /dev/shm; mount -t devpts devpts /dev/pts'
  echo 'for folder in /dev/shm /run /mnt; do mount -t tmpfs tmpfs $folder; done; mount -t configfs configfs /sys/kernel/config'
} >"$run/init"
if [ "$systemd" ]; then
  "$here/install_packages.sh" systemd systemd-sysv udev procps >/dev/null
  mkdir "$run/tree"
  "$here/make_tree.sh" "$python" "$run/tree" "$@"
  {
    printf 'mount -t tmpfs -o mode=755 tmpfs /mnt; cp -a %q/. /mnt\n' "$run/tree"
    while read -r from to; do
      if [ "$to" = /usr ]; then
        printf 'mount -t overlay -o ro,lowerdir=/mnt/over:%q overlay /mnt/usr\n' "$from"
      else
        printf 'mount --bind %q /mnt%q\n' "$from" "$to"
      fi
    done <"$run/tree/binds"
    echo 'for folder in /dev /proc /sys; do mount --move $folder /mnt$folder; done'
    printf 'cd /mnt; mkdir host; %q pivot_root . host\n' "$guest/busybox"
    echo 'exec chroot . /usr/lib/systemd/systemd </dev/console >/dev/console 2>&1'
  } >>"$run/init"
else
  files=()
  for file in "$@"; do files+=("$(realpath "$file")"); done
  {
    echo 'export HOME=/run TMPDIR=/run PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1'
    printf 'export PYTHONPATH=%q HOST_CACHE=%q\n' "$(realpath "$here/../..")" "${XDG_CACHE_HOME:-$HOME/.cache}"
    for name in $(compgen -e GUEST_ || true); do printf 'export %s=%q\n' "$name" "${!name}"; done
    printf '%q ' "$python" "$here/run_tests.py" "${files[@]}"
    printf '\necho "ENDS WITH $?"\n%q poweroff -f\n' "$guest/busybox"
  } >>"$run/init"
fi
chmod -R a+rX "$run"
chmod +x "$run/init"
until [ -S "$run/gateware" ]; do kill -0 "$gateware"; sleep 0.05; done
# -icount: each instruction takes 2 ns of the guest's time, however busy this machine is
exec 3> >(exec sed -u 's/\r//g' | tee "$run/log")
printer=$!
setpriv --pdeathsig TERM qemu-system-x86_64 -M q35 -accel tcg -icount shift=1 -rtc clock=vm -cpu max -smp 1 -m 1024 -nodefaults -no-user-config \
  -display none -serial stdio -no-reboot -kernel "$guest/vmlinuz" -initrd "$guest/initrd" \
  -virtfs local,path=/,mount_tag=hostroot,security_model=none,readonly=on,multidevs=remap \
  -device virtio-serial -chardev socket,id=gateware,path="$run/gateware" -device virtserialport,chardev=gateware,name=gateware \
  -qmp unix:"$run/monitor",server=on,wait=off \
  -append "console=ttyS0 quiet panic=-1 mitigations=off nokaslr tsc=reliable no_timer_check labdev.bus_num=0 \
    systemd.show_status=false guest_init=$run/init" \
  </dev/null >&3 2>&1 3>&- &
machine=$!
exec 3>&-
"$python" "$here/../patience.py" $machine "$run/log" "${LIMIT_S:-900}" &
wait $machine || true
wait $printer || true
exit "$(sed -n 's/^ENDS WITH \([0-9]*\)$/\1/p' "$run/log" | tail -n 1 | grep . || echo 99)"
