#!/bin/bash
#SBATCH --job-name=facegen-job-003-export
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=2:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@90
#SBATCH --output="/cluster/shared/faces/farm/job-003/logs/export.out"

# What is done is skipped, so every step may run twice, or again.
# USR1: the time limit is near; drain, then come back. TERM: scancel, preemption or the limit itself; drain
# and leave the rest to Slurm (a job that requeued itself on TERM would outlive its scancel).
stop=0 again=0 pid=
trap 'stop=1 again=1; [ -z "$pid" ] || kill -TERM "$pid" 2>/dev/null' USR1
trap 'stop=1 again=0; [ -z "$pid" ] || kill -TERM "$pid" 2>/dev/null' TERM INT
export PYTHONUNBUFFERED=1
module load python/3.11
rc=75
for attempt in 1 2 3; do
  [ "$stop" = 0 ] || break
  /cluster/shared/env/bin/python -m regress export /cluster/shared/faces-model --out /cluster/shared/faces-model/exports &
  pid=$!
  [ "$stop" = 0 ] || kill -TERM "$pid"
  while :; do rc=0; wait "$pid" || rc=$?; kill -0 "$pid" 2>/dev/null || break; done
  pid=
  case $rc in 0|1|2|74|75|143) break ;; esac
  echo "attempt $attempt of 3 ended with $rc" >&2  # killed, most often for its memory
done
[ "$rc" = 143 ] && rc=75  # stopped before it had begun
if [ "$again" = 1 ] && [ "$rc" = 75 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 20 ]; then
  scontrol requeue "$SLURM_JOB_ID" && sleep 60  # Slurm ends this script here
fi
[ "$rc" = 0 ] && : > /cluster/shared/faces/farm/job-003/export.done
exit "$rc"
