#!/bin/sh
# Run in seam's top folder: the guide's table of joins is that of the baselines, over all scenes on the ideal arm.
set -eu
page=plugin/guide/2-choosing-a-join.md
table=$(awk -f bench/joins.awk $(ls bench/baselines/*.json | grep -v -e -published))
[ -n "$table" ] && [ "$table" = "$(sed -n '/^<!-- joins -->$/,/^<!-- \/joins -->$/p' $page | grep '^|')" ] || {
  echo "$page: its table is not what bench/joins.awk makes of the baselines, must be renewed by make readme"
  exit 1
}
