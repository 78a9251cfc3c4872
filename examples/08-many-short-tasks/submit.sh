#!/bin/sh
# usage: submit.sh MANIFEST DIR
# Submits a sweep to a running HyperQueue server as an array of many short tasks. Prints the job number, waits until all
# tasks have ended, and makes the tables. Repeat the command to continue a sweep; replicates that have a record are not
# repeated.
# Environment variables, with their default values:
#   TASKS=100    number of tasks, at best the number of replicates; tasks beyond this number have nothing to do
#   THREADS=1    threads of a task
#   MEMORY=1     memory of a task in GiB
#   ISOJAM       path of the program; default: build/isojam of this tree
set -eu
[ $# -eq 2 ] || { sed -n '2,/^set/{s/^# \{0,1\}//p;}' "$0" >&2; exit 2; }
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
# Tasks run in other working directories, so all paths must be absolute.
isojam=$(realpath "${ISOJAM:-$here/../../build/isojam}")
manifest=$(realpath "$1")
mkdir -p "$2/logs"
directory=$(realpath "$2")

"$isojam" validate "$manifest" >&2
job=$(hq --output-mode=quiet submit --name=isojam --array="1-${TASKS:-100}" --cpus="${THREADS:-1}" \
  --stdout=none --stderr="$directory/logs/%{JOB_ID}-%{TASK_ID}.log" -- \
  "$here/task.sh" "$isojam" "$manifest" "$directory" "${TASKS:-100}" "${THREADS:-1}" "${MEMORY:-1}")
echo "job $job"
# Make the tables also if some tasks failed.
hq job wait "$job" || true
"$isojam" status "$directory"
"$isojam" aggregate "$directory" -o "$directory/tables.json"
