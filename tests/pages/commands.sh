#!/usr/bin/env bash
# Usage: commands.sh PARSER FILE.sh...
# Plays the command lines of pages without doing what they say: PARSER parses those of seam; make's targets and CMake's
# presets must be there; other programs are known by name. Exit 1, with a line for each that is not known.
parser=$1
shift
makefile=$(<Makefile)
presets=$(<CMakePresets.json)
complaints=$(mktemp)
folder=$(mktemp -d)
trap 'rm -rf "$complaints" "$folder"' EXIT

complain() { echo "$page: $1" >>"$complaints"; }
known_preset() { # PROGRAM ARGUMENT...
  while [ $# -gt 1 ]; do
    [ "$1" != --preset ] || [[ $presets == *"\"name\": \"$2\""* ]] || complain "no preset $2"
    shift
  done
}
seam() { "$parser" "$@" >"$folder/said" 2>&1 || complain "seam $*: $(<"$folder/said")"; }
make() { [[ $makefile == *$'\n'"$1:"* || $makefile == *$'\n'"$1 "*": "* ]] || complain "make $1: no such target"; }
cmake() { known_preset cmake "$@"; }
ctest() { known_preset ctest "$@"; }
cpack() { known_preset cpack "$@"; }
for program in awk g++ pip pkg-config sudo; do eval "$program() { :; }"; done
command_not_found_handle() { complain "$1: not known here, see tests/pages/commands.sh"; }
PATH=$folder

for page; do
  commands=$(<"$page")
  page=${page##*/}
  cd "$folder" || exit 1
  eval "${commands//build\/release\/bench\/seam/seam}" 2>>"$complaints"
done >/dev/null
PATH=/usr/bin:/bin
cat "$complaints"
[ ! -s "$complaints" ]
