#!/bin/sh
# An initrd that loads modules in order, mounts the host's root read-only by 9p and changes over to it.
# usage: make_initrd.sh TREE KERNEL_VERSION BUSYBOX OUT MODULE...     a MODULE is a name, or a .ko file
# On the kernel's command line: guest_init=PATH is started in the end; MODULE.PARAMETER=VALUE is handed to a module.
set -e
tree=$1 version=$2 busybox=$3 out=$4
shift 4
content=$(mktemp -d)
mkdir -p "$content/bin" "$content/modules" "$content/proc" "$content/sys" "$content/dev" "$content/new"
cp "$busybox" "$content/bin/busybox"
for module in "$@"; do
  case $module in
    *.ko) echo "$module" ;;
    *) /sbin/modprobe -d "$tree" -S "$version" --show-depends "$module" | awk '$1 == "insmod" { print $2 }' ;;
  esac
done | awk '!seen[$0]++' | while read -r file; do
  cp "$file" "$content/modules/"
  basename "$file"
done >"$content/order"
cat >"$content/init" <<'I'
#!/bin/busybox sh
b=/bin/busybox
$b mount -t proc proc /proc
$b mount -t devtmpfs dev /dev
$b mount -t sysfs sys /sys
for word in $($b cat /proc/cmdline); do case $word in guest_init=*) init=${word#*=};; esac; done
while read -r module; do
  set --
  for word in $($b cat /proc/cmdline); do case $word in ${module%.ko}.*) set -- "$@" "${word#*.}";; esac; done
  $b insmod "/modules/$module" "$@"
done </order
$b mount -t 9p -o ro,trans=virtio,version=9p2000.L,msize=262144,cache=loose hostroot /new
$b mount --move /dev /new/dev
$b umount /sys
$b umount /proc
exec $b switch_root /new "$init"
I
chmod +x "$content/init"
(cd "$content" && find . | cpio -o -H newc --quiet | gzip -1) >"$out"
rm -rf "$content"
