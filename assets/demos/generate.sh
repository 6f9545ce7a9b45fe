#!/bin/sh
# Generates the demonstrations of four kitchen motions: ./generate.sh [FOLDER], its own folder if none
# is given. The same bytes every time, by any awk.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
for motion in reach pour wipe carry_lift carry_place wipe_approach wipe_away; do
  LC_ALL=C awk -v motion=$motion -f "$here/generate.awk" > "${1:-$here}/$motion.csv"
done
