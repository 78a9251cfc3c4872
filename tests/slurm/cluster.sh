# A Slurm cluster of one node of two cores, private to whoever sources this file: munged, slurmctld and slurmd are run
# by hand with files, key and ports of their own, beside any cluster that the machine may belong to. For bash, as root.
#
#   start_cluster WORK     in an existing empty directory WORK, whose path is to be shorter than 80 characters
#   stop_cluster           ends all of its jobs and daemons, at any time, and does nothing when called again; fails if
#                          a process outlived them, which it ends as well
#   cluster_pids [VARIABLE=VALUE]...  processes of the cluster, with these in their environment
#   print_cluster_logs
# Slurm's commands find the cluster by SLURM_CONF, which start_cluster exports.

readonly cluster_cores=2
cluster=
daemon_pids=()

free_ports() {  # COUNT
  /usr/bin/python3 - "$1" <<'END'
import socket, sys
held = [socket.socket() for _ in range(int(sys.argv[1]))]
for each in held:
    each.bind(("127.0.0.1", 0))
print(*(each.getsockname()[1] for each in held))
END
}

write_slurm_conf() {  # on stdout
  local controller_port node_port
  read -r controller_port node_port < <(free_ports 2)
  # A task that is put back into the queue may start when the credential of its last turn has expired: five seconds,
  # the least, where two minutes are usual.
  cat <<END
ClusterName=isojam-test
SlurmctldHost=${HOSTNAME%%.*}(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$cluster/munge.socket,cred_expire=5
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
MpiDefault=none
MailProg=/bin/true
SlurmdParameters=config_overrides
SchedulerParameters=bf_interval=1,sched_interval=1
ReturnToService=2
KillWait=5
MinJobAge=3600
NodeName=${HOSTNAME%%.*} NodeAddr=127.0.0.1 CPUs=$cluster_cores RealMemory=4096 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
}

start_daemon() {  # NAME COMMAND...: in the foreground of a background job, so that its pid is certain
  local name=$1
  shift
  "$@" >"$cluster/$name.log" 2>&1 </dev/null &
  daemon_pids+=($!)
}

await_cluster() {
  local tenths
  for ((tenths = 0; tenths < 300; ++tenths)); do
    [[ $(sinfo --noheader --format=%T 2>/dev/null) != idle ]] || return 0
    sleep .1
  done
  echo 'the private Slurm cluster did not come up within 30 s' >&2
  return 1
}

start_cluster() {
  cluster=$1
  # Variables of a surrounding job or shell would act as options.
  unset "${!SLURM_@}" "${!SBATCH_@}" "${!SQUEUE_@}" "${!SCANCEL_@}" "${!SINFO_@}"
  export SLURM_CONF=$cluster/slurm.conf
  mkdir "$cluster/state" "$cluster/spool"
  (umask 077 && head -c 1024 /dev/urandom >"$cluster/munge.key")
  write_slurm_conf >"$SLURM_CONF"
  # Read whether or not control groups are used. Version 2 would ask for systemd.
  printf '%s\n' CgroupPlugin=cgroup/v1 CgroupAutomount=no ConstrainCores=no >"$cluster/cgroup.conf"

  # --force: as root, and in a directory that others may write to.
  start_daemon munged munged --foreground --force --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" \
    --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.own.log" --seed-file="$cluster/munged.seed"
  until [[ -S $cluster/munge.socket ]] || ! kill -0 "${daemon_pids[0]}" 2>/dev/null; do sleep .1; done
  start_daemon slurmctld slurmctld -D -c
  start_daemon slurmd slurmd -D -c
  await_cluster
}

cluster_pids() {
  local environment pid wanted
  for environment in /proc/[0-9]*/environ; do
    pid=${environment//[!0-9]/}
    # The processes of the job inherit where their Slurm is; a process may end while it is looked at.
    for wanted in "SLURM_CONF=$cluster/slurm.conf" "$@"; do
      grep -qzxF -- "$wanted" "$environment" 2>/dev/null || continue 2
    done
    echo "$pid"
  done
}

await_none() {  # TENTHS COMMAND...: until it prints nothing
  local tenths=$1
  shift
  for (( ; tenths > 0; --tenths)); do
    [[ -n $("$@" 2>/dev/null) ]] || return 0
    sleep .1
  done
  return 1
}

stop_cluster() {
  [[ ${#daemon_pids[@]} -gt 0 ]] || return 0
  local pid outlived
  scancel --user=root 2>/dev/null || true
  await_none 150 squeue --noheader || true
  for pid in "${daemon_pids[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
  for pid in "${daemon_pids[@]}"; do wait "$pid" 2>/dev/null || true; done
  daemon_pids=()
  await_none 50 cluster_pids && return 0
  outlived=$(cluster_pids)
  for pid in $outlived; do
    ps -o pid,args -p "$pid" >&2 || true
    kill -KILL "$pid" 2>/dev/null || true
  done
  return 1
}

print_cluster_logs() {
  local log
  for log in "$cluster"/{munged,slurmctld,slurmd}.log; do
    printf '\n==== %s\n' "${log##*/}"
    tail -n 60 "$log" 2>/dev/null || echo 'none'
  done
}
