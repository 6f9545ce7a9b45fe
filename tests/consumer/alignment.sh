#!/usr/bin/env bash
# Usage: alignment.sh PREFIX FOLDER
# Compiles apps with flags that lay out Eigen's types otherwise than the installed seam does: the linker must refuse them
# and say what they need; with the remedies of seam/alignment.hpp they must run.
set -u
core=$(cd "$(dirname "$0")/core" && pwd)/core.cpp
prefix=$1 folder=$2
export LC_ALL=C
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$(echo "$prefix"/lib/*/pkgconfig)
export LD_LIBRARY_PATH=$(pkg-config --variable=libdir seam-core)
mkdir -p "$folder"
cd "$folder" || exit 1
echo '#include <seam/join.hpp>
int main() {}' >small.cpp
failed=0

app() { g++ -std=c++17 "$@" -o app $(pkg-config --cflags --libs seam-core) 2>log; }
complain() {
  echo "$1"
  tail -n 20 log
  failed=1
}
refused() { # NEED FLAGS...
  local need="undefined reference to .seam::this_needs_seam_built_with_EIGEN_$1"
  shift
  if app small.cpp "$@"; then
    complain "$*: is linked, must be refused"
  else
    grep -q "$need" log || complain "$*: fails without saying \"$need\""
  fi
}
runs() { # FLAGS...
  app "$core" "$@" && ./app >>log 2>&1 || complain "$*: must run"
}

refused '.*_MALLOC_ALREADY_ALIGNED_0' -fsanitize=address
runs -fsanitize=address -DEIGEN_MALLOC_ALREADY_ALIGNED=1
if grep -qw avx /proc/cpuinfo; then
  refused MAX_ALIGN_BYTES_32 -mavx
  refused MAX_ALIGN_BYTES_64 -mavx512f -mfma
  refused 'MAX_ALIGN_BYTES_16_.*_MALLOC_ALREADY_ALIGNED_0' -mavx -DEIGEN_MAX_ALIGN_BYTES=16
  runs -mavx -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MAX_STATIC_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1 -DEIGEN_DONT_VECTORIZE
fi
exit $failed
