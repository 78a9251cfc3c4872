#!/bin/bash
# Runs every fuzzer of a build directory for some seconds each, and prints the number of inputs tried and their coverage.
# Exits with 1 if one of them found something.
set -u
build=$1 seconds=$2
here=$(cd "$(dirname "$0")" && pwd)
failed=0
for what in manifest record checkpoint; do
  work=$build/fuzz-$what
  mkdir -p "$work/corpus"
  "$build/tests/fuzz/fuzz_$what" -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -use_value_profile=0 -artifact_prefix="$work/" "$work/corpus" "$here/seeds/$what" >"$work/log" 2>&1
  code=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/log")
  coverage=$(grep -o 'cov: [0-9]* ft: [0-9]*' "$work/log" | tail -1)
  echo "$what: ${executions:-0} executions, ${coverage:-no coverage}, $(ls "$work/corpus" | wc -l) inputs kept, exit $code"
  if [ $code -ne 0 ]; then
    failed=1
    tail -40 "$work/log"
  fi
done
exit $failed
