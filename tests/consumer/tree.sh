#!/usr/bin/env bash
# Usage: tree.sh PACKAGES PREFIX BUILD...
# Unpacks the Debian packages, so that PREFIX is what they install; looks at what is in them.
set -euo pipefail
packages=$1 prefix=$2
shift 2
failed=0
complain() {
  echo "$1"
  failed=1
}

rm -rf "$prefix"
mkdir -p "$prefix.new"
for package in "$packages"/*.deb; do dpkg-deb -x "$package" "$prefix.new"; done
mv "$prefix.new/usr" "$prefix"
rm -rf "$prefix.new"

depends=$(dpkg-deb -f "$packages"/libseam0_*.deb Depends)
for library in libbullet libbullet-extras liburdfdom-model libassimp libyaml-cpp libc; do
  [[ $depends =~ (^|[ ])$library[0-9] ]] || complain "libseam0 does not depend on $library: $depends"
done
[[ $(dpkg-deb -f "$packages"/libseam-dev_*.deb Depends) == *"libseam0 (= "* ]] || complain "libseam-dev takes any libseam0"
depends=$(dpkg-deb -f "$packages"/python3-seam_*.deb Depends)
for wanted in 'python3 (>= 3.' 'python3 (<< 3.' python3-numpy 'seam (= ' libbullet libassimp; do
  [[ ", $depends" == *", $wanted"* ]] || complain "python3-seam does not depend on $wanted: $depends"
done

libraries=$(dirname "$(find "$prefix" -name libseam-core.so)")
for folder in "$@"; do
  named=$(grep -rlE "(^|[^A-Za-z0-9_./-])$folder(/|\$)" "$prefix" || true)
  [ -z "$named" ] || complain "names $folder: $named"
done
readelf -d "$libraries/libseam-core.so" | grep -qi bullet && complain "libseam-core needs Bullet"
for library in "$libraries"/libseam-arm*.so; do
  readelf -d "$library" | grep -q 'NEEDED.*\(BulletDynamics\|BulletCollision\|assimp\)' && complain "$library needs a world or meshes"
done
for library in "$libraries"/libseam-*.so; do
  readelf -d "$library" | grep -q "soname: \[$(basename "$library").0\]" || complain "$library: its soname is not .so.0"
  shown=$(nm -DC --defined-only "$library" | grep ' T ' | grep -v ' T \(seam::\|_init\|_fini\)' || true)
  [ -z "$shown" ] || complain "$library: shows more than seam's own: $shown"
done
nm -DC --defined-only "$libraries/libseam-files.so" | grep -q 'YamlEntry' &&
  complain "libseam-files shows what no header declares"

headers=$(grep -rl 'BulletInverseDynamics/\|btMultiBody.h\|urdf_model/\|assimp/\|yaml-cpp/' "$prefix/include" || true)
[ -z "$headers" ] || complain "headers that need what users have not: $headers"
unguarded=$(grep -rl '<Eigen/' "$prefix/include" | xargs grep -L 'seam/alignment.hpp\|SEAM_EIGEN_BUILD')
[ -z "$unguarded" ] || complain "hand Eigen's types over, must include seam/alignment.hpp: $unguarded"
hidden=$(grep -rl '^namespace seam' "$prefix/include" || true)
[ -z "$hidden" ] || complain "declare what the libraries hide, must say namespace SEAM_API seam: $hidden"
exit $failed
