#!/bin/sh
# usage: submit.sh MANIFEST DIR
# Submits a sweep as an array job, whose tasks share the replicates and write to DIR. Also submits a job that makes the
# tables when all tasks have ended. Both jobs write their logs to DIR/logs. Prints the two job numbers. To
# continue a sweep, wait until its tasks have ended and repeat the command.
# Environment variables, with their default values:
#   TASKS=4      number of tasks; tasks beyond the number of replicates have nothing to do
#   THREADS=4    threads of a task, all on one node
#   MEMORY=4     memory of a task in GiB, an integer
#   MINUTES=60   time limit of a task, at least 3; a task that reaches it returns to the queue and continues later
#   PARTITION    partition of Slurm; default: the one of the cluster
#   ISOJAM       path of the program; default: build/isojam of this tree
set -eu
[ $# -eq 2 ] || { sed -n '2,/^set/{s/^# \{0,1\}//p;}' "$0" >&2; exit 2; }
manifest=$1 directory=$2
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
isojam=${ISOJAM:-$here/../../build/isojam}

# Report errors of the manifest now, not only when the array starts.
"$isojam" validate "$manifest" >&2
# Slurm does not make directories. A job whose log cannot be opened fails without a log.
mkdir -p "$directory/logs"

submit() {  # takes options and script for sbatch; prints the job number
  job=$(sbatch --parsable ${PARTITION:+--partition="$PARTITION"} "$@")
  echo "${job%%;*}"  # in a federation, `;` and the name of the cluster follow the number
}

array=$(submit --array="1-${TASKS:-4}" --cpus-per-task="${THREADS:-4}" --mem="${MEMORY:-4}G" --time="${MINUTES:-60}" \
  --output="$directory/logs/%A_%a.log" "$here/sweep.sbatch" "$isojam" "$manifest" "$directory")
# With afterok, the job would wait forever if one task failed.
table=$(submit --dependency="afterany:$array" --output="$directory/logs/%j-table.log" \
  "$here/table.sbatch" "$isojam" "$directory")
echo "array $array, table $table"
