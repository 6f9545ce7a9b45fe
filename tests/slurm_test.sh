#!/usr/bin/env bash
# bench/sweep.sbatch on a Slurm of its own: munged, slurmctld and slurmd of this machine, all their files in a folder that goes
# when they do. Usage: slurm_test.sh SEAM (the program). Exit 77: not tried, because Slurm is not installed (Debian: slurmctld slurmd slurm-client munge).
set -euo pipefail
export SEAM=$1
source=$(cd "$(dirname "$0")/.." && pwd)
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || {
    echo "NOT TRIED: no $program here (Debian: apt-get install slurmctld slurmd slurm-client munge)"
    exit 77
  }
done

dir=$(mktemp -d)
pids=()
stop() {
  status=$?
  if [ $status != 0 ]; then tail -n 20 "$dir"/*.log; fi
  if [ ${#pids[@]} != 0 ]; then kill "${pids[@]}" 2>/dev/null || true; fi
  wait || true
  rm -rf "$dir"
}
trap stop EXIT
# Waits until a command succeeds.
await() {
  for _ in $(seq 900); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.2
  done
  echo "not within three minutes: $*"
  return 1
}

chmod 755 "$dir"
mkdir -m 755 "$dir/run" "$dir/state" "$dir/spool"
dd if=/dev/urandom of="$dir/munge.key" bs=64 count=1 status=none
chmod 600 "$dir/munge.key"
munged --foreground --force --socket="$dir/run/munge.socket" --key-file="$dir/munge.key" --pid-file="$dir/run/munged.pid" \
  --seed-file="$dir/munge.seed" --log-file="$dir/munged.log" 2>"$dir/munged.err.log" &
pids+=($!)
await test -S "$dir/run/munge.socket"

port=$((20000 + $$ % 20000 * 2))
export SLURM_CONF=$dir/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=seam
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$dir/run/munge.socket
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldPidFile=$dir/run/slurmctld.pid
SlurmdPidFile=$dir/run/slurmd.pid
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SchedulerParameters=sched_interval=1
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -D >"$dir/ctld.out.log" 2>&1 &
pids+=($!)
slurmd -D >"$dir/slurmd.out.log" 2>&1 &
pids+=($!)
await sh -c 'sinfo -h -o %T | grep -q idle'

sweep=(line --vary speed=0.8:1.2:24 --set settle=0.1 --method dmp2,dmp3)
cd "$dir"
"$SEAM" sweep "${sweep[@]}" --out here.csv

# Cancelled in the middle, then given again.
"$source/bench/sweep.sbatch" 3 slurm.csv "${sweep[@]}"
await sh -c "grep -q ,ok slurm.?-of-3.csv.rows"
scancel --name=seam-sweep
await sh -c '[ -z "$(squeue -h)" ]'
if [ -e slurm.csv ]; then echo "merged in spite of cancelled tasks" && exit 1; fi
SBATCH_FLAGS=--cpus-per-task=2 "$source/bench/sweep.sbatch" 3 slurm.csv "${sweep[@]}"
await test -f slurm.csv
cat slurm.log slurm.?-of-3.log
cmp here.csv slurm.csv
cmp here.csv.json slurm.csv.json
grep -q 'were there already' slurm.?-of-3.log
echo "a job array, cancelled and taken up again, leaves the bytes of one process"
