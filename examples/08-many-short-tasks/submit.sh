#!/bin/sh
# usage: submit.sh MANIFEST DIR
# Submits a sweep to a running HyperQueue server as an array of many short tasks, waits for them and makes the table.
# Prints the job number first. The same command continues a sweep; what is recorded is not repeated.
# Environment, with defaults:
#   TASKS=100    tasks of the array: as many as there are replicates is best, more are of no use
#   THREADS=1    of a task
#   MEMORY=1     GiB of a task
#   ISOJAM       the program; build/isojam of this tree
set -eu
[ $# -eq 2 ] || { sed -n '2,/^set/{s/^# \{0,1\}//p;}' "$0" >&2; exit 2; }
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
# Tasks run elsewhere: every path is absolute.
isojam=$(realpath "${ISOJAM:-$here/../../build/isojam}")
manifest=$(realpath "$1")
mkdir -p "$2/logs"
directory=$(realpath "$2")

"$isojam" validate "$manifest" >&2
job=$(hq --output-mode=quiet submit --name=isojam --array="1-${TASKS:-100}" --cpus="${THREADS:-1}" \
  --stdout=none --stderr="$directory/logs/%{JOB_ID}-%{TASK_ID}.log" -- \
  "$here/task.sh" "$isojam" "$manifest" "$directory" "${TASKS:-100}" "${THREADS:-1}" "${MEMORY:-1}")
echo "job $job"
# A task that failed is no reason to do without a table of the others.
hq job wait "$job" || true
"$isojam" status "$directory"
"$isojam" aggregate "$directory" -o "$directory/tables.json"
