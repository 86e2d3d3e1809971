#!/bin/sh
#SBATCH --job-name=mceip-parts --array=1-4 --cpus-per-task=1 --time=60 --signal=INT@120 --requeue --open-mode=append
# A part of a complete search. Two minutes before its time is up the step gets SIGINT: it writes what it has proved and
# exits 130. The task then queues again and goes on with its own file, so that it ends well only when its part is done.
part="part-$SLURM_ARRAY_TASK_ID.json"
set --
[ -s "$part" ] && set -- --resume "$part"
srun mceip complete problem.json --pieces 64 --threads 1 --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" "$@" --certificate "$part" > /dev/null
code=$?
case $code in
    0 | 3) exit 0 ;; # 3: the pieces of the other parts stay open
    130) [ "${SLURM_RESTART_COUNT:-0}" -lt "${MCEIP_RESTARTS:-20}" ] && exec scontrol requeue "$SLURM_JOB_ID" ;;
esac
exit $code
