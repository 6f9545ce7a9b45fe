#!/bin/sh
# Usage: links.sh PAGE...
# Run in seam's top folder: every relative link of a page leads to a file, and the reference lists every public header.
set -eu
{
  for page; do
    grep -o ']([^) ]*)' "$page" | sed 's/^](//; s/[)#].*//' | while read -r link; do
      case $link in '' | http*) continue ;; esac
      [ -e "$(dirname "$page")/$link" ] || echo "$page: leads to $link, which is not there"
    done
  done
  for header in plugin/*/include/seam/*.hpp; do
    grep -q "(../${header#plugin/})" plugin/guide/reference.md || echo "plugin/guide/reference.md: lacks $header"
  done
} | { ! grep .; }
