#!/bin/sh
# Puts the figures that the bench left in results/ into README.md: the table between its two marks, and the pictures;
# and the answers of the experiments into bench/experiments/README.md.
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
build/release/bench/seam render results/carrying --compare dmp2,dmp3 --inset --size 880x440 --from 0.6 --to 2 --speed 0.25 --fps 15 \
  -o bench/pictures/carrying.webp
cp results/line/torque.png bench/pictures/line-torque.png
cp results/carrying/wave_m.png bench/pictures/carrying-wave.png

build/release/bench/seam experiment --out results/experiments
answers=bench/experiments/README.md
sed '/<!-- answers -->/q' $answers >$answers.part
for question in speed joining-velocity kernel-width goal-change lag tick spilling; do
  echo && cat results/experiments/$question.md
  cp results/experiments/$question.png bench/experiments/
done >>$answers.part
mv $answers.part $answers
