#!/bin/sh
# manual.sh PROGRAM VERSION FOLDER: the program's own help as manual pages, seam.1 and seam-COMMAND.1 of every command.
set -eu
program=$1 version=$2 folder=$3

page() { # NAME [COMMAND]
  name=$1
  shift
  help2man --no-info --version-string="$version" --name="$("$program" "$@" --help | sed -n '1s/^seam: //p; 1p; q' | head -n 1)" \
    --output="$folder/$name.1" "$program $*"
}

mkdir -p "$folder"
page seam
"$program" --help | sed -nE '1,/^Subcommands:/d; s/^  ([a-z]+) .*/\1/p' | while read -r command; do
  page "seam-$command" "$command"
done
