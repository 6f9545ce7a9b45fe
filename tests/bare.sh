#!/usr/bin/env bash
# tests/bare.sh SUITE [FOLDER]: what a stranger does on a new machine. Makes a bare Debian SUITE (bookworm, trixie) in
# FOLDER (default /var/tmp/seam-SUITE, which must not be there yet), clones the last commit into its /seam, and runs `make
# bench` and `make test` in it. By hand, as root, with debootstrap; takes half an hour and 10 GB. What is printed also goes to
# FOLDER.log; FOLDER stays, to look at. CI=true in the environment makes warnings errors.
set -euo pipefail
suite=${1:?usage: tests/bare.sh SUITE [FOLDER]}
folder=${2:-/var/tmp/seam-$suite}
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
fail() { echo "bare.sh: $1" >&2; exit 2; }
[[ ! -e $folder ]] || fail "$folder: is there already, remove it"
[[ $(id -u) = 0 ]] || fail "must be run as root"
command -v debootstrap >/dev/null || fail "debootstrap is missing (Debian: debootstrap)"
exec &> >(tee "$folder.log")

# What is mounted for the command goes with it.
inside() {
  unshare --mount sh -ec 'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; mount -t sysfs sysfs "$0/sys"
    cd "$0"; exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 CI="$2" chroot . sh -ec "$1"' \
    "$folder" "$1" "${CI-}" </dev/null
}

debootstrap --variant=minbase "$suite" "$folder" >"$folder.debootstrap" || fail "debootstrap failed, see $folder.debootstrap"
inside 'apt-get -q update && apt-get -q -y --no-install-recommends install make git ca-certificates' >"$folder.apt"
git clone -q --no-hardlinks "$checkout" "$folder/seam"
echo "bare.sh: $suite, commit $(git -C "$checkout" rev-parse --short HEAD)"
for target in bench test; do
  SECONDS=0
  inside "cd /seam && make $target"
  echo "bare.sh: $suite: make $target passed in $((SECONDS / 60)) min $((SECONDS % 60)) s"
done
