#!/bin/sh
# usage: task.sh ISOJAM MANIFEST DIR TASKS THREADS MEMORY
# Runs one part of the sweep. HyperQueue sets HQ_TASK_ID to the number of the part, from 1 to TASKS. Any other program
# that starts tasks can set this variable too.
set -eu
isojam=$1 manifest=$2 directory=$3 tasks=$4 threads=$5 memory=$6
# --memory: without it, each isojam would use the memory of the whole node, but several tasks share the node.
# exec: isojam itself receives the signals that are sent to the task, and writes a checkpoint.
exec "$isojam" run "$manifest" -o "$directory" --shard "${HQ_TASK_ID:?}/$tasks" -j "$threads" --memory "$memory" --quiet
