#!/usr/bin/env bash
# Usage: refused.sh PREFIX FOLDER
# Builds every way of mixing Bullet's precisions; each must fail, and say so.
set -u
mixed=$(cd "$(dirname "$0")/mixed" && pwd)
prefix=$1 folder=$2
export LC_ALL=C
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$(echo "$prefix"/lib/*/pkgconfig)
libraries=$(pkg-config --variable=libdir seam-core)
failed=0

refused() { # CASE TEXT COMMAND...
  local name=$1 text=$2 log=$folder/$1.log
  shift 2
  if "$@" >"$log" 2>&1; then
    echo "$name: is built, must be refused"
    failed=1
  elif ! tr -s ' \n' ' ' <"$log" | grep -q -e "$text"; then
    echo "$name: fails without saying \"$text\":"
    tail -n 20 "$log"
    failed=1
  else
    echo "$name: refused"
  fi
}

project() { # CASE
  rm -rf "${folder:?}/$1"
  cmake -G Ninja -S "$mixed" -B "$folder/$1" -DCASE="$1" -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$folder/$1"
}

# By CMake.
float_refused='TLS reference in .* mismatches non-TLS [a-z]* in [^ ]*/lib[A-Za-z]*\.so'
double_refused='TLS reference in .* mismatches non-TLS [a-z]* in [^ ]*/lib[A-Za-z]*-float64\.so'
mkdir -p "$folder"
refused both BULLET_PRECISION project both
refused definition 'seam::bullet-float32 does not go with BT_USE_DOUBLE_PRECISION' project definition
refused undefined 'seam::bullet needs BT_USE_DOUBLE_PRECISION' project undefined
refused double_with_float 'links seam in one precision and Bullet in the other' project double_with_float
refused float_with_double 'links seam in one precision and Bullet in the other' project float_with_double
refused float_by_target "$float_refused" project float_by_target
refused double_by_target "$double_refused" project double_by_target
refused arm_double_with_float 'links seam in one precision and Bullet in the other' project arm_double_with_float
refused arm_and_bullet BULLET_PRECISION project arm_and_bullet
refused float_by_library 'TLS reference in .* mismatches non-TLS reference in [^ ]*libmine\.so' project float_by_library

# By pkg-config and by hand, wherever the library stands.
for precision in bullet bullet-float32; do
  g++ -std=c++17 -c "$mixed/mixed.cpp" -o "$folder/$precision.o" $(pkg-config --cflags "seam-$precision") || failed=1
done
double=$folder/bullet.o float=$folder/bullet-float32.o
link() { g++ -o "$folder/mixed" "$@"; }
refused float_as_double 'undefined reference to .seam::this_needs_seam_arm_float32' link "$float" -L"$libraries" -lseam-bullet -lseam-arm -lseam-core
refused after "$float_refused" link "$double" $(pkg-config --libs seam-bullet bullet)
refused before "$float_refused" link "$double" $(pkg-config --libs bullet seam-bullet)
refused double_after "$double_refused" link "$float" $(pkg-config --libs seam-bullet-float32 bullet-float64)
refused double_before "$double_refused" link "$float" $(pkg-config --libs bullet-float64 seam-bullet-float32)
for library in LinearMath BulletCollision BulletDynamics; do
  refused "$library" "$float_refused" link "$double" -L"$libraries" -lseam-bullet -lseam-arm -lseam-core "-l$library"
  refused "$library-float64" "$double_refused" link "$float" "-l$library-float64" -L"$libraries" -lseam-bullet-float32 -lseam-arm-float32 -lseam-core
done
for precision in bullet bullet-float32; do
  link "$folder/$precision.o" $(pkg-config --libs "seam-$precision") || failed=1
done
exit $failed
