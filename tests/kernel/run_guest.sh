#!/bin/bash
# Boots a virtual machine with real evdev/uinput, gpio-sim, spidev and i2c-dev, and runs the tests of files in it as root.
# Its / is this machine's own, read-only, so it has the same Python, packages and checkout; /run and /mnt are its own.
# Files system_*.py come last: for them its / is changed over to a tree of make_tree.sh, and systemd and udev run in it.
# usage: run_guest.sh [--slow] PYTHON FILE.py...     exit code: of run_tests.py, or 99 where the guest came to no end
# --slow is for run_tests.py. LIMIT_S ends a guest that hangs: seconds without a word from it that this machine had to
# spare (patience.py).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
slow=()
[ "$1" != --slow ] || { slow=(--slow) && shift; }
python=$1
shift
bare=() system=()
for file in "$@"; do
  if [[ ${file##*/} == system_* ]]; then system+=("$file"); else bare+=("$(realpath "$file")"); fi
done
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
parts=0
if [ ${#bare[@]} -gt 0 ]; then
  parts=1
  {
    printf 'PYTHONPATH=%q ' "$(realpath "$here/../..")"
    printf 'HOME=/run TMPDIR=/run PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1 '
    printf '%q ' "$python" "$here/run_tests.py" "${slow[@]}" "${bare[@]}"
    printf '\necho "ENDS WITH $?"\n'
  } >>"$run/init"
fi
if [ ${#system[@]} -gt 0 ]; then
  parts=$((parts + 1))
  "$here/install_packages.sh" systemd systemd-sysv udev procps >/dev/null
  mkdir "$run/tree"
  "$here/make_tree.sh" "$python" "$run/tree" "${slow[@]}" "${system[@]}"
  {
    echo 'mount -t tmpfs -o mode=755 tmpfs /mnt; mkdir /mnt/upper /mnt/work /mnt/tree'
    printf 'mount -t overlay -o lowerdir=%q,upperdir=/mnt/upper,workdir=/mnt/work overlay /mnt/tree; cd /mnt/tree\n' "$run/tree"
    while read -r from to; do
      if [ "$to" = /usr ]; then
        printf 'mount -t overlay -o ro,lowerdir=%q/over:%q overlay usr\n' "$run/tree" "$from"
      else
        printf 'mount --bind %q %q\n' "$from" "${to#/}"
      fi
    done <"$run/tree/binds"
    echo 'for folder in /dev /proc /sys; do mount --move $folder /mnt/tree$folder; done'
    printf 'mkdir host; %q pivot_root . host\n' "$guest/busybox"
    echo 'exec chroot . /usr/lib/systemd/systemd </dev/console >/dev/console 2>&1'
  } >>"$run/init"
else
  printf '%q poweroff -f\n' "$guest/busybox" >>"$run/init"
fi
chmod -R a+rX "$run"
chmod +x "$run/init"
until [ -S "$run/gateware" ]; do kill -0 "$gateware"; sleep 0.05; done
# -icount: each instruction takes 2 ns of the guest's time, however busy this machine is
exec 3> >(exec sed -u 's/\r//g' | tee "$run/log")
printer=$!
setpriv --pdeathsig TERM qemu-system-x86_64 -M q35 -accel tcg -icount shift=1 -rtc clock=vm -cpu max -smp 1 -m 1024 -nodefaults -no-user-config \
  -display none -serial stdio -no-reboot -kernel "$guest/vmlinux" -initrd "$guest/initrd" \
  -virtfs local,path=/,mount_tag=hostroot,security_model=none,readonly=on,multidevs=remap \
  -device pvpanic -action panic=pause \
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
mapfile -t codes < <(sed -n 's/^ENDS WITH \([0-9]*\)$/\1/p' "$run/log" | sort -n)
[ ${#codes[@]} = $parts ] || exit 99
exit "${codes[-1]}"
