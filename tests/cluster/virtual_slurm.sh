#!/usr/bin/env bash
# A Slurm cluster on this machine alone, for tests: nodes n1 ... n4, loopback only, no systemd.
#   virtual_slurm.sh up                  starts what is not running, and waits until all nodes are idle
#   virtual_slurm.sh down                ends everything; jobs are forgotten, logs stay
#   virtual_slurm.sh env                 prints what to `eval` before sbatch, squeue and the like
#   virtual_slurm.sh node-kill nI        as if the node lost its power
#   virtual_slurm.sh node-up nI
#   virtual_slurm.sh controller-restart  jobs live on
#   virtual_slurm.sh status
# All state is in the folder VIRTUAL_SLURM_DIR, which also tells one cluster from another.
set -euo pipefail

state=${VIRTUAL_SLURM_DIR:?is the folder for all state of the cluster}
mkdir -p "$state"
state=$(cd "$state" && pwd -P)
node_count=${VIRTUAL_SLURM_NODES:-4}
node_cpus=2
node_megabytes=4000
run=$state/run
logs=$state/log
export SLURM_CONF=$state/slurm.conf
export PATH=$PATH:/usr/sbin:/sbin

say() { printf 'virtual_slurm: %s\n' "$*" >&2; }

die() {
  say "$*"
  tail -n 5 "$logs"/* >&2 2>/dev/null || true
  exit 1
}

check_installed() {
  local program missing=()
  for program in munged mungekey munge slurmctld slurmd sbatch scontrol sinfo; do
    command -v "$program" >/dev/null || missing+=("$program")
  done
  [ ${#missing[@]} -eq 0 ] || die "not installed: ${missing[*]} (packages slurmctld slurmd" \
    "slurm-client slurm-wlm-basic-plugins munge)"
}

nodes() { seq -f 'n%g' "$node_count"; }

check_node() {
  nodes | grep -qx -- "${1:-}" || die "no such node: '${1:-}'"
}

# --- processes -------------------------------------------------------------------------------

# Fields of /proc/PID/stat after the name, which may hold spaces: state, parent, ... start time.
stat_fields() {
  local line
  line=$(cat "/proc/$1/stat" 2>/dev/null) || return 1
  printf '%s\n' "${line##*) }"
}

start_time() { stat_fields "$1" | cut -d ' ' -f 20; }

# Where pid 1 does not reap, an ended daemon stays a zombie that `kill -0` takes for alive.
is_alive() {
  local fields
  fields=$(stat_fields "$1") || return 1
  case $fields in [ZX]*) return 1 ;; esac
}

# The pid of a daemon that runs; a recorded pid may have gone to a stranger meanwhile.
daemon_pid() {
  local pid started
  read -r pid started 2>/dev/null <"$run/$1.pid" || return 1
  is_alive "$pid" && [ "$(start_time "$pid")" = "$started" ] || return 1
  echo "$pid"
}

# In the foreground form, so that the pid is known, but in a session of its own.
start_daemon() {
  local name=$1; shift
  daemon_pid "$name" >/dev/null && return
  setsid "$@" </dev/null >>"$logs/$name.out" 2>&1 &
  local pid=$!
  echo "$pid $(start_time "$pid")" >"$run/$name.pid"
}

end_daemon() {
  local name=$1 pid tenth
  if pid=$(daemon_pid "$name"); then
    kill -TERM "$pid" 2>/dev/null || true
    for tenth in $(seq 100); do
      is_alive "$pid" || break
      sleep 0.1
    done
    kill -KILL "$pid" 2>/dev/null || true
  fi
  rm -f "$run/$name.pid"
}

# slurmd and its job steps, which leave its process tree and overwrite their environment but keep
# the folder they were started in.
node_processes() {
  local link
  for link in $(find /proc/[0-9]*/cwd -maxdepth 0 -lname "$state/node-$1" 2>/dev/null); do
    basename "${link%/cwd}"
  done
}

with_descendants() {
  local pid
  for pid in /proc/[0-9]*; do
    stat_fields "${pid#/proc/}" | awk -v pid="${pid#/proc/}" '{ print pid, $2 }' || true
  done 2>/dev/null | awk -v roots="$*" '
    { parent[$1] = $2 }
    END {
      count = split(roots, list, " ")
      for (i = 1; i <= count; ++i) wanted[list[i]] = 1
      do {
        grown = 0
        for (pid in parent) if (!(pid in wanted) && (parent[pid] in wanted)) { wanted[pid] = 1; grown = 1 }
      } while (grown)
      for (pid in wanted) print pid
    }'
}

# Stopped first: whatever runs could start others between the look and the kill.
kill_node() {
  local before='' now roots
  while :; do
    roots=$(node_processes "$1")
    [ -n "$roots" ] || break
    now=$(with_descendants $roots | sort)
    kill -STOP $now 2>/dev/null || true
    [ "$now" = "$before" ] && break
    before=$now
  done
  [ -z "$before" ] || kill -KILL $before 2>/dev/null || true
  rm -f "$run/slurmd-$1.pid"
}

# --- configuration ---------------------------------------------------------------------------

is_port_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

are_ports_free() {
  local port
  for port in $(seq "$1" $(($1 + node_count))); do
    is_port_free "$port" || return 1
  done
}

# Below the ports that the kernel hands out, at a place that differs from folder to folder.
pick_ports() {
  local slot first try
  slot=$(printf '%s' "$state" | cksum | cut -d ' ' -f 1)
  for try in $(seq 0 99); do
    first=$((20000 + (slot + try) % 750 * 16))
    are_ports_free "$first" && break
  done
  echo "$first"
}

# cred_expire: a requeued job starts only when its old credential is over, 120 s by default.
# TmpFS: the steps of all nodes would use the same files in /tmp otherwise.
# linuxproc, none: there may be no cgroups to write to; so memory limits are not enforced. Unless
# told which kind of cgroups there is, slurmd looks for them, and ends where there are none.
# SlurmdTimeout: how soon a lost node is noticed, 300 s by default.
write_configuration() {
  local port=$1 host user
  host=$(uname -n)
  host=${host%%.*}
  user=$(id -un)
  echo 'CgroupPlugin=cgroup/v1' >"$state/cgroup.conf"
  cat >"$SLURM_CONF" <<CONFIGURATION
ClusterName=virtual
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$run/munge.socket,cred_expire=10
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation=$state/controller
SlurmdSpoolDir=$state/node-%n/spool
TmpFS=$state/node-%n/tmp
SlurmctldPidFile=$run/slurmctld.own
SlurmdPidFile=$run/slurmd-%n.own
SlurmctldLogFile=$logs/slurmctld.log
SlurmdLogFile=$logs/slurmd-%n.log
SlurmctldDebug=info
SlurmdDebug=info
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$logs/jobs.txt
MailProg=/bin/true
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
DefMemPerCPU=500
MpiDefault=none
ReturnToService=2
SlurmdTimeout=6
KillWait=5
MinJobAge=3600
SlurmdParameters=config_overrides
NodeName=n[1-$node_count] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + node_count))] CPUs=$node_cpus RealMemory=$node_megabytes State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
}

# --- commands --------------------------------------------------------------------------------

wait_until() {
  local what=$1 tenth; shift
  for tenth in $(seq 300); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.1
  done
  die "$what is not ready after 30 s and more"
}

is_munge_up() { munge -S "$run/munge.socket" -n; }

# Slurm's commands block for long where no controller answers.
is_controller_up() { timeout 5 scontrol ping | grep -q 'is UP'; }

is_idle() { [ -n "$(timeout 5 sinfo -h -N -n "$1" -t idle -o %N)" ]; }

# With a key and a socket of its own, as whatever user: the system's munged need not run.
# The folders above the socket must be open to all.
start_munged() {
  [ -s "$state/munge.key" ] || mungekey --create --keyfile="$state/munge.key"
  start_daemon munged munged --foreground --num-threads=2 --key-file="$state/munge.key" \
    --socket="$run/munge.socket" --pid-file="$run/munged.own" --seed-file="$state/munge.seed" \
    --log-file="$logs/munged.log"
  wait_until "munged" is_munge_up
}

start_controller() {
  start_daemon slurmctld slurmctld -D -f "$SLURM_CONF"
  wait_until "the controller" is_controller_up
}

start_node() {
  mkdir -p "$state/node-$1"/{spool,tmp}
  (cd "$state/node-$1" && start_daemon "slurmd-$1" slurmd -D -N "$1" -f "$SLURM_CONF")
}

up() {
  check_installed
  [ ${#run} -le 90 ] || die "too long a path for a socket: $run"
  mkdir -p "$run" "$logs" "$state/controller"
  chmod 755 "$state" "$run"
  [ -s "$SLURM_CONF" ] || write_configuration "$(pick_ports)"
  start_munged
  start_controller
  local node fresh=()
  for node in $(nodes); do
    daemon_pid "slurmd-$node" >/dev/null || fresh+=("$node")
    start_node "$node"
  done
  for node in "${fresh[@]}"; do wait_until "node $node" is_idle "$node"; done
}

# The controller first: it would wait for answers of nodes that are gone.
down() {
  local node
  end_daemon slurmctld
  for node in $(nodes); do kill_node "$node"; done
  end_daemon munged
  rm -rf "$SLURM_CONF" "$state/controller" "$state"/node-n*
}

status() {
  local file name pid
  for file in "$run"/*.pid; do
    name=$(basename "$file" .pid)
    pid=$(daemon_pid "$name") && echo "$name runs, pid $pid"
  done
  timeout 5 sinfo -N -o '%N %t %c CPUs %m MB' || true
}

case "${1:-}" in
  up) up ;;
  down) down ;;
  env) printf 'export SLURM_CONF=%q\n' "$SLURM_CONF" ;;
  node-kill) check_node "${2:-}"; kill_node "$2" ;;
  node-up) check_node "${2:-}"; start_node "$2"; wait_until "node $2" is_idle "$2" ;;
  controller-restart) end_daemon slurmctld; start_controller ;;
  status) status ;;
  *) sed -n '2,10s/^# *//p' "$0"; exit 2 ;;
esac
