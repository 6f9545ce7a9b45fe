#!/bin/sh
# run.sh BUILD SECONDS: runs each reader's fuzzer for a while, as many at a time as there are cores. What it finds goes to
# BUILD/found, to be replayed with BUILD/tests/fuzz/fuzz_READER FILE; inputs that cover more go to BUILD/corpus, of which
# `fuzz_READER -merge=1 tests/fuzz/corpus/READER BUILD/corpus/READER` keeps what is worth it.
set -eu
build=$(realpath "$1") corpus=$(realpath "$(dirname "$0")/corpus")
[ ! -d /dev/shm ] || export TMPDIR=/dev/shm
printf '%s\n' csv primitive sequence scene urdf | xargs -P "$(nproc)" -I READER sh -c '
  mkdir -p "$0/corpus/READER" "$0/found/READER"
  "$0/tests/fuzz/fuzz_READER" -max_total_time="$2" -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=256 -max_len=8192 -len_control=0 -dict="$1/../words.dict" \
    -print_final_stats=1 -artifact_prefix="$0/found/READER/" "$0/corpus/READER" "$1/READER" >"$0/READER.log" 2>&1
  status=$?
  echo "READER: $(grep -E "^(Done|SUMMARY)" "$0/READER.log")"
  exit $status' "$build" "$corpus" "$2"
