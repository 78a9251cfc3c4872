#!/bin/sh
# usage: task.sh ISOJAM MANIFEST DIR TASKS THREADS MEMORY
# One of many short tasks works on its part of the sweep. HyperQueue says which it is in HQ_TASK_ID, from 1 to TASKS;
# whatever else starts tasks may set that.
set -eu
isojam=$1 manifest=$2 directory=$3 tasks=$4 threads=$5 memory=$6
# Left to itself isojam takes what memory the node has, which these tasks share.
# exec: a signal for the task is one for isojam, which leaves a checkpoint.
exec "$isojam" run "$manifest" -o "$directory" --shard "${HQ_TASK_ID:?}/$tasks" -j "$threads" --memory "$memory" --quiet
