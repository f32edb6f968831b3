"""``facegen farm submit | status | logs | resume | cancel``."""

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from facegen.conventions import ExitCode
from facegen.errors import InputError

farm_app = typer.Typer(
    help="Datasets made on many machines, by Slurm or an OpenJD render farm.", no_args_is_help=True
)

Dataset = Annotated[Path, typer.Argument(help="Folder of a dataset that was submitted.")]
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
    engine: Annotated[str, typer.Option("--engine", help="slurm or openjd.")],
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
    grace: Annotated[float, typer.Option("--grace", min=0, help="Seconds to end running work in.")] = 30.0,
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
    from facegen.store import resolve

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
        path_map=tuple(_pair(text) for text in maps),
    )
    _check(resources)
    job = farm.prepare(
        dataset,
        farm.remaining(dataset, samples),
        engine=engine,
        steps=_steps(steps),
        samples=samples,
        resources=resources,
        chunk=chunk,
        packed=packed and str(packed),
        model=model and str(model),
    )
    _hand_over(dataset, job, dry_run=dry_run, wait=wait, as_json=as_json)


@farm_app.command()
def resume(
    dataset: Dataset,
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
    import shutil

    from facegen import farm
    from facegen.store import open_dataset

    opened = open_dataset(dataset)
    jobs = _jobs(opened)
    last = jobs[-1]
    state = farm.farm_state(opened)
    what = farm.remaining(
        opened, last.samples, shards=last.shards, busy=state.busy, retry_quarantined=retry_quarantined
    )
    by_name = {job.name: job for job in jobs}
    to_do = {step.step: by_name[step.job] for step in state.steps if step.state == "to do"}
    if to_do and state.busy:
        say(f"facegen: {', '.join(to_do)} must wait for tasks that are not done; resume again after them")
        to_do = {}
    if (what.shards or what.samples) and any("generate" in job.steps for job in jobs):
        to_do["generate"] = last
    steps = tuple(step for step in farm.STEPS if step in to_do)
    if not steps:
        say(f"facegen: nothing to submit; {state.missing} things are missing and all have tasks")
        _print({"job": None, "tasks": 0}, as_json=as_json)
        return
    if retry_quarantined and not dry_run:
        for name in state.quarantined:
            shutil.rmtree(opened.folder.quarantine(name), ignore_errors=True)
    job = farm.prepare(
        opened,
        what,
        engine=last.engine,
        steps=steps,
        samples=last.samples,
        shards=last.shards,
        resources=last.resources,
        chunk=chunk,
        packed=to_do.get("pack", last).packed,
        model=to_do.get("train", to_do.get("export", last)).model,
    )
    _hand_over(opened, job, dry_run=dry_run, wait=wait, as_json=as_json)


@farm_app.command()
def status(dataset: Dataset, as_json: Json = False) -> None:
    """Say how far a dataset is, from what is on disk; engines are asked only what they are doing.

    Exit code 0: all there; 1: some failed for good; 75: work remains.

    Example: facegen farm status /shared/faces --json
    """
    from facegen.store import open_dataset

    raise typer.Exit(_show_state(open_dataset(dataset), as_json=as_json))


@farm_app.command()
def logs(
    dataset: Dataset,
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
        paths = sorted((dataset / "logs").glob(f"[0-9]*/{task}-*.log"))
    else:
        paths = farm.engine_logs(folder) + sorted((dataset / "quarantine").glob("*/*.log"))
    if not paths:
        raise InputError(
            f"{dataset}: has no logs{f' of {task}' if task else ''} (names are like sample-000123)"
        )
    for path in paths:
        lines = path.read_text(errors="replace").splitlines()
        print(f"==> {path} <==")
        print("\n".join(lines[-tail:]))


@farm_app.command()
def cancel(dataset: Dataset) -> None:
    """Cancel all of a dataset's jobs; running samples get their grace, what is done stays.

    Example: facegen farm cancel /shared/faces
    """
    from facegen import farm
    from facegen.store import DatasetFolder

    names = farm.cancel(DatasetFolder(dataset))
    print(f"cancelled: {', '.join(names) or 'nothing, no job is running'}")


def _hand_over(dataset: object, job: object, *, dry_run: bool, wait: bool, as_json: bool) -> None:
    from facegen import farm

    engine = farm.ENGINES[job.engine]
    told = {"job": job.name, "folder": str(job.folder), "tasks": len(job.chunks), "steps": list(job.steps)}
    if dry_run:
        if as_json:
            _print(told | {"files": engine.files(job), "commands": engine.instructions(job)}, as_json=True)
            return
        for name, text in engine.files(job).items():
            print(f"==> {job.folder / name} <==\n{text}")
        print("\n".join(engine.instructions(job)))
        return
    submission = farm.submit(job)
    if not wait:
        _print(
            told | {"ids": submission.ids, "commands": [] if submission.ids else engine.instructions(job)},
            as_json=as_json,
        )
        return
    engine.wait(job, submission)
    raise typer.Exit(_show_state(dataset, as_json=as_json))


def _show_state(dataset: object, *, as_json: bool) -> int:
    from facegen import farm

    state = farm.farm_state(dataset)
    table = {name: value for name, value in asdict(state).items() if name != "busy"}
    if as_json:
        print(json.dumps(table))
    else:
        table |= {
            "quarantined": ", ".join(state.quarantined) or "none",
            "core_hours": f"{state.core_hours:.3g}",
        }
        table["reasons"] = (
            ", ".join(f"{reason} ({count})" for reason, count in state.reasons.items()) or "none"
        )
        table["steps"] = ", ".join(f"{step.step} {step.state}" for step in state.steps) or "none"
        table["seconds_left"] = "unknown" if state.seconds_left is None else f"{state.seconds_left:.0f}"
        for name in ("running", "waiting"):
            table[name] = "unknown" if table[name] is None else table[name]
        _print(table, as_json=False)
    if state.missing:
        return int(ExitCode.DRAINED)
    return int(ExitCode.INVALID if state.quarantined else ExitCode.OK)


def _jobs(dataset: object) -> list:
    from facegen import farm

    jobs = farm.asked_jobs(dataset.folder)
    if not jobs:
        raise InputError(
            f"{dataset.folder.path}: was never submitted to a farm; begin with: facegen farm submit"
        )
    return jobs


def _pair(text: str) -> tuple[str, str]:
    source, equals, target = text.partition("=")
    if not (source.startswith("/") and equals and target.startswith("/")):
        raise InputError(f"--map {text!r}: write FROM=TO, both beginning with a slash")
    return source, target


def _steps(text: str) -> tuple[str, ...]:
    from facegen.farm import STEPS

    asked = [step.strip() for step in text.split(",") if step.strip()]
    unknown = [step for step in asked if step not in STEPS]
    if unknown or not asked:
        raise InputError(
            f"--steps {text!r}: {unknown[0] if unknown else 'nothing'} is none of {', '.join(STEPS)}"
        )
    return tuple(step for step in STEPS if step in asked)


def _check(resources: object) -> None:
    """Refuse what cannot be read before anything is written."""
    if resources.time_s is not None and resources.time_s < 60:
        raise InputError(f"--time {resources.time}: is less than a minute")
    _ = resources.mem_mib


def _print(table: dict, *, as_json: bool) -> None:
    if as_json:
        print(json.dumps(table))
        return
    for key, value in table.items():
        text = ", ".join(map(str, value)) if isinstance(value, list) else value
        text = (
            ", ".join(f"{name} {number}" for name, number in value.items())
            if isinstance(value, dict)
            else text
        )
        print(f"{key.replace('_', ' ')}: {text if text not in ('', None) else 'none'}")
