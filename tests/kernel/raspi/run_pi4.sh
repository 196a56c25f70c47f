#!/bin/bash
# Boots the emulated Pi twice: for the probe of its interfaces, then for doctor and plays in each form of the package.
# usage: run_pi4.sh PYTHON OUT     writes probe.log, probe.json, product.log, product.json and panel.bank to OUT
# Forms of the package: `numpy` is this checkout without anything compiled, `kernel` the wheel for aarch64, with the compiled kernel,
# `mypyc` the same with the modules of the loop compiled too.
# LIMIT_S ends a machine that hangs: seconds without a word from it that this one had to spare (patience.py).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
checkout=$(realpath "$here/../../..")
python=$(realpath -s "$1")
mkdir -p "$2"
out=$(realpath "$2")
shift 2
machine=$("$here/build_machine.sh" "$python")
run=$(mktemp -d)
pids=()
end() {
  local pid
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  rm -rf "$run"
}
trap end EXIT
trap 'exit 99' HUP INT TERM
export PYTHONPATH=$checkout PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1

"$python" - "$out/panel.bank" <<'P'
import sys
from pathlib import Path
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.device.board.board import load_board
from controller.device.board.lookup import find_board
build_bank(BankRequest(load_board(find_board("ulx3s")), Path(sys.argv[1]), 10e-3))
P
wheel_of() { # FORM VARIABLES...: the wheel for aarch64, unpacked as a form of the package
  local form=$1
  shift
  (cd "$checkout" && env CC=aarch64-linux-gnu-gcc _PYTHON_HOST_PLATFORM=linux-aarch64 "$@" "$python" -m hatchling build -t wheel -d "$run/$form" >&2)
  python3 -m zipfile -e "$run/$form"/*aarch64.whl "$root/$form"
  mkdir -p "$run/tree/usr"
  cp -r "$root/$form"/*.data/data/share "$run/tree/usr/" # the same of each
  rm -r "$root/$form"/*.data
  local module
  find "$root/$form" -name '*-x86_64-linux-gnu.so' | while read -r module; do mv "$module" "${module/x86_64/aarch64}"; done # named for this Python
}
root=$run/tree/root
mkdir -p "$root"/{numpy,tests/workshop/benchmark,tests/device/touch}
(cd "$checkout" && tar c --exclude=__pycache__ --exclude='*.so' controller boards fpga_rtl pyproject.toml) | tar x -C "$root/numpy"
mkdir "$root/numpy/haptic_panel-0.dist-info"
printf 'Metadata-Version: 2.1\nName: haptic-panel\nVersion: 0\n' >"$root/numpy/haptic_panel-0.dist-info/METADATA"
wheel_of kernel
wheel_of mypyc HAPTIC_PANEL_MYPYC=1 CFLAGS="-I$machine/include" # Python's headers for aarch64: only the kernel does without
cp "$checkout"/tests/workshop/benchmark/{looped_panel.py,scene.toml} "$root/tests/workshop/benchmark/"
cp -r "$checkout/tests/device/touch/recordings" "$root/tests/device/touch/"
cp "$here/guest_plays.py" "$out/panel.bank" "$root/"
install -m 755 "$here/guest_init" "$run/tree/init"
(cd "$run/tree" && python3 -m compileall -q -j 0 --invalidation-mode unchecked-hash root || true) # in the machine that takes minutes
(cd "$run/tree" && find . | cpio -o -H newc --quiet) >"$run/package.cpio"

boot() { # NAME FAR_END SETTINGS PARTS...: one life of the machine
  local name=$1 far_end=$2 settings=$3 far qemu patience libraries=$machine/qemu/usr/lib/x86_64-linux-gnu
  shift 3
  cat "$@" >"$run/initrd"
  : >"$out/$name.log"
  rm -f "$out/$name.json"
  setpriv --pdeathsig TERM "$python" "$here/far_end.py" "$run/$name" "$out/$name.json" "$far_end" &
  far=$!
  pids+=("$far")
  until [ -S "$run/$name" ]; do
    kill -0 "$far" # ended already: so does this
    sleep 0.05
  done
  # -icount: each instruction takes 2 ns of the machine's time, however busy this one is. Of its processors one is used:
  # others would spin, and keep the time from skipping idle.
  LD_PRELOAD=$machine/fpga_wire.so LD_LIBRARY_PATH=$libraries:$machine/qemu/lib/x86_64-linux-gnu QEMU_MODULE_DIR=$libraries/qemu \
    "$machine/qemu/usr/bin/qemu-system-aarch64" -L "$machine/qemu/usr/share/qemu" -M raspi4b -icount shift=1,sleep=off -display none \
    -monitor none -serial stdio -no-reboot -kernel "$machine/vmlinuz" -initrd "$run/initrd" -dtb "$machine/pi4.dtb" \
    -append "console=ttyAMA0,115200 quiet panic=-1 nokaslr mitigations=off apparmor=0 raspi.do=$name $settings" \
    -device "fpga-wire,bus=spi,socket=$run/$name,byte-clocks=${BYTE_CLOCKS:-9}" </dev/null > >(exec sed -u 's/\r//g' >"$out/$name.log") 2>&1 &
  qemu=$!
  pids+=("$qemu")
  "$python" "$here/../../patience.py" "$qemu" "$out/$name.log" "${LIMIT_S:-600}" &
  patience=$!
  pids+=("$patience")
  while kill -0 "$qemu" 2>/dev/null && ! grep -qE '^MACHINE ENDS|Kernel panic' "$out/$name.log"; do sleep 0.5; done
  kill "$qemu" 2>/dev/null || true # on poweroff it only halts
  wait "$qemu" "$patience" || true
  wait "$far"
}

boot probe plain "" "$machine/small.cpio" <(cd "$run/tree" && find init | cpio -o -H newc --quiet)
boot product ulx3s "spidev.bufsiz=8192 spi_bcm2835.polling_limit_us=250" \
  "$machine"/{small,userland,wheels}.cpio "$run/package.cpio"
