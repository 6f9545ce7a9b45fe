#!/bin/sh
# Puts the figures that the bench left in results/ into README.md: the table between its two marks, and the pictures.
# `make readme` runs the bench first.
set -eu
cd "$(dirname "$0")/.."
awk '/<!-- table -->/ {print; print ""; while ((getline line < "results/table.md") > 0) print line; print ""; skip = 1}
     /<!-- \/table -->/ {skip = 0}
     !skip && !/<!-- table -->/' README.md >README.md.part
mv README.md.part README.md
cp results/line/line.png bench/pictures/line.png
cp results/line/torque.png bench/pictures/line-torque.png
