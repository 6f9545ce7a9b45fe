#!/bin/sh
# Usage: bullet-headers.sh DIR
# Bullet's inverse-dynamics libraries are packaged without their headers. This puts the headers that belong to the
# installed Bullet into DIR, laid out as Bullet installs its others (BulletInverseDynamics/, InverseDynamics/): from
# the source tree that $BULLET_SOURCE_DIR names, else from Debian's source package of the installed version, with
# apt sources and lists of its own. DIR appears whole or not at all; DIR/made-from says what it was made from (a
# file called version would hide C++20's <version>), and nothing is done where that is still right. Exit 2, with one
# line on stderr, where the headers cannot be had.
set -eu
export LC_ALL=C

fail() {
  echo "bullet-headers: $1" >&2
  exit 2
}

dir=$1
include=$(pkg-config --variable=includedir bullet 2>/dev/null) ||
  fail "pkg-config finds no Bullet: install pkg-config, libbullet-dev and libbullet-extras-dev"
installed=$(pkg-config --modversion bullet)
source=${BULLET_SOURCE_DIR:-}
headers=src/BulletInverseDynamics/MultiBodyTree.hpp

if [ -n "$source" ]; then
  [ -f "$source/$headers" ] ||
    fail "BULLET_SOURCE_DIR: no $headers in \"$source\", must be the top folder of Bullet's source"
  found=$(cat "$source/VERSION" 2>/dev/null) || found="an unknown version"
  [ "$found" = "$installed" ] ||
    fail "BULLET_SOURCE_DIR: \"$source\" is Bullet $found, must be $installed as installed"
  version="$installed from $source"
elif [ -f "$include/BulletInverseDynamics/MultiBodyTree.hpp" ]; then
  exit 0
else
  version=$(dpkg-query -W -f '${source:Version}\n' libbullet-dev 2>/dev/null | head -n 1)
  [ -n "$version" ] ||
    fail "the installed Bullet lacks its inverse-dynamics headers: set BULLET_SOURCE_DIR to its source"
fi
[ ! -f "$dir/version" ] || mv "$dir/version" "$dir/made-from" # its name in folders made before
have=$(cat "$dir/made-from" 2>/dev/null) || have=
case $have in
  "$version") exit 0 ;;
  "$installed from "*) [ -n "$source" ] || exit 0 ;;
esac

mkdir -p "$(dirname "$dir")"
work=$(mktemp -d "$dir.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
work=$(cd "$work" && pwd)

download() {
  mkdir -p sources lists/partial cache/archives/partial
  list= parts=
  eval "$(apt-config shell list Dir::Etc::sourcelist/f parts Dir::Etc::sourceparts/d)"
  for file in "$list" "$parts"/*.list; do
    [ ! -f "$file" ] || sed -nE '/cdrom:/d; s/^[[:space:]]*deb(-src)?([[:space:]])/deb-src\2/p' "$file"
  done | sort -u >sources/debian.list
  for file in "$parts"/*.sources; do
    [ ! -f "$file" ] || sed -E 's/^Types:.*/Types: deb-src/I' "$file" >"sources/$(basename "$file")"
  done
  cat >apt.conf <<END
#clear APT::Update;
Dir::Etc::sourcelist "/dev/null";
Dir::Etc::sourceparts "$work/sources";
Dir::State::lists "$work/lists";
Dir::Cache "$work/cache";
END
  apt-get -c apt.conf -q update
  apt-get -c apt.conf -q source --download-only --tar-only "bullet=$version"
}

if [ -z "$source" ]; then
  echo "bullet-headers: downloading Debian's source of Bullet $version"
  if ! (cd "$work" && download) >"$dir.log" 2>&1; then
    reason=$(grep -E '^[EW]: .*(resolv|connect|timed out|[Nn]ot found|404|403|NO_PUBKEY|not signed)' "$dir.log" |
      head -n 1)
    [ -n "$reason" ] || reason=$(grep '^E: ' "$dir.log" | tail -n 1)
    fail "no download of Debian's source of Bullet $version (${reason#[EW]: }): \
connect to the network and repeat, or set BULLET_SOURCE_DIR to that source; log: $dir.log"
  fi
  mkdir "$work/unpacked"
  tar -xf "$work"/bullet_*.orig.tar.* -C "$work/unpacked" --strip-components=1 --wildcards \
    '*/src/BulletInverseDynamics/*.hpp' '*/Extras/InverseDynamics/*.hpp' 2>>"$dir.log" ||
    fail "Debian's source of Bullet $version does not unpack; log: $dir.log"
  source=$work/unpacked
fi

new=$work/new
mkdir -p "$new/BulletInverseDynamics/details" "$new/InverseDynamics"
cp "$source"/src/BulletInverseDynamics/*.hpp "$new/BulletInverseDynamics"
cp "$source"/src/BulletInverseDynamics/details/*.hpp "$new/BulletInverseDynamics/details"
cp "$source"/Extras/InverseDynamics/*.hpp "$new/InverseDynamics"
ln -s "$include/LinearMath" "$new/LinearMath" # details/*.hpp include it as ../../LinearMath
echo "$version" >"$new/made-from"
chmod -R u+w,go+rX "$new"
rm -rf "$dir"
mv -T "$new" "$dir"
rm -f "$dir.log"
