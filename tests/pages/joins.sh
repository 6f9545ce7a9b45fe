#!/bin/sh
# Run in seam's top folder: the guide's table of joins is that of the README, over all scenes.
set -eu
page=plugin/guide/2-choosing-a-join.md
[ -n "$(awk -f bench/joins.awk README.md)" ] && [ "$(awk -f bench/joins.awk README.md)" = "$(sed -n '/^<!-- joins -->$/,/^<!-- \/joins -->$/p' $page | grep '^|')" ] || {
  echo "$page: its table is not what bench/joins.awk makes of README.md's, must be renewed by make readme"
  exit 1
}
