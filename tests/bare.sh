#!/usr/bin/env bash
# tests/bare.sh SUITE [FOLDER]: what a stranger does on a new machine. Makes a bare Debian SUITE (bookworm, trixie) in FOLDER (default
# /var/tmp/seam-SUITE, which must not be there yet), clones the last commit, and runs `make bench` and `make test`; then packs it, and
# installs the packages in a second bare system, FOLDER.installed, and uses the program and the module there from empty folders. By hand, as root,
# with debootstrap; takes half an hour and 10 GB. What is printed also goes to FOLDER.log; the folders stay, to look at. CI=true in
# the environment makes warnings errors.
set -euo pipefail
suite=${1:?usage: tests/bare.sh SUITE [FOLDER]}
folder=${2:-/var/tmp/seam-$suite}
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
fail() { echo "bare.sh: $1" >&2; exit 2; }
[[ ! -e $folder && ! -e $folder.installed ]] || fail "$folder or $folder.installed is there already, remove it"
[[ $(id -u) = 0 ]] || fail "must be run as root"
command -v debootstrap >/dev/null || fail "debootstrap is missing (Debian: debootstrap)"
exec &> >(tee "$folder.log")

# inside FOLDER COMMAND: what is mounted for the command goes with it.
inside() {
  unshare --mount sh -ec 'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; mount -t sysfs sysfs "$0/sys"
    cd "$0"; exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive CI="$2" chroot . sh -ec "$1"' \
    "$1" "$2" "${CI-}" </dev/null
}

bare() { # FOLDER
  debootstrap --variant=minbase "$suite" "$1" >"$1.debootstrap" || fail "debootstrap failed, see $1.debootstrap"
}

timed() { # WHAT COMMAND…
  local begin=$SECONDS what=$1
  shift
  "$@"
  echo "bare.sh: $suite: $what passed in $(((SECONDS - begin) / 60)) min $(((SECONDS - begin) % 60)) s"
}

echo "bare.sh: $suite, commit $(git -C "$checkout" rev-parse --short HEAD)"
bare "$folder"
inside "$folder" 'apt-get -q update && apt-get -q -y --no-install-recommends install make git ca-certificates' >"$folder.apt" 2>&1
git clone -q --no-hardlinks "$checkout" "$folder/root/checkout"
timed 'make bench' inside "$folder" 'cd /root/checkout && make bench'
timed 'make test' inside "$folder" 'cd /root/checkout && make test'
timed 'packing' inside "$folder" 'cd /root/checkout && cmake --preset package && cmake --build --preset package && cpack --preset package'

bare "$folder.installed"
cp "$folder"/root/checkout/build/package/packages/*.deb "$folder.installed/tmp"
timed 'apt install' inside "$folder.installed" 'apt-get -q update && apt-get -q -y install /tmp/*.deb' >>"$folder.apt" 2>&1
timed 'the installed program' inside "$folder.installed" 'mkdir /root/empty && cd /root/empty
  seam bench --check bench/baselines
  seam run line --method dmp3 --out one
  seam render results/wiping/dmp3 -o wiping.mp4
  seam render results/carrying --compare dmp2,dmp3 --camera close-up --speed 0.25 -o spill.webm
  seam render one/line/dmp3 -o line.png --device software
  seam report results -o report.html
  seam sweep carrying --vary sequence.steps.0.until.before_end=0.05:1.15:3 --out joins.csv
  seam check assets/pa10/pa10.urdf
  seam experiment speed --values 0.5,1 --out answers
  ls -l . /usr/share/man/man1/seam*'
timed 'the installed module' inside "$folder.installed" 'mkdir /root/another && cd /root/another && python3 -c "
import seam
run = seam.play(\"line\", method=\"dmp3\")
print(seam.__version__, seam.scenes(), run.ticks, seam.measure(run).torque_jump_nm)"'
