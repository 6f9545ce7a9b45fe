#!/bin/sh
# Usage: reference.sh FOLDER
# Makes the reference and the guide, FOLDER/html/index.html. Exit 1 where anything is not documented, or a page's link
# leads nowhere; 77, with one line, where Doxygen is missing.
set -eu
out=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$(dirname "$0")/../.."
command -v doxygen >/dev/null || {
  echo "Doxygen is not installed" >&2
  exit 77
}
rm -rf "$out/html"
SEAM_DOCS=$out SEAM_VERSION=$(sed -n 's/^project(seam VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt) doxygen plugin/guide/Doxyfile
