#!/bin/sh
# Puts the figures that the bench left in results/ into README.md: the table between its two marks, and the pictures;
# and the answers of the experiments into bench/experiments/README.md,
# and what `make micro` left in build/ into bench/README.md.
# `make readme` runs both first.
set -eu
cd "$(dirname "$0")/.."
put() {  # put MARK TABLE FILE
  awk -v mark="$1" -v table="$2" '
    $0 == "<!-- /" mark " -->" {skip = 0}
    !skip {print}
    $0 == "<!-- " mark " -->" {print ""; while ((getline line < table) > 0) print line; print ""; skip = 1}' "$3" >"$3.part"
  mv "$3.part" "$3"
}
put table results/overview.md README.md
put micro build/micro.md bench/README.md
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
