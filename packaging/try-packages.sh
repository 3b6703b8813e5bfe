#!/usr/bin/env bash
# Proves the Debian packages (packaging/make-packages.sh) in a clean Debian 12, a root of its own:
# installs them, makes the sample's picture with the installed tools, builds and runs programs over the
# static and the shared library, and removes them all; nothing may be left behind. Needs root, debootstrap and
# the mirror that apt of this machine is configured with. Prints a line for every step.
#   packaging/try-packages.sh [FOLDER]    of the packages (default: build/packages/packages)
#   TMPDIR                                where the root is made, about 3 GB (default /var/tmp)
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
packages=$(realpath "${1:-$here/../build/packages/packages}")
compgen -G "$packages/*.deb" >/dev/null || { echo "no packages in $packages" >&2; exit 3; }
[ "$(id -u)" = 0 ] || { echo "has to be run as root: it makes a root of its own" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "debootstrap is missing (Debian: debootstrap)" >&2; exit 2; }
root=$(mktemp -d "${TMPDIR:-/var/tmp}/hiac-root.XXXXXX")
log=$root.log

end() {
  status=$?
  # only what nothing is mounted in is removed
  for folder in dev proc; do
    ! mountpoint -q "$root/$folder" || umount "$root/$folder" || exit 1
  done
  rm -rf --one-file-system "$root"
  if [ "$status" = 0 ]; then rm -f "$log"; else tail -n 30 "$log" >&2; echo "log: $log" >&2; fi
  exit "$status"
}
trap end EXIT

step() {
  echo "$1"
  shift
  "$@" >>"$log" 2>&1
}
inside() {
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 HOME=/root \
    DEBIAN_FRONTEND=noninteractive "$@"
}

make_root() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' |
           head -n 1)
  debootstrap --variant=minbase bookworm "$root" "$mirror"
  rm -rf "$root"/etc/apt/sources.list "$root"/etc/apt/sources.list.d
  cp -r /etc/apt/sources.list.d "$root/etc/apt/"
  [ ! -e /etc/apt/sources.list ] || cp /etc/apt/sources.list "$root/etc/apt/"
  cp -r /usr/share/keyrings/. "$root/usr/share/keyrings/"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  inside apt-get update -q
  # no page of a manual is left out, as in images of containers
  rm -f "$root"/etc/dpkg/dpkg.cfg.d/*docker* "$root"/etc/dpkg/dpkg.cfg.d/*exclude*
}

names() { for file in "$packages"/*.deb; do dpkg-deb --field "$file" Package; done; }
install_packages() {
  mkdir "$root/packages"
  cp "$packages"/*.deb "$root/packages/"
  inside sh -c 'apt-get install -q -y --no-install-recommends /packages/*.deb'
  rm -r "$root/packages"
}
install_needs() {
  local needs
  mapfile -t needs < <(for file in "$packages"/*.deb; do
    dpkg-deb --field "$file" Depends; done | tr ',' '\n' | sed 's/^ *//; s/[ (].*//' | sort -u |
    grep -v -x -F -f <(names))
  inside apt-get install -q -y --no-install-recommends "${needs[@]}" g++ cmake ninja-build
}
# Everything in the root but what apt and dpkg keep of any package that was ever installed, and caches.
files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./tmp -o -path ./var/log \
    -o -path ./var/cache -o -path ./var/lib/apt -o -path ./var/lib/dpkg -o -path ./root \) -prune -o -print |
    sort)
}

step "making a clean Debian 12" make_root
step "installing what the packages need" install_needs
files >"$log.before"
step "installing $(names | tr '\n' ' ')" install_packages
cp "$here/try-installed.sh" "$root/tmp/"
step "using them" inside sh /tmp/try-installed.sh
step "removing them" inside apt-get purge -q -y $(names)
files >"$log.after"
diff "$log.before" "$log.after" >>"$log" || { echo "removal leaves files behind" >&2; exit 1; }
rm -f "$log.before" "$log.after"
echo "installed, used and removed: nothing is left behind"
