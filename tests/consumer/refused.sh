#!/usr/bin/env bash
# Usage: refused.sh SEAM PREFIX FOLDER
# Configures and builds every way of mixing Bullet's precisions; each must fail, and say so.
set -u
seam=$1 prefix=$2 folder=$3
failed=0

refused() { # CASE TEXT
  rm -rf "$folder/$1"
  if { cmake -G Ninja -S "$seam/tests/consumer/mixed" -B "$folder/$1" -DCASE="$1" -DSEAM="$seam" \
    -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$folder/$1"; } >"$folder/$1.log" 2>&1; then
    echo "$1: is built, must be refused"
    failed=1
  elif ! tr -s ' \n' ' ' <"$folder/$1.log" | grep -q -e "$2"; then
    echo "$1: fails without saying \"$2\":"
    tail -n 20 "$folder/$1.log"
    failed=1
  else
    echo "$1: refused"
  fi
}

mkdir -p "$folder"
refused both 'BULLET_PRECISION'
refused definition 'seam::bullet-float32 does not go with BT_USE_DOUBLE_PRECISION'
refused undefined 'seam::bullet needs BT_USE_DOUBLE_PRECISION'
refused double_with_float 'links seam in one precision and Bullet in the other'
refused float_with_double 'links seam in one precision and Bullet in the other'
refused link 'undefined reference to .seam::this_needs_seam_bullet_float32'

# By pkg-config, where neither compiler nor linker sees it: refused before anything moves.
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$(echo "$prefix"/lib/*/pkgconfig)
libraries=$(pkg-config --variable=libdir seam-core)
if ! g++ -std=c++17 "$seam/plugin/examples/02_own_robot.cpp" -o "$folder/loaded" -Wl,--no-as-needed \
  $(pkg-config --cflags seam-bullet) $(pkg-config --libs seam-bullet bullet); then
  failed=1
elif ! LD_LIBRARY_PATH=$libraries "$folder/loaded" "$seam/tests/data/lift_arm.urdf" 2>&1 |
  grep -q 'its float and its -float64 libraries are both in this program'; then
  echo "loaded: both of Bullet's libraries are loaded, and nobody says so"
  failed=1
fi
exit $failed
