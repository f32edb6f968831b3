"""Submits a job to Slurm: an array job for the samples, one job for each later step.

Needs the client commands only: no accounting, no rights to slurm.conf, no shared files but the dataset's.
"""

import re
import shlex
import subprocess
import time
from collections import Counter
from pathlib import Path

from facegen.errors import FacegenError, InputError, Unanswered
from facegen.farm.commands import chunk_lines, generate_command, later_command, rigs_line
from facegen.farm.engine import Activity
from facegen.farm.job import Job, Submission
from facegen.farm.sbatch_arguments import check_arguments, is_need
from facegen.farm.shell import check_setup, check_shell

NOTICE_S = 60
"""Slurm looks at time limits every 30 s and documents its notice as up to 60 s early or late."""

TRIES = 3
"""Runs of a crashed supervisor inside one task; then it fails, and `farm resume` submits what is missing."""

MAX_RESTARTS = 20
"""A task that comes near its time limit requeues itself so often."""

_ASK_TIMEOUT_S = 60

_NUMBER = re.compile(r"([0-9]{1,20})(;.*)?")
"""What ``sbatch --parsable`` answers; sites let it say more before."""

_AT_WORK = ("RUNNING", "COMPLETING", "CONFIGURING")
"""States in which squeue lists a task that has its processors; all others wait for some."""

_SCRIPT = """\
#!/bin/bash
{directives}

# What is done is skipped, so every step may run twice, or again.
# USR1: the time limit is near; drain, then come back. TERM: scancel, preemption or the limit itself; drain
# and leave the rest to Slurm (a job that requeued itself on TERM would outlive its scancel).
stop=0 again=0 pid=
trap 'stop=1 again=1; [ -z "$pid" ] || kill -TERM "$pid" 2>/dev/null' USR1
trap 'stop=1 again=0; [ -z "$pid" ] || kill -TERM "$pid" 2>/dev/null' TERM INT
export PYTHONUNBUFFERED=1
{rigs}{setup}{prepare}rc=75
for attempt in {attempts}; do
  [ "$stop" = 0 ] || break
  {command} &
  pid=$!
  [ "$stop" = 0 ] || kill -TERM "$pid"
  while :; do rc=0; wait "$pid" || rc=$?; kill -0 "$pid" 2>/dev/null || break; done
  pid=
  case $rc in 0|1|2|74|75|143) break ;; esac
  echo "attempt $attempt of {tries} ended with $rc" >&2  # killed, most often for its memory
done
[ "$rc" = 143 ] && rc=75  # stopped before it had begun
if [ "$again" = 1 ] && [ "$rc" = 75 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {restarts} ]; then
  scontrol requeue "$SLURM_JOB_ID" && sleep 60  # Slurm ends this script here
fi
{finish}exit "$rc"
"""

_PICK_CHUNK = """\
what=$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" {chunks})
[ -n "$what" ] || {{ echo "no chunk $SLURM_ARRAY_TASK_ID" >&2; exit 2; }}
"""


def sbatch_script(job: Job, step: str) -> str:
    """Write the batch script of a step.

    Parameters
    ----------
    job
        The job; its paths appear as the farm's machines see them.
    step
        One of ``job.steps``.

    Raises
    ------
    InputError
        If a setup is none, or an argument for sbatch hides the tasks.
    """
    resources, on_farm = job.resources, job.resources.on_farm
    check_setup(resources)
    check_arguments(resources.sbatch_args)
    folder, out = on_farm(job.folder), on_farm(job.out)
    if step == "generate":
        command = shlex.join(generate_command(job, spec=f"{out}/spec.toml", out=out, what=())) + " $what"
        prepare = _PICK_CHUNK.format(chunks=shlex.quote(f"{folder}/chunks.txt"))
    else:
        packed, model = on_farm(job.packed), on_farm(job.model)
        command, prepare = shlex.join(later_command(job, step, out=out, packed=packed, model=model)), ""
    done = shlex.quote(f"{folder}/{step}.done")
    finish = "" if step == "generate" else f'[ "$rc" = 0 ] && : > {done}\n'
    return _SCRIPT.format(
        directives="\n".join(f"#SBATCH {directive}" for directive in _directives(job, step, folder)),
        rigs=rigs_line(job),
        setup=f"{resources.env_setup}\n" if resources.env_setup else "",
        prepare=prepare,
        command=command,
        attempts=" ".join(map(str, range(1, TRIES + 1))),
        tries=TRIES,
        restarts=MAX_RESTARTS,
        finish=finish,
    )


def _directives(job: Job, step: str, folder: str) -> list[str]:
    resources = job.resources
    lines = [f"--job-name={_job_name(job, step)}"]
    if step == "generate":
        throttle = f"%{resources.max_parallel}" if resources.max_parallel else ""
        lines.append(f"--array=0-{len(job.chunks) - 1}{throttle}")
    lines += ["--nodes=1", "--ntasks=1", f"--cpus-per-task={resources.cpus}"]
    lines += [f"--mem={resources.mem}"] if resources.mem else []
    lines += [f"--time={resources.time}"] if resources.time else []
    log = f"{folder}/logs/{step}{'-%a' if step == 'generate' else ''}.out"
    if '"' in folder or "\\" in folder:
        raise InputError(f"{folder!r}: Slurm's scripts cannot name a folder with a quote or a backslash")
    if resources.time_s is not None and resources.time_s <= resources.grace_s + NOTICE_S:
        raise InputError(
            f"--time {resources.time} ({resources.time_s:g} s): Slurm says {NOTICE_S} s before the grace of "
            f"{resources.grace_s:g} s that a task must end, so it would end at once; raise --time or lower --grace"
        )
    lines += ["--requeue", "--open-mode=append", f"--signal=B:USR1@{round(resources.grace_s) + NOTICE_S}"]
    return [*lines, f'--output="{_percent(folder)}{log[len(folder) :]}"']


def _job_name(job: Job, step: str) -> str:
    return f"facegen-{job.name}-{step}"


def _percent(path: str) -> str:
    return path.replace("%", "%%")


class Slurm:
    """A cluster that is reached by ``sbatch``, ``squeue`` and ``scancel``."""

    def files(self, job: Job) -> dict[str, str]:
        """One script a step, and the chunks' list."""
        scripts = {
            f"{step}.sh": sbatch_script(job, step) for step in job.steps if step != "generate" or job.chunks
        }
        return ({"chunks.txt": chunk_lines(job.chunks)} if job.chunks else {}) | scripts

    def check(self, folder: Path) -> None:
        """Let bash read every script."""
        for path in sorted(folder.glob("*.sh")):
            check_shell(path.read_text(encoding="utf-8"), what=f"the script of the step {path.stem!r}")

    def notes(self, job: Job) -> list[str]:
        """Say where a stopped task has less time than its grace."""
        try:
            told = re.search(r"^KillWait\s*=\s*(\d+)", _run(["scontrol", "show", "config"]), re.MULTILINE)
        except FacegenError:
            return []
        if told is None or job.resources.grace_s <= int(told[1]):
            return []
        return [
            f"--grace {job.resources.grace_s:g}: this Slurm kills {told[1]} s after it asked a task to end (KillWait); "
            "one that is cancelled, preempted or at its limit has no more, and --grace holds before --time alone"
        ]

    def instructions(self, job: Job) -> list[str]:
        """Write the sbatch commands, with names for the numbers that Slurm will give."""
        commands, before = [], None
        for step in self._steps(job):
            words = self._sbatch(job, step, f"${before}" if before else None)
            # a shell is to put the number there, which a quoted word would keep from it
            command = " ".join(word if word == _need(f"${before}") else shlex.quote(word) for word in words)
            commands.append(f"{step}=$({command})")
            before = step
        return commands

    def submit(self, job: Job) -> Submission:
        """Submit all steps, each to run after the one before has succeeded.

        Raises
        ------
        InputError
            If Slurm refuses; what was submitted before is cancelled.
        Unanswered
            If Slurm gives no answer in time; it may have taken the step.
        """
        ids: dict[str, str] = {}
        before = None
        try:
            for step in self._steps(job):
                before = _number(_run(self._sbatch(job, step, before)))
                ids[step] = before
        except FacegenError:
            if ids:
                _run(["scancel", *ids.values()])
            raise
        return Submission(ids=ids)

    def wait(self, job: Job, submission: Submission) -> None:
        """Ask until Slurm says that it has nothing of the job; one that is held is waited for, until Ctrl-C."""
        while True:
            activity = self.activity(job, submission)
            if activity is not None and not activity.anything:
                return
            time.sleep(2.0)

    def activity(self, job: Job, submission: Submission) -> Activity | None:
        """Read what squeue lists; jobs that have ended are not in it."""
        # by names, as a colleague may have submitted it; other folders' jobs have the same, and other numbers
        names = ",".join(_job_name(job, step) for step in submission.ids)
        command = ["squeue", "-h", "-r", f"--name={names}", "-o", "%F|%K|%T|%r"]
        try:
            listing = _run(command)
        except FacegenError:
            return None
        return read_squeue(listing, submission)

    def cancel(self, job: Job, submission: Submission) -> None:
        """``scancel``: running tasks drain, and do not come back."""
        if submission.ids:
            _run(["scancel", *submission.ids.values()])

    def _steps(self, job: Job) -> list[str]:
        return [step for step in job.steps if step != "generate" or job.chunks]

    def _sbatch(self, job: Job, step: str, before: str | None) -> list[str]:
        # sbatch goes by the last of two: what the user's job is to wait for holds for its first step, and so for all
        given = [each for each in job.resources.sbatch_args if not (before and is_need(each))]
        after = [_need(before)] if before else []
        # without --kill-on-invalid-dep a step whose need has failed waits for ever
        return [
            *("sbatch", "--parsable", *after, "--kill-on-invalid-dep=yes", *given),
            str(job.folder / f"{step}.sh"),
        ]


def _need(number: str) -> str:
    return f"--dependency=afterok:{number}"


def _number(answer: str) -> str:
    """The job's number in what sbatch said."""
    numbers = [match[1] for line in answer.splitlines() if (match := _NUMBER.fullmatch(line.strip()))]
    if not numbers:
        raise Unanswered(f"sbatch: gave no job's number, but {answer.strip()[:200]!r}")
    return numbers[-1]


def read_squeue(listing: str, submission: Submission) -> Activity:
    """Read what squeue says of a submission, as ``%F|%K|%T|%r``: array or job number, index, state, reason."""
    steps = {number: step for step, number in submission.ids.items()}
    running, waiting, later_steps, reasons = set(), set(), {}, Counter()
    for line in listing.splitlines():
        number, *details = line.split("|", 3)
        # of another folder, or what a site lets squeue say besides
        if number not in steps or len(details) != 3:
            continue
        index, state, reason = details
        if re.fullmatch(r"\d+", index):
            (running if state in _AT_WORK else waiting).add(int(index))
        else:
            later_steps[steps[number]] = state.lower()
        if state == "PENDING":
            reasons[reason] += 1
    return Activity(
        running=frozenset(running), waiting=frozenset(waiting), steps=later_steps, reasons=reasons
    )


def _run(command: list[str]) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_ASK_TIMEOUT_S, cwd=Path("/"))
    except FileNotFoundError:
        raise InputError(
            f"{command[0]}: there is no such command here; submit where Slurm's client commands are, "
            "or look at the scripts with --dry-run"
        ) from None
    except subprocess.TimeoutExpired:
        raise Unanswered(
            f"{command[0]}: no answer within {_ASK_TIMEOUT_S} s (is the controller up?)"
        ) from None
    if done.returncode:
        raise InputError(f"{command[0]} refused: {done.stderr.strip() or f'exit code {done.returncode}'}")
    return done.stdout
