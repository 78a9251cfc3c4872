#!/usr/bin/env bash
# usage: test_slurm.sh ISOJAM
# On a Slurm cluster of its own, with the scripts of examples/06-cluster as they are, an array of three tasks proves:
#   1. A task whose isojam is killed with -9 at work fails with 137, and the job of the table goes on waiting; put back
#      into the queue, the task completes.
#   2. In a task that meets its time limit isojam exits with 75, leaves a checkpoint, and the task, no other, puts
#      itself back into the queue and completes; what it had recorded is not touched again.
#   3. For all that, table and packings are those of one run outside of Slurm, byte for byte, and so are the records
#      but for timing and checksum.
#   4. A task ended by scancel does not come back.
#   5. Nothing is left running.
# Takes two minutes on two idle cores; the cluster is given four and no more. Exits with 77, untested, if this is not
# root.
set -euo pipefail
export LC_ALL=C
[[ $EUID -eq 0 ]] || { echo 'NOT TESTED: the daemons of Slurm need root, and this is not root' >&2; exit 77; }

isojam=$(realpath "${1:?usage: test_slurm.sh ISOJAM}")
here=$(cd "$(dirname "$0")" && pwd)
example=$(realpath "$here/../../examples/06-cluster")
manifest=$example/manifest.json
readonly isojam here example manifest
# shellcheck source-path=SCRIPTDIR source=cluster.sh
. "$here/cluster.sh"

work=$(mktemp -d /tmp/isojam-slurm.XXXXXX)
results=$work/results
array='' table=''

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

print_all() {
  printf '\n==== jobs\n'
  scontrol show job || true
  for log in "$results"/logs/*; do printf '\n==== %s\n' "${log##*/}"; cat "$log" || true; done
  print_cluster_logs
}

clean_up() {
  local code=$?
  trap - EXIT
  [[ $code -eq 0 ]] || print_all >&2
  stop_cluster || true
  rm -rf "$work"
  exit "$code"
}
trap clean_up EXIT

say() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

await() {  # SECONDS WHAT COMMAND...: until the command succeeds
  local until=$((SECONDS + $1)) what=$2
  ((until < deadline)) || until=$deadline
  shift 2
  until "$@"; do
    [[ $SECONDS -lt $until ]] || fail "waited in vain: $what"
    sleep .1
  done
}

# ---- What Slurm says of a job ------------------------------------------------------------------------------------
field() {  # JOB FIELD
  scontrol --oneliner show job "$1" | grep -oP "(^| )$2=\K\S+"
}
state() { echo "$(field "$1" JobState) $(field "$1" ExitCode) restarts $(field "$1" Restarts)"; }
is() { [[ $(state "$1") == "$2" ]]; }  # JOB STATE
expect() { is "$1" "$2" || fail "job $1 is '$(state "$1")', not '$2'"; }

# ---- What a task does --------------------------------------------------------------------------------------------
# Replicates are dealt to tasks in turn, and there are twice as many per solid as tasks.
files_of() {  # FOLDER TASK
  find "$results/$1" -name "*-r000[$(($2 - 1))$(($2 + 2))].json" 2>/dev/null | sort
}
program_of() {  # TASK: pid
  local pid
  for pid in $(cluster_pids SLURM_ARRAY_JOB_ID="$array" SLURM_ARRAY_TASK_ID="$1"); do
    [[ $(readlink "/proc/$pid/exe") != "$isojam" ]] || echo "$pid"
  done
}
at_work() { [[ $(program_of "$1") && $(files_of checkpoints "$1") ]]; }
amid() {  # TASK: it has recorded one replicate, and works on another
  local checkpoint
  [[ $(program_of "$1") && $(files_of records "$1") ]] || return 1
  for checkpoint in $(files_of checkpoints "$1"); do
    [[ -e $results/records/${checkpoint##*/} ]] || return 0
  done
  return 1
}
logs_of() { cat "$results/logs/${array}_$1.log"; }
fingerprint() { xargs -r stat --format='%n %i %y'; }

sigterm_pending() {  # PID
  local mask sigterm
  sigterm=$(kill -l TERM)
  mask=$(awk '/^ShdPnd:/ { print $2 }' "/proc/$1/status" 2>/dev/null) || return 1
  (((0x$mask >> (sigterm - 1)) & 1))
}

# ---- The test ----------------------------------------------------------------------------------------------------
submit_sweep() {
  local answer
  answer=$(TASKS=3 THREADS=1 MEMORY=1 MINUTES=10 ISOJAM=$isojam "$example/submit.sh" "$manifest" "$results")
  [[ $answer =~ ^array\ ([0-9]+),\ table\ ([0-9]+)$ ]] || fail "submit.sh said '$answer'"
  array=${BASH_REMATCH[1]} table=${BASH_REMATCH[2]}
  say "$answer"
}

kill_first_task() {
  await 60 'task 1 at work' at_work 1
  kill -KILL "$(program_of 1)"
  await 20 'the end of task 1' is "${array}_1" 'FAILED 137:0 restarts 0'
  logs_of 1 | grep -qx 'isojam exited 137' || fail 'the log of task 1 does not tell its exit code'
  expect "$table" 'PENDING 0:0 restarts 0'
  say "task 1, isojam killed: $(state "${array}_1"); table: $(state "$table")"
  scontrol requeue "${array}_1"
}

# Limits are whole minutes from the start of a task, and the controller looks at them every thirty seconds: this one
# leaves 40 s to 100 s, so that the signal comes first.
limit_soon() {  # JOB
  local elapsed
  elapsed=$(($(date +%s) - $(date -d "$(field "$1" StartTime)" +%s)))
  scontrol update JobId="$1" TimeLimit=$(((elapsed + 40) / 60 + 1))
}

# A stopped program stands in for one whose replicates take longer than the time limit.
let_third_task_meet_its_limit() {
  await 90 'task 3 amid its part' amid 3
  local program
  program=$(program_of 3)
  kill -STOP "$program"
  files_of records 3 | fingerprint >"$work/recorded"
  limit_soon "${array}_3"
  await 90 'SIGTERM for task 3' sigterm_pending "$program"
  kill -CONT "$program"
  await 20 'task 3 in the queue again' is "${array}_3" 'PENDING 0:0 restarts 1'
  scontrol update JobId="${array}_3" TimeLimit=10
  logs_of 3 | grep -qx 'isojam exited 75' || fail 'the log of task 3 does not tell of 75'
  [[ $(files_of checkpoints 3) ]] || fail 'task 3 left no checkpoint'
  expect "$table" 'PENDING 0:0 restarts 0'
  say "task 3, out of time: $(state "${array}_3"), $(wc -l <"$work/recorded") replicates recorded"
}

check_outcome() {
  await 150 'the table' is "$table" 'COMPLETED 0:0 restarts 0'
  expect "${array}_1" 'COMPLETED 0:0 restarts 1'
  expect "${array}_2" 'COMPLETED 0:0 restarts 0'
  expect "${array}_3" 'COMPLETED 0:0 restarts 1'
  files_of records 3 | fingerprint >"$work/recorded.now"
  [[ -z $(comm -23 "$work/recorded" "$work/recorded.now") ]] || fail 'task 3 recorded a replicate anew'
  local task
  for task in 1 2 3; do
    logs_of "$task" | grep -q "shard $task/3 is done" || fail "task $task did not work on its part"
  done
  say 'all tasks and the table: COMPLETED 0:0'
  "$here/same_results.py" "$work/single" "$results" || fail 'not the results of one machine'
}

cancelled_task_stays_so() {
  results=$work/cancelled
  mkdir -p "$results/logs"
  array=$(sbatch --parsable --array=1-1 --cpus-per-task=1 --mem=1G --output="$results/logs/%A_%a.log" \
    "$example/sweep.sbatch" "$isojam" "$manifest" "$results")
  await 60 'a task to cancel at work' program_of_one_shard
  scancel "$array"
  await 20 'the end of the cancelled task' cancelled_job_is_over
  logs_of 1 | grep -qx 'isojam exited 75' || fail 'the log of the cancelled task does not tell of 75'
  [[ $(state "${array}_1") == CANCELLED*' restarts 0' ]] || fail "after scancel: $(state "${array}_1")"
  say "task ended by scancel: $(state "${array}_1")"
}
program_of_one_shard() { [[ $(program_of 1) && $(find "$results/checkpoints" -name '*.json' 2>/dev/null) ]]; }
cancelled_job_is_over() {
  [[ -z $(cluster_pids SLURM_ARRAY_JOB_ID="$array") && $(field "${array}_1" JobState) != COMPLETING ]]
}

"$isojam" --quiet run "$manifest" -o "$work/single" -j 2 >/dev/null
say 'reference made on one machine'
readonly deadline=$((SECONDS + 240))
start_cluster "$work"
say "cluster of one node: $(sinfo --noheader --format='%n %T, %c cores' | head -n 1)"
submit_sweep
kill_first_task
let_third_task_meet_its_limit
check_outcome
cancelled_task_stays_so
stop_cluster || fail 'processes outlived their cluster'
say 'nothing left running'
