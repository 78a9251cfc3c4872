#!/bin/sh
# usage: submit.sh MANIFEST DIR
# Submits a sweep as an array job, whose tasks share its replicates and write to DIR, and a job that makes the table
# when they have ended. Both write their logs to DIR/logs. Prints the two job numbers. The same command continues a
# sweep; let the first array end before.
# Environment, with defaults:
#   TASKS=4      tasks of the array; more than there are replicates are of no use
#   THREADS=4    of a task, all on one node
#   MEMORY=4     GiB of a task, whole
#   MINUTES=60   time limit of a task, at least 3; a task that meets it goes on in another turn
#   PARTITION    the cluster's default
#   ISOJAM       the program; build/isojam of this tree
set -eu
[ $# -eq 2 ] || { sed -n '2,/^set/{s/^# \{0,1\}//p;}' "$0" >&2; exit 2; }
manifest=$1 directory=$2
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
isojam=${ISOJAM:-$here/../../build/isojam}

# Report errors of the manifest now, rather than when the array starts.
"$isojam" validate "$manifest" >&2
# Slurm makes no directories, and a job whose log cannot be opened fails without one.
mkdir -p "$directory/logs"

submit() {  # options and script of sbatch; prints the job number
  job=$(sbatch --parsable ${PARTITION:+--partition="$PARTITION"} "$@")
  echo "${job%%;*}"  # on a federation the name of the cluster follows
}

array=$(submit --array="1-${TASKS:-4}" --cpus-per-task="${THREADS:-4}" --mem="${MEMORY:-4}G" --time="${MINUTES:-60}" \
  --output="$directory/logs/%A_%a.log" "$here/sweep.sbatch" "$isojam" "$manifest" "$directory")
# Not afterok: one failed task, and the table would wait for ever.
table=$(submit --dependency="afterany:$array" --output="$directory/logs/%j-table.log" \
  "$here/table.sbatch" "$isojam" "$directory")
echo "array $array, table $table"
