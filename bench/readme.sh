#!/bin/sh
# Puts what the bench left in results/ and `make micro` in build/ between the marks <!-- NAME --> and <!-- /NAME --> of the
# pages that show it; makes the pictures; asks the experiments and puts their answers there too. `make readme` runs both first.
set -eu
cd "$(dirname "$0")/.."
put() {  # put MARK TEXT PAGE
  awk -v mark="$1" -v text="$2" '
    $0 == "<!-- /" mark " -->" {skip = 0}
    !skip {print}
    $0 == "<!-- " mark " -->" {print ""; while ((getline line < text) > 0) print line; print ""; skip = 1}' "$3" >"$3.part"
  mv "$3.part" "$3"
}
put table results/overview.md README.md
awk -f bench/joins.awk $(ls bench/baselines/*.json | grep -v -e -published) >results/joins.md
put joins results/joins.md plugin/guide/2-choosing-a-join.md
put micro build/micro.md bench/README.md
for scene in line pouring wiping carrying catching through obstacle; do
  cp results/$scene/$scene.png bench/pictures/$scene.png
done
build/release/bench/seam render results/carrying --compare dmp2,dmp3 --inset --size 880x440 --from 0.6 --to 2 --speed 0.25 --fps 15 \
  -o bench/pictures/carrying.webp
cp results/line/torque.png bench/pictures/line-torque.png
cp results/carrying/wave_m.png bench/pictures/carrying-wave.png

for example in 05_four_methods 06_wishes; do
  (cd plugin/python/examples && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=../../../build/release/python /usr/bin/python3 $example.py >/dev/null)
done

build/release/bench/seam experiment --out results/experiments
for question in speed joining-velocity kernel-width goal-change lag tick spilling what-rings rate-limit known-friction; do
  [ $question = speed ] || echo
  cat results/experiments/$question.md
  cp results/experiments/$question.png bench/experiments/
done >results/experiments/answers.md
put answers results/experiments/answers.md bench/experiments/README.md
