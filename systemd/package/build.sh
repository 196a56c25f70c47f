#!/bin/sh
# The Debian package of a release: users, device rules, units, fall-back script, command, and the release itself.
# usage: build.sh RELEASE ROOT.json [UPDATE.toml]      prints the path of the package, in the folder $OUT, or here
# RELEASE: folder of `haptic-panel update make-release`; its wheels say for which Python and architecture the package is.
# ROOT.json: the trusted root of your repository (`haptic-panel update repository init`). UPDATE.toml: /etc/haptic-panel/update.toml.
# $REVISION (1): of the package, where the release is the same. $DEBFULLNAME, $DEBEMAIL: who made it. $SOURCE_DATE_EPOCH: its time,
# else that of the last commit. The same inputs give the same bytes.
# Needs the Debian packages debhelper, fakeroot and unzip.
set -eu
fail() { echo "build.sh: $*" >&2; exit 1; }
[ $# -ge 2 ] && [ $# -le 3 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
release=$(realpath "$1") root=$2 settings=${3:-}
here=$(realpath "$(dirname "$0")")
checkout=$(realpath "$here/../..")
out=$(realpath "${OUT:-.}")
[ -f "$release/release.json" ] || fail "$1: is not the folder of a release: it has no release.json"
[ -f "$root" ] || fail "$root: is no file: give the root.json of the repository that this device is to trust"
of_release() { python3 -I -c 'import json, sys; print(json.load(open(sys.argv[1]))[sys.argv[2]])' "$release/release.json" "$1"; }
version=$(of_release version) python=$(of_release python) machine=$(of_release architecture)
case $machine in
x86_64) architecture=amd64 ;;
aarch64) architecture=arm64 ;;
*) fail "$1: is for $machine; packages are made for x86_64 and aarch64" ;;
esac
# what comes before a version (1.0rc1, 1.0.dev3) is so for dpkg too
debian=$(printf %s "$version" | sed -E 's/\.?(a|b|rc|dev)([0-9]+)/~\1\2/g')-${REVISION:-1}
dpkg --validate-version "$debian" 2>/dev/null || fail "$1: version $version is none of a Debian package"
: "${SOURCE_DATE_EPOCH:=$(git -C "$checkout" log -1 --format=%ct)}"
export SOURCE_DATE_EPOCH
umask 022
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source=$work/haptic-panel
files=$source/files
cp -r "$here" "$source"
rm "$source/build.sh" "$source/install-first-release" "$source/update.toml"

put() { install -D -m "${3:-644}" "$1" "$files/$2"; }
for unit in "$checkout"/systemd/*.service "$checkout"/systemd/*.path "$checkout"/systemd/*.timer; do
  put "$unit" "lib/systemd/system/${unit##*/}"
done
sed -i "s/@UNITS@/$(cd "$files/lib/systemd/system" && echo *)/" "$source/debian/prerm"
for script in fall-back as-user set-touch; do put "$checkout/systemd/$script" "usr/lib/haptic-panel/$script" 755; done
put "$checkout/systemd/haptic-panel" usr/bin/haptic-panel 755
put "$here/install-first-release" usr/lib/haptic-panel/install-first-release 755
sed -i "s/@VERSION@/$version/; s/@PYTHON@/$python/" "$files/usr/lib/haptic-panel/install-first-release"
put "$checkout/systemd/udev/60-haptic-panel.rules" lib/udev/rules.d/60-haptic-panel.rules
put "$checkout/systemd/modules-load.d/haptic-panel.conf" usr/lib/modules-load.d/haptic-panel.conf
put "$checkout/systemd/haptic-panel.catalog" usr/lib/systemd/catalog/haptic-panel.catalog
put "$checkout/controller/commands/shell/haptic-panel.1" usr/share/man/man1/haptic-panel.1
sed -i "1s/\"version [^\"]*\"/\"version $version\"/; 1s/panel [0-9][^\"]*\"/panel $version\"/" "$files/usr/share/man/man1/haptic-panel.1"
put "$checkout/controller/commands/shell/haptic-panel.bash" usr/share/bash-completion/completions/haptic-panel
put "$checkout/controller/commands/shell/_haptic-panel" usr/share/zsh/vendor-completions/_haptic-panel
put "$root" usr/share/haptic-panel/root.json
put "${settings:-$here/update.toml}" etc/haptic-panel/update.toml
cp -r "$release" "$files/usr/lib/haptic-panel/first-release"
rm -rf "$files/usr/lib/haptic-panel/first-release/indexes" # for repositories
chmod -R u=rwX,go=rX "$files/usr/lib/haptic-panel/first-release"
cp "$checkout/systemd/sysusers.d/haptic-panel.conf" "$source/debian/haptic-panel.sysusers" # debhelper calls systemd-sysusers
cp "$checkout/systemd/tmpfiles.d/haptic-panel.conf" "$source/debian/haptic-panel.tmpfiles"
cp "$checkout/controller/CHANGELOG.md" "$source/CHANGELOG.md"

maker="${DEBFULLNAME:-haptic-panel authors} <${DEBEMAIL:-haptic-panel@example.org}>"
cat >"$source/debian/changelog" <<C
haptic-panel ($debian) stable; urgency=medium

  * Release $version for Python $python; see changelog.gz.

 -- $maker  $(date -u -R -d "@$SOURCE_DATE_EPOCH")
C
sed -i "s/@MAINTAINER@/$maker/" "$source/debian/control"
sed -i "s/@COPYRIGHT@/$(sed -n 's/^Copyright (c) //p' "$checkout/LICENSE")/" "$source/debian/copyright"
sed '1,/^Copyright/d; s/^$/./; s/^/ /' "$checkout/LICENSE" >>"$source/debian/copyright"
# the newest symbols of glibc that anything in the wheels asks for
libc=$(for wheel in "$release"/wheels/*.whl; do unzip -p "$wheel" '*.so*' 2>/dev/null || :; done | grep -ao 'GLIBC_2\.[0-9]*' | sort -uV | tail -n 1)
echo "python$python${libc:+, libc6 (>= ${libc#GLIBC_})}, libgcc-s1, libstdc++6, zlib1g" >"$source/depends"
cd "$source"
dpkg-buildpackage -b -nc -d -uc -us --host-arch "$architecture" >"$work/log" 2>&1 || { tail -n 15 "$work/log" >&2; exit 1; }
cp "$work"/haptic-panel_*_"$architecture".deb "$out"
echo "$out/haptic-panel_${debian}_$architecture.deb"
