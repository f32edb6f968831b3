"""Defines ``facegen farm submit | status | logs | resume | cancel``."""

import re
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.cli.tables import print_table
from facegen.console import counted, say
from facegen.documents import last_lines
from facegen.errors import InputError

if TYPE_CHECKING:
    from facegen.farm import Job
    from facegen.store import Dataset

farm_app = typer.Typer(
    help="Datasets made on many machines, by Slurm or an OpenJD render farm.", no_args_is_help=True
)

Folder = Annotated[Path, typer.Argument(help="Folder of a dataset that was submitted.")]
Json = Annotated[bool, typer.Option("--json", help="As JSON, for programs.")]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Write and print scripts or bundle; submit nothing.")]
Wait = Annotated[
    bool,
    typer.Option("--wait", help="Return when nothing is running; an OpenJD bundle is run on this machine."),
]


@farm_app.command()
def submit(
    spec: Annotated[Path, typer.Argument(help="What to make, for example datasets/default.toml.")],
    out: Annotated[Path, typer.Option("--out", help="Folder of the dataset, on a disk that the farm sees.")],
    engine: Annotated[
        str, typer.Option("--engine", help="Scheduler: slurm, openjd; a wrong name lists all.")
    ],
    samples: Annotated[
        str | None, typer.Option("--samples", help="Pictures of these samples only: 0-99,140.")
    ] = None,
    chunk: Annotated[
        int | None, typer.Option("--chunk", min=1, help="Pictures a task; default 100 or more.")
    ] = None,
    steps: Annotated[
        str, typer.Option("--steps", help="Of generate,validate,pack,train,export.")
    ] = "generate",
    cpus: Annotated[int, typer.Option("--cpus", min=1, help="Processors a task.")] = 1,
    mem: Annotated[str | None, typer.Option("--mem", help="Memory a task, for example 4G.")] = None,
    time: Annotated[
        str | None, typer.Option("--time", help="Longest time of a task, for example 2:00:00.")
    ] = None,
    max_parallel: Annotated[
        int | None, typer.Option("--max-parallel", min=1, help="Tasks at a time.")
    ] = None,
    grace: Annotated[
        float,
        typer.Option(
            "--grace", min=0, help="Seconds to end running work in; Slurm's KillWait may allow less."
        ),
    ] = 30.0,
    maps: Annotated[
        list[str], typer.Option("--map", help="FROM=TO: a folder that has another name on the farm.")
    ] = [],  # noqa: B006  typer makes a new list for each call
    env_setup: Annotated[
        str | None,
        typer.Option("--env-setup", help="Shell command before each task's: module load python/3.11"),
    ] = None,
    python: Annotated[
        str, typer.Option("--python", help="Python with facegen on the farm; default: this one.")
    ] = sys.executable,
    sbatch_args: Annotated[
        list[str], typer.Option("--sbatch-arg", help="Passed on: --sbatch-arg=--partition=cpu")
    ] = [],  # noqa: B006
    packed: Annotated[
        Path | None, typer.Option("--packed", help="Folder for pack; default OUT-packed.")
    ] = None,
    model: Annotated[
        Path | None, typer.Option("--model", help="Folder for train; default OUT-model.")
    ] = None,
    dry_run: DryRun = False,
    wait: Wait = False,
    as_json: Json = False,
) -> None:
    """Submit what a dataset is missing, cut into tasks.

    Example: facegen farm submit datasets/default.toml --out /shared/faces --engine slurm --cpus 8
    """
    from facegen import farm
    from facegen.spec import load_spec
    from facegen.store import check_folder_is_free, resolve

    if engine not in farm.ENGINES:
        raise InputError(f"--engine {engine}: must be one of {', '.join(farm.ENGINES)}")
    dataset = resolve(load_spec(spec), out)
    resources = farm.Resources(
        cpus=cpus,
        mem=mem,
        time=time,
        max_parallel=max_parallel,
        grace_s=grace,
        env_setup=env_setup,
        python=python,
        sbatch_args=tuple(sbatch_args),
        path_map=tuple(farm.parse_path_pair(text) for text in maps),
    )
    chosen = farm.parse_steps(steps)
    check_folder_is_free(dataset)  # the jobs of another dataset say nothing of this one
    request = farm.plan_request(dataset, samples, steps=chosen, dry_run=dry_run)
    left = request.remaining
    if chosen == ("generate",) and not (left.shards or left.samples):
        say("facegen: nothing to submit; all that is asked for is there, has a task, or failed for good")
        print_table({"job": None, "tasks": 0}, as_json=as_json)
        return
    job = farm.prepare(
        dataset,
        left,
        engine=engine,
        steps=chosen,
        samples=samples,
        resources=resources,
        chunk=chunk,
        packed=packed and str(packed),
        model=model and str(model),
        at_work=request.at_work,
    )
    _hand_over(dataset, job, doubts=request.doubts, dry_run=dry_run, wait=wait, as_json=as_json)


@farm_app.command()
def resume(
    dataset: Folder,
    retry_quarantined: Annotated[
        bool, typer.Option("--retry-quarantined", help="Also what failed three times.")
    ] = False,
    chunk: Annotated[int | None, typer.Option("--chunk", min=1, help="Pictures a task.")] = None,
    dry_run: DryRun = False,
    wait: Wait = False,
    as_json: Json = False,
) -> None:
    """Submit again what is missing and no engine is at, as the newest job was submitted.

    Later steps that any job left undone are submitted too, as soon as no engine is at what they need.

    Example: facegen farm resume /shared/faces
    """
    from facegen import farm
    from facegen.store import open_dataset

    opened = open_dataset(dataset)
    resumption = farm.plan_resumption(opened, retry_quarantined=retry_quarantined, dry_run=dry_run)
    if resumption.postponed:
        names = ", ".join(resumption.postponed)
        say(f"facegen: {names} must wait for tasks that are not done; resume again after them")
    if not resumption.steps:
        missing, left = resumption.state.missing, resumption.remaining
        why = "and no job has the step generate" if left.shards or left.samples else "and each has a task"
        say(f"facegen: nothing to submit; {counted(missing, 'thing')} missing{f', {why}' if missing else ''}")
        print_table({"job": None, "tasks": 0}, as_json=as_json)
        return
    job = farm.prepare_resumption(opened, resumption, chunk=chunk)
    retried = resumption.state.quarantined if retry_quarantined else ()
    doubts = resumption.state.doubts
    _hand_over(opened, job, doubts=doubts, retried=retried, dry_run=dry_run, wait=wait, as_json=as_json)


@farm_app.command()
def status(dataset: Folder, as_json: Json = False) -> None:
    """Say how far a dataset is, from what is on disk; engines are asked only what they are doing.

    Exit code 0: all there; 1: some failed for good; 75: work remains.

    Example: facegen farm status /shared/faces --json
    """
    from facegen.store import open_dataset

    raise typer.Exit(_show_state(open_dataset(dataset), as_json=as_json))


@farm_app.command()
def logs(
    dataset: Folder,
    task: Annotated[
        str | None, typer.Argument(help="sample-000123 or shard-000001; without, engine and quarantine.")
    ] = None,
    tail: Annotated[int, typer.Option("--tail", min=1, help="Lines of each file.")] = 20,
) -> None:
    """Print the logs of one task's attempts, or of the engine's tasks and of what failed for good.

    Example: facegen farm logs /shared/faces sample-000123
    """
    from facegen import farm
    from facegen.store import DatasetFolder

    folder = DatasetFolder(dataset)
    if task is not None:
        if re.fullmatch(r"(sample|shard)-[0-9]{6,15}", task) is None:
            raise InputError(
                f"{task!r} is the name of no task; names are like sample-000123 and shard-000001"
            )
        paths = sorted((dataset / "logs").glob(f"[0-9]*/{task}-*.log"))
    else:
        paths = farm.engine_logs(folder) + sorted((dataset / "quarantine").glob("*/*.log"))
    if not paths:
        raise InputError(
            f"{dataset}: has no logs of {task}: no attempt at it was made here, or logs/ was emptied"
            if task
            else f"{dataset}: has no logs: no engine has run a task, and nothing failed for good"
        )
    for path in paths:
        lines = last_lines(path, tail)
        print(f"==> {path} <==")
        print("\n".join(lines))


@farm_app.command()
def cancel(dataset: Folder) -> None:
    """Cancel all of a dataset's jobs; running samples get their grace, what is done stays.

    Example: facegen farm cancel /shared/faces
    """
    from facegen import farm
    from facegen.store import DatasetFolder

    names = farm.cancel(DatasetFolder(dataset))
    print(f"cancelled: {', '.join(names) or 'nothing, no job is running'}")


def _hand_over(
    dataset: "Dataset",
    job: "Job",
    *,
    doubts: list[str],
    retried: tuple[str, ...] = (),
    dry_run: bool,
    wait: bool,
    as_json: bool,
) -> None:
    """Submit a job and print what became of it; after a dry run print what would be submitted."""
    from facegen import farm

    engine = farm.ENGINES[job.engine]
    for note in filter(None, (*doubts, *engine.notes(job), job.memory_note)):
        say(f"facegen: {note}")
    table = {"job": job.name, "folder": str(job.folder), "tasks": len(job.chunks), "steps": list(job.steps)}
    if dry_run:
        if as_json:
            table |= {"files": engine.files(job), "commands": engine.instructions(job)}
            print_table(table, as_json=True)
            return
        for name, text in engine.files(job).items():
            print(f"==> {job.folder / name} <==\n{text}")
        print("\n".join(engine.instructions(job)))
        return
    submission = farm.submit(job, retried=retried)
    if not wait:
        table |= {"ids": submission.ids}
        commands = [] if submission.ids else engine.instructions(job)
        print_table(table | {"commands": commands} if as_json else table, as_json=as_json)
        if not as_json:
            print("\n".join(commands))  # a line each, to be pasted
        return
    engine.wait(job, submission)
    raise typer.Exit(_show_state(dataset, as_json=as_json))


def _show_state(dataset: "Dataset", *, as_json: bool) -> int:
    """Print how far a dataset is; returns the exit code."""
    from facegen import farm

    state = farm.farm_state(dataset)
    table = {
        name: value for name, value in asdict(state).items() if name not in ("busy", "at_work", "unasked")
    }
    if not as_json:
        unknown = {name: "unknown" for name in ("running", "waiting", "seconds_left") if table[name] is None}
        seconds_left = {} if state.seconds_left is None else {"seconds_left": f"{state.seconds_left:.0f}"}
        table |= (
            seconds_left
            | unknown
            | {
                "core_hours": f"{state.core_hours:.3g}",
                "reasons": [f"{reason} ({count})" for reason, count in state.reasons.items()],
                "steps": [f"{step.step} {step.state}" for step in state.steps],
            }
        )
    print_table(table, as_json=as_json)
    return int(state.exit_code)
