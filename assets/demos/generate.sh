#!/bin/sh
# Generates the demonstrations of a person's motions and two minimum-jerk movements: ./generate.sh [FOLDER], its own folder if none
# is given. The same bytes every time, by any awk.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
for motion in reach pour wipe carry_lift carry_place wipe_approach wipe_away catch follow aim thread; do
  LC_ALL=C awk -v motion=$motion -f "$here/generate.awk" > "${1:-$here}/$motion.csv"
done
minimum_jerk() {  # from, to
  LC_ALL=C awk -v from="$1" -v way="$2" 'BEGIN {
    print "time,E1,vel.E1,acc.E1"
    for (i = 0; i <= 200; i++) {
      s = i / 200
      printf "%.3f,%.12f,%.12f,%.12f\n", s, from + way * s^3 * (10 + s * (6 * s - 15)), way * 30 * s^2 * (1 - s)^2,
        way * 60 * s * (1 - s) * (1 - 2 * s)
    }
  }'
}
minimum_jerk 1 -1 > "${1:-$here}/minimum_jerk.csv"
minimum_jerk 0.5 -1 > "${1:-$here}/minimum_jerk_on.csv"
