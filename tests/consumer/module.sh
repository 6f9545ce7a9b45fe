#!/usr/bin/env bash
# Usage: module.sh PYTHON PREFIX BUILT FOLDER
# The module as it is installed, moved into FOLDER and used from an empty folder: beside the program, and alone, laid out as in
# a wheel. BUILT is the module in the build tree.
set -uo pipefail
python=$1 prefix=$2 built=$3 folder=$4
failed=0
complain() {
  echo "$1"
  failed=1
}

module=$prefix/lib/python3/dist-packages/seam
[[ -f $module/py.typed ]] || complain "$module has no py.typed: its types are not seen"
differ=$(diff -rq --exclude='*.so' --exclude=__pycache__ "$built" "$module") || complain "not installed as it was built: $differ"
for file in "$built"/*.so; do
  [[ -s $module/${file##*/} ]] || complain "$module has no ${file##*/}"
done

rm -rf "$folder"
mkdir -p "$folder/moved here/lib/python3/dist-packages" "$folder/alone/seam" "$folder/work"
cp -r "$module" "$folder/moved here/lib/python3/dist-packages"
cp -r "$prefix/share" "$folder/moved here"
cp -r "$module" "$folder/alone"
cp -r "$prefix/share/seam" "$folder/alone/seam/share"
cd "$folder/work" || exit 1

cat >play.py <<'END'
import os, sys
import seam

lies = os.path.dirname(seam.__file__)
assert lies == os.path.join(sys.argv[1], "seam"), lies
assert {"carrying", "line", "wiping"} <= set(seam.scenes()), seam.scenes()
up = seam.Demonstration.read(sys.argv[2] + "/assets/demos/ramp_up.csv")
assert len(seam.rollout(seam.Sequence().then(seam.learn(up)), "dmp3").time) > 100
run = seam.play("line", method="dmp3")
assert run.ticks > 1000 and seam.measure(run).torque_jump_nm < 1
END
plays() { # MODULE'S FOLDER, SHARE
  env -i PATH="$PATH" PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$1" "$python" play.py "$1" "$2" 2>log || complain "$1: $(tail -n 3 log)"
}
plays "$folder/moved here/lib/python3/dist-packages" "$folder/moved here/share/seam"
plays "$folder/alone" "$folder/alone/seam/share"
exit $failed
