#!/bin/sh
# Usage: install-packages.sh LOG PACKAGE...
# Installs those of the Debian packages that are missing, as root or through sudo; nothing is removed for them.
# Exit 2, with one line on stderr, where that fails; what apt said is then in LOG.
set -eu
log=$1
shift

missing=
for package; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

fail() {
  echo "seam: missing packages: $1; as root, connected to the network, run:" \
    "apt-get update && apt-get install --no-install-recommends$missing" >&2
  exit 2
}

as_root() {
  if [ "$(id -u)" = 0 ]; then env "$@"; else sudo env "$@"; fi
}

command -v apt-get >/dev/null || fail "this is not Debian, find their like"
[ "$(id -u)" = 0 ] || command -v sudo >/dev/null || fail "neither root nor sudo"

echo "seam: installing$missing"
mkdir -p "$(dirname "$log")"
if ! {
  as_root LC_ALL=C apt-get -q update &&
    as_root LC_ALL=C DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y --no-install-recommends --no-remove install $missing
} >"$log" 2>&1; then
  reason=$(grep -E '^[EW]: .*(resolv|connect|timed out|lock)|^sudo: ' "$log" | head -n 1)
  [ -n "$reason" ] || reason=$(grep '^E: ' "$log" | head -n 1)
  [ -n "$reason" ] || reason="apt-get failed"
  fail "${reason#[EW]: } (log: $log)"
fi
rm -f "$log"
