#!/usr/bin/env bash
# Usage: program.sh PREFIX FOLDER
# The program as it is installed, moved into FOLDER and used from an empty folder of results, as the README says.
set -uo pipefail
prefix=$1 folder=$2
failed=0
complain() {
  echo "$1"
  failed=1
}

rm -rf "$folder"
mkdir -p "$folder/moved here" "$folder/work"
cp -r "$prefix/bin" "$prefix/share" "$folder/moved here"
share="$folder/moved here/share/seam"
cd "$folder/work" || exit 1
seam() { "$folder/moved here/bin/seam" "$@"; }
as_it_was=$(cd "$share" && find . -type f -exec sha256sum {} + | sort)

works() { # FILE ARGUMENTS…: leaves FILE
  local file=$1
  shift
  seam "$@" >log 2>&1 || complain "seam $*: exit code $?: $(tail -n 3 log)"
  [[ $file = - || -s $file ]] || complain "seam $*: leaves no $file"
}
works results/report.html bench line --check bench/baselines
works results/run/line/dmp3.csv run line --method dmp3
works line.png render results/line/dmp3 -o line.png --size 320x180
works page.html report results/run -o page.html
works joins.csv sweep line --vary sequence.steps.0.until.before_end=0.1:0.3:2 --method dmp3 -o joins.csv
works - check assets/pa10/pa10.urdf
works up.yaml learn assets/demos/ramp_up.csv -o up.yaml
[[ $(cd "$share" && find . -type f -exec sha256sum {} + | sort) = "$as_it_was" ]] || complain "share/seam is written into"

mapfile -t commands < <(seam --help | sed -nE '1,/^Subcommands:/d; s/^  ([a-z]+) .*/\1/p')
for command in "${commands[@]/#/-}" ""; do
  [[ -s $prefix/share/man/man1/seam$command.1 ]] || complain "seam$command has no manual page"
done

source "$folder/moved here/share/bash-completion/completions/seam"
completes() { # WORDS WANTED…: the last of WORDS becomes just these
  read -ra COMP_WORDS <<<"$1"
  [[ $1 != *' ' ]] || COMP_WORDS+=("")
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  COMPREPLY=()
  _seam seam "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  [[ ${COMPREPLY[*]-} = "$*" ]] || complain "${COMP_WORDS[*]} is completed to ${COMPREPLY[*]-}, must be $*"
}
completes "seam " "${commands[@]}"
completes "seam re" render report
completes "seam bench ca" carrying catching
completes "seam bench --method dmp2" dmp2 dmp2a dmp2j
completes "seam bench --arm " ideal published both
completes "seam run --arm " ideal published
completes "seam experiment go" goal-change
completes "seam sweep --sa" --samples
for command in "${commands[@]}"; do
  mapfile -t options < <(seam "$command" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | sed -E 's/.*(--)/\1/')
  completes "seam $command --" "${options[@]}"
done

mv "$share" "$share.away"
seam bench --list >log 2>&1
[[ $? = 2 && $(cat log) = *"share/seam: is not there, it holds seam's own scenes and assets" ]] ||
  complain "without its share, it says: $(cat log)"
exit $failed
