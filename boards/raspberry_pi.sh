#!/bin/sh
# Sets firmware and kernel of a Raspberry Pi to what the panel needs (raspberry_pi.md says why); a second call changes nothing.
# usage: sh raspberry_pi.sh ROOT     as root; ROOT: / on the Pi itself, or where an image of Raspberry Pi OS is mounted, boot/firmware in it
set -eu
[ $# = 1 ] || { sed -n 3p "$0" >&2; exit 2; }
root=${1%/}
boot=$root/boot/firmware
for file in "$boot/config.txt" "$boot/cmdline.txt"; do
  [ -f "$file" ] || { echo "raspberry_pi.sh: there is no $file: is $1 Raspberry Pi OS, with its first partition mounted?" >&2; exit 1; }
done
replace() { # FILE: what is read takes its place, whole or not at all; FAT has neither owners nor modes
  cat >"$1.new"
  if cmp -s "$1" "$1.new"; then rm "$1.new"; else sync "$1.new" && mv "$1.new" "$1"; fi
}

# config.txt: our lines are a block of their own at the end, where they win
{
  sed '/^# haptic-panel: begin$/,/^# haptic-panel: end$/d' "$boot/config.txt"
  cat <<'LINES'
# haptic-panel: begin
[pi3]
core_freq_min=400
[pi4]
core_freq_min=500
[all]
dtparam=spi=on
# haptic-panel: end
LINES
} | replace "$boot/config.txt"

# cmdline.txt: one line of words; of these names there may be others already
settings='isolcpus=3 irqaffinity=0-2 spidev.bufsiz=8192 spi_bcm2835.polling_limit_us=250 cpufreq.default_governor=performance'
words=
for word in $(cat "$boot/cmdline.txt"); do
  case " $settings " in
    *" ${word%%=*}="*) ;;
    *) words="$words${words:+ }$word" ;;
  esac
done
echo "$words $settings" | replace "$boot/cmdline.txt"

mkdir -p "$root/etc/sysctl.d"
cat <<'LINES' | replace "$root/etc/sysctl.d/60-haptic-panel.conf"
# The loop has a core of its own: the kernel need not stop it for the sake of others
kernel.sched_rt_runtime_us = -1
LINES
echo "settings of $1 are in place; they hold from the next start on"
