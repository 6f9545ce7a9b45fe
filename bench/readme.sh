#!/bin/sh
# Puts the figures that the bench left in results/ into README.md: the table between its two marks, and the pictures.
# `make readme` runs the bench first.
set -eu
cd "$(dirname "$0")/.."
awk '/<!-- table -->/ {print; print ""; while ((getline line < "results/overview.md") > 0) print line; print ""; skip = 1}
     /<!-- \/table -->/ {skip = 0}
     !skip && !/<!-- table -->/' README.md >README.md.part
mv README.md.part README.md
for scene in line pouring wiping carrying catching; do
  cp results/$scene/$scene.png bench/pictures/$scene.png
done
cp results/line/torque.png bench/pictures/line-torque.png
cp results/carrying/wave_m.png bench/pictures/carrying-wave.png
