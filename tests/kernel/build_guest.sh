#!/bin/bash
# Builds what a guest boots from, once: the stock Debian kernel, the modules gpio-sim (Debian leaves it out) and labdev, an initrd.
# usage: build_guest.sh     prints the folder that holds `vmlinux`, `initrd` and `busybox`; the first run takes half a minute
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ "$(uname -m)" = x86_64 ] || { echo "build_guest.sh: the guest's kernel is amd64, this machine is $(uname -m)" >&2; exit 1; }
cache=${XDG_CACHE_HOME:-$HOME/.cache}/haptic-panel/kernel_guest
recipe=$(cat "$here"/build_guest.sh "$here"/make_initrd.sh "$here"/labdev/labdev.c | sha256sum | cut -c1-16)
done=$cache/$recipe
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9 # a second run waits for the first and finds its work
if [ ! -e "$done" ]; then
  work=$(mktemp -d "$cache/building.XXXXXX")
  log=$cache/build.log
  trap 'rm -rf "$work"' EXIT
  trap 'echo "build_guest.sh: failed; the end of $log:" >&2; tail -n 15 "$log" >&2' ERR
  "$here/install_packages.sh" qemu-system-x86 kmod cpio gcc make xz-utils >"$log" 2>&1
  # such as 6.1.0-56-amd64, 6.1.0-56 and 6.1
  version=$(apt-cache depends linux-image-amd64 | sed -n 's/.*Depends: linux-image-//p' | head -n 1)
  base=${version%-amd64}
  series=$(printf '%s' "$base" | cut -d. -f1-2)
  root=$work/root
  mkdir -p "$work"/{deb,source,gpio-sim,labdev} "$root"
  (cd "$work/deb" && apt-get -o APT::Sandbox::User=root download -q "linux-image-$version" "linux-headers-$version" "linux-headers-$base-common" \
    "linux-kbuild-$series" "linux-source-$series" busybox-static) >>"$log" 2>&1
  for package in "$work"/deb/linux-{image,headers,kbuild}-*.deb "$work"/deb/busybox-static*.deb; do dpkg-deb -x "$package" "$root"; done
  headers=$root/usr/src/linux-headers-$version
  sed -i "s#/usr/src/linux-headers-$base-common#$root/usr/src/linux-headers-$base-common#" "$headers/Makefile"
  # tar is commanded to stop at the last file, and what feeds it dies of a closed pipe
  (set +o pipefail; dpkg-deb --fsys-tarfile "$work"/deb/linux-source-*.deb | tar x -O "./usr/src/linux-source-$series.tar.xz" |
    tar xJ -C "$work/source" --strip-components=1 --occurrence=1 \
      "linux-source-$series"/{drivers/gpio/gpio-sim.c,drivers/gpio/gpiolib.h,kernel/irq/irq_sim.c}) 2>>"$log" || true
  cp "$work/source/drivers/gpio/gpiolib.h" "$work/gpio-sim/"
  cp "$work/source/drivers/gpio/gpio-sim.c" "$work/gpio-sim/gpio-sim-main.c"
  # irq_to_desc is not exported to modules
  sed 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' "$work/source/kernel/irq/irq_sim.c" \
    >"$work/gpio-sim/irq_sim.c"
  printf 'obj-m += gpio-sim.o\ngpio-sim-y := gpio-sim-main.o irq_sim.o\n' >"$work/gpio-sim/Makefile"
  cp "$here"/labdev/{labdev.c,Makefile} "$work/labdev/"
  for module in gpio-sim labdev; do make -s -C "$headers" M="$work/$module" modules >>"$log" 2>&1; done
  /sbin/depmod -b "$root" "$version"
  mkdir "$work/ready"
  "$here/make_initrd.sh" "$root" "$version" "$root/bin/busybox" "$work/ready/initrd" \
    virtio_pci 9pnet_virtio 9p overlay virtio_console evdev uinput i2c-dev softdog configfs "$work/gpio-sim/gpio-sim.ko" "$work/labdev/labdev.ko" >>"$log" 2>&1
  # unpacked here: the guest would take 7 s for it
  packed=$root/boot/vmlinuz-$version
  from=$(LC_ALL=C grep -aboP -m 1 '\xFD7zXZ\0' "$packed" | head -n 1 | cut -d: -f1)
  xz -dc --single-stream < <(tail -c "+$((from + 1))" "$packed") >"$work/ready/vmlinux" 2>>"$log" # and leaves what follows
  cp "$root/bin/busybox" "$work/ready/busybox"
  sync
  mv -T "$work/ready" "$done" # whole or not there
fi
echo "$done"
