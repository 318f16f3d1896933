#!/usr/bin/env bash
# corpus_test.sh PROGRAM MAKE_SITE
# Measures a corpus on a cluster of four virtual nodes while tasks are killed and cancelled, a node is
# lost and the controller restarts, and compares with a serial run. Needs Slurm installed, and TMPDIR
# (or /var/tmp) with 1 GB. With CORPUS_TEST_KEEP=1 the folder of a failed run stays.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "$1")
make_site=$(realpath "$2")
time_limit=${CORPUS_TEST_SECONDS:-600}
task_count=24

say() { printf 'corpus_test [%3d s] %s\n' "$((SECONDS - ${started:-0}))" "$*" >&2; }

fail() {
  say "FAILED: $*"
  exit 1
}

expect() {
  local what=$1 expected=$2 found=$3
  if [ "$expected" != "$found" ] && [[ $expected$found = *$'\n'* ]]; then
    fail "$what; expected (<) and found (>):
$(diff <(echo "$expected") <(echo "$found") | head -n 20)"
  fi
  [ "$expected" = "$found" ] || fail "$what: expected '$expected', found '$found'"
  [[ $found != *$'\n'* ]] || found="$(wc -l <<<"$found") lines as expected"
  say "ok: $what: ${found:-nothing}"
}

cluster() { "$here/virtual_slurm.sh" "$@"; }
view() { "$here/job_view.py" "$@"; }

# --- the queue -------------------------------------------------------------------------------

# An empty answer of a controller that is away, or asked too early, is not an empty queue.
wait_for_empty_queue() {
  local deadline=$((SECONDS + 300)) queue='not asked yet'
  while [ "$SECONDS" -lt "$deadline" ]; do
    if queue=$(timeout 5 squeue -h -o '%i %T %R' 2>&1) && [ -z "$queue" ]; then return; fi
    sleep 0.3
  done
  fail "the queue is not empty: $queue"
}

submit() { (cd "$work" && sbatch --parsable "$@"); }

job_field() {
  timeout 5 scontrol -o show job "$1" | tr ' ' '\n' | sed -n "s/^$2=//p"
}

results_of() { find "$1/results" -type f -printf '%P %i %T@ %s\n' | sort; }

# --- the test --------------------------------------------------------------------------------

start_cluster() {
  say "starting the cluster"
  cluster up
  eval "$(cluster env)"
}

make_jobs() {
  say "making the corpus"
  "$here/make_corpus.sh" "$corpus" "$make_site"
  say "planning"
  "$program" corpus plan "$corpus" --out "$job" --tasks "$task_count"
  "$program" corpus plan "$corpus" --out "$serial_job" --tasks "$task_count"
  local slices
  slices=$(grep -v '^#' "$job/manifest.tsv" | cut -f 1 | sort -un | wc -l)
  expect "slices in the manifest" "$task_count" "$slices"
}

start_array() {
  say "submitting"
  array=$(submit "$job/corpus.sbatch")
  gather_id=$(submit --dependency="afterany:$array" --output="$work/gather.log" "$job/gather.sbatch")
}

inject_faults() {
  # Stopped first, so that no fault comes too late.
  view hold "$job" 3 >"$work/held" || fail "no tasks to hit"
  local killed_pid other
  {
    read -r killed killed_pid other
    read -r cancelled other
    read -r lost other lost_node
  } <"$work/held"

  say "SIGKILL to task $killed, scancel of task $cancelled, loss of node $lost_node with task $lost"
  kill -KILL "$killed_pid"
  timeout 20 scancel "${array}_$cancelled"
  cluster node-kill "$lost_node"
  say "the controller restarts"
  cluster controller-restart
}

run_serially() {
  say "meanwhile, in one process: the serial run"
  "$program" corpus run "$serial_job" --jobs 1 >"$work/serial.log" 2>&1 ||
    fail "the serial run exits with $?: $(tail -n 5 "$work/serial.log")"
  "$program" corpus gather "$serial_job" --reports "$serial_reports" >"$work/serial.gather.log" 2>&1 ||
    fail "the serial gather exits with $?: $(tail -n 5 "$work/serial.gather.log")"
  say "the serial run is done"
}

check_retries() {
  local task log
  for task in "$killed" "$lost"; do
    log=$job/logs/${array}_$task.log
    expect "restarts of task $task, to Slurm" 1 "$(job_field "${array}_$task" Restarts)"
    expect "restart counts of task $task, in its log" "0 1" \
      "$(sed -nE 's/.*task.* restarts? ([0-9]+).*/\1/p' "$log" | xargs)"
    expect "state of task $task" COMPLETED "$(job_field "${array}_$task" JobState)"
  done
  expect "state of task $cancelled" CANCELLED "$(job_field "${array}_$cancelled" JobState)"
}

check_missing() {
  local expected code=0 found
  expected=$(view missing "$job")
  [ -n "$expected" ] || fail "nothing is missing, though task $cancelled was cancelled"
  expect "slices of the missing models" "$cancelled" "$(view missing_slices "$job" | xargs)"
  say "missing by the result files: $(wc -l <<<"$expected") models"

  expect "exit code of the gather job" 1:0 "$(job_field "$gather_id" ExitCode)"
  expect "what the gather job names as missing" "$expected" "$(sed -n 's/^missing: //p' "$work/gather.log")"
  "$program" corpus gather "$job" >"$work/gather.out" 2>&1 || code=$?
  expect "exit code of gather" 1 "$code"
  expect "what gather names as missing" "$expected" "$(sed -n 's/^missing: //p' "$work/gather.out")"

  code=0
  "$program" corpus status "$job" >"$work/status.out" || code=$?
  expect "exit code of status" 1 "$code"
  found=$(sed -n 's/^ *\(sbatch --array=.*\)/\1/p' "$work/status.out")
  expect "what status says to submit" "sbatch --array=$cancelled $job/corpus.sbatch" "$found"
}

resubmit() {
  local command
  command=$(sed -n 's/^ *\(sbatch --array=.*\)/\1/p' "$work/status.out")
  say "node $lost_node comes back; $command"
  cluster node-up "$lost_node"
  (cd "$work" && eval "$command") >&2
  wait_for_empty_queue
  "$program" corpus status "$job" >"$work/status.out" || fail "status: exit code $?"
}

check_same() {
  diff -r "$1" "$2" >"$work/difference" ||
    fail "$1 is not that of the serial run: $(head -c 1000 "$work/difference")"
}

check_equal() {
  "$program" corpus gather "$job" --reports "$reports" >"$work/gather.out" 2>&1 ||
    fail "gather exits with $?: $(tail -n 5 "$work/gather.out")"
  check_same "$job/corpus.csv" "$serial_job/corpus.csv"
  check_same "$job/corpus.jsonl" "$serial_job/corpus.jsonl"
  check_same "$reports" "$serial_reports"
  say "ok: tables and $(find "$reports" -type f | wc -l) reports are those of the serial run"

  view check "$job" "$corpus" "$reports" >&2 || fail "results, tables and reports disagree"
  local id
  for id in 4 8 12; do
    "$make_site" --check "$reports/RWT$id/site.obj.json" "$corpus/RWT$id/site.answers.json" \
      >"$work/answers.log" 2>&1 || fail "the report of RWT$id is wrong: $(head -n 3 "$work/answers.log")"
  done
}

# But of equal models, which two tasks may measure at once.
check_kept() {
  local what=$1 gone
  gone=$(comm -23 "$2" <(results_of "$job") | grep -vFf <(cut -f 5 "$job/manifest.tsv" | sort | uniq -d) || true)
  expect "results written again $what" "" "$gone"
}

check_scratch() {
  expect "what is left in the scratch folder" "" "$(find "$TMPDIR" -mindepth 1 | head)"
}

check_rerun() {
  say "the whole array again"
  results_of "$job" >"$work/finished"
  submit "$job/corpus.sbatch" >/dev/null
  wait_for_empty_queue
  expect "results after it, unchanged" "$(cat "$work/finished")" "$(results_of "$job")"
}

check_changed_input() {
  local changed=RWT2/site.obj code=0 old_digest
  old_digest=$(awk -F '\t' -v path="$changed" '$6 == path { print $5 }' "$job/manifest.tsv")
  say "one model changes, another only its date"
  printf '# changed\n' >>"$corpus/$changed"
  touch "$corpus/RWT3/site.obj"
  "$program" corpus plan "$corpus" --out "$job" --tasks "$task_count"
  expect "missing by the result files" "$changed" "$(view missing "$job")"
  "$program" corpus status "$job" >"$work/status.out" || code=$?
  expect "exit code of status" 1 "$code"
  "$program" corpus run "$job" >"$work/run.log" 2>&1 || fail "run: $(tail -n 5 "$work/run.log")"
  check_kept "though unchanged" <(grep -vF "$old_digest" "$work/finished")
  expect "missing after the run" "" "$(view missing "$job")"
  expect "results that are new" 1 "$(comm -13 "$work/finished" <(results_of "$job") | wc -l)"
  "$program" corpus gather "$job" >"$work/gather.out" 2>&1 || fail "gather: exit code $?"
}

test_corpus() {
  start_cluster
  make_jobs
  start_array
  inject_faults
  results_of "$job" >"$work/before_faults"
  run_serially
  say "waiting until the lost node is noticed and the queue is empty"
  wait_for_empty_queue
  check_retries
  check_missing
  resubmit
  check_equal
  check_kept "after the faults" "$work/before_faults"
  check_rerun
  check_changed_input
  check_scratch
  say "passed"
}

# --- around it -------------------------------------------------------------------------------

show_logs() {
  local log
  for log in "$work"/*.log "$VIRTUAL_SLURM_DIR"/log/slurmctld.log $(ls -t "$job"/logs/* 2>/dev/null | head -n 6); do
    [ -s "$log" ] || continue
    printf '== %s\n' "$log"
    tail -n 8 "$log" | cut -c 1-300
  done >&2
}

clean_up() {
  local code=$?
  trap '' EXIT INT TERM HUP
  kill "$inner" 2>/dev/null || true
  wait "$inner" || true
  [ "$code" -eq 0 ] || show_logs
  say "taking the cluster down"
  cluster down || code=1
  if [ "$code" -ne 0 ] && [ -n "${CORPUS_TEST_KEEP:-}" ]; then
    say "kept: $work"
  else
    rm -rf "$work"
  fi
  exit "$code"
}

# The test is a process of its own under a limit of time, so that whatever becomes of it the cluster
# is taken down.
supervise() {
  started=$SECONDS inner=''
  work=$(mktemp -d -p "${TMPDIR:-/var/tmp}" corpus_test.XXXXXX)
  chmod 755 "$work"  # munged wants its socket to be reachable for all
  export work started CORPUS_TEST_INNER=1
  name_folders
  trap clean_up EXIT
  trap 'exit 143' INT TERM HUP
  local code=0
  timeout --kill-after=5 "$time_limit" "$0" "$program" "$make_site" &
  inner=$!
  wait "$inner" || code=$?
  [ "$code" -ne 124 ] || say "FAILED: not done within $time_limit s"
  exit "$code"
}

name_folders() {
  corpus="$work/corpus of scans"
  job=$work/job
  serial_job=$work/serial_job
  reports=$work/reports
  serial_reports=$work/serial_reports
  export VIRTUAL_SLURM_DIR=$work/slurm
}

if [ -z "${CORPUS_TEST_INNER:-}" ]; then
  supervise
else
  name_folders
  export TMPDIR=$work/scratch PATH=${program%/*}:$PATH
  mkdir "$TMPDIR"
  test_corpus
fi
