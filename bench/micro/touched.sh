#!/bin/sh
# Usage: touched.sh PROGRAM. Says in a line how much memory a control tick touches, in lines of 64 bytes: what valgrind's lackey
# sees between the program's marks. What both arms touch is shared (Bullet's tree, the stack, constants), the rest an arm's own.
set -eu
valgrind --tool=lackey --trace-mem=yes --log-fd=9 "$1" 9>&1 >/dev/null | awk '
  /tick begins/ {arm++; inside = 1; next}
  /tick ends/ {inside = 0; next}
  inside && /^ [LSM] / {
    split($2, part, ",")
    address = part[1]
    n = length(address)
    line = substr(address, 1, n - 2) int((index("0123456789abcdef", substr(address, n - 1, 1)) - 1) / 4)
    seen[arm, line] = 1
    lines[line] = 1
  }
  END {
    for (line in lines) {
      first = (1, line) in seen
      second = (2, line) in seen
      if (first && second) both++
      else if (first) own++
    }
    if (own == 0) exit 1
    printf "A control tick in joint space touches %.1f kB that are its arm'"'"'s own, and %.1f kB that all arms share.\n", own * 64 / 1000, both * 64 / 1000
  }'
