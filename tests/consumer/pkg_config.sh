#!/usr/bin/env bash
# Usage: pkg_config.sh SEAM PREFIX FOLDER
# Compiles and runs programs with what pkg-config says.
set -euo pipefail
seam=$1 prefix=$2 folder=$3
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$(echo "$prefix"/lib/*/pkgconfig)
export LD_LIBRARY_PATH=$(pkg-config --variable=libdir seam-core)
mkdir -p "$folder"
cd "$folder"

for precision in bullet bullet-float32; do
  g++ -std=c++17 "$seam/plugin/examples/02_own_robot.cpp" -o "$precision" $(pkg-config --cflags --libs "seam-$precision")
  "./$precision" "$seam/assets/pa10/pa10.urdf"
  "./$precision" "$seam/tests/data/lift_arm.urdf"
done
for arm in arm arm-float32; do
  g++ -std=c++17 "$seam/plugin/examples/08_without_a_world.cpp" -o "$arm" $(pkg-config --cflags --libs "seam-$arm")
done
./arm "$seam/assets/pa10/pa10.urdf"
bash "$seam/tests/consumer/no_world.sh" ./arm ./arm-float32
g++ -std=c++17 "$seam/tests/consumer/core/core.cpp" -o core $(pkg-config --cflags --libs seam-core)
./core
g++ -std=c++17 "$seam/plugin/examples/03_own_demonstration.cpp" -o files $(pkg-config --cflags --libs seam-files)
./files "$seam/assets/demos/ramp_up.csv" primitive.yaml
