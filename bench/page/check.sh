#!/bin/sh
# Usage: check.sh [FOLDER]
# Whether template.html belongs to the sources beside it, by their sum that it carries; with a folder, whether building it
# anew there gives the same bytes. Exit 77 where that cannot be tried: no npm here, or its registry cannot be reached.
set -eu
export LC_ALL=C
cd "$(dirname "$0")"
anew="run: make page"

if [ $# = 0 ]; then
  sum=$(cat build.mjs package-lock.json src/* | sha256sum | cut -d ' ' -f 1)
  grep -q "sources $sum" template.html || { echo "template.html was built from other sources, $anew"; exit 1; }
  exit 0
fi

command -v npm >/dev/null || { echo "SKIPPED: there is no npm, the template is not built anew"; exit 77; }
rm -rf "$1"
mkdir -p "$1"
cp -r .npmrc build.mjs package.json package-lock.json src "$1"
if ! npm --prefix "$1" ci --no-audit --no-fund >"$1/npm.log" 2>&1; then
  cat "$1/npm.log"
  grep -qE 'E(NOTFOUND|AI_AGAIN|CONNREFUSED|CONNRESET|TIMEDOUT)' "$1/npm.log" || exit 1
  echo "SKIPPED: npm's registry cannot be reached, the template is not built anew"
  exit 77
fi
node "$1/build.mjs" "$1/template.html"
cmp template.html "$1/template.html" || { echo "$anew"; exit 1; }
