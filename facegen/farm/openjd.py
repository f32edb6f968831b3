"""Writes a job as an OpenJD bundle, for `openjd run` and for AWS Deadline Cloud and other farms.

The bundle is JSON, which the specification allows beside YAML and needs no further library.
"""

import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from facegen.errors import InputError, Unanswered
from facegen.farm.commands import generate_command, later_command, rigs_line
from facegen.farm.engine import Activity
from facegen.farm.job import Job, Submission
from facegen.farm.shell import check_setup
from facegen.spec import format_ranges, sample_numbers

NOTIFY_S = 10
"""Added to the grace: the time to end what a drain waited for."""

_MOST_NOTIFY_S = 600
"""Of that sum, by the specification."""

RETRIES = 5
"""Tries of a failed task on Deadline Cloud; a drained worker's exit code 75 counts as a failure there."""

LONGEST_NAME = 128
"""Characters of a job's name that OpenJD allows."""

_CHECK_TIMEOUT_S = 60

_PICTURES, _KEYPOINTS = "Pictures", "Keypoints"

_LAUNCH = 'exec "$@"\n'
"""A cancel's SIGTERM goes to the first process only, which therefore becomes the worker."""

_LAUNCH_AND_SAY = """\
done=$1; shift
"$@" &
pid=$!
trap 'kill -TERM "$pid"' TERM
while :; do rc=0; wait "$pid" || rc=$?; kill -0 "$pid" 2>/dev/null || break; done
[ "$rc" = 0 ] && mkdir -p "${done%/*}" && : > "$done"
exit "$rc"
"""
"""The same where something follows: a SIGTERM ends the wait, and is handed on."""


def job_template(job: Job) -> dict[str, Any]:
    """Make the job template of a job, ``jobtemplate-2023-09``."""
    parameters, steps, before = _parameters(job), [], []
    if "generate" in job.steps:
        for name, kind in ((_KEYPOINTS, "shards"), (_PICTURES, "samples")):
            if any(getattr(chunk, kind) for chunk in job.chunks):
                steps.append(_chunked_step(job, name, kind))
                before.append(name)
    for step in job.steps:
        if step != "generate":
            name = step.capitalize()
            steps.append(_later_step(job, step, name, needs=before))
            # all earlier ones: where files travel with jobs, a step receives what the steps it names made
            before = [*before, name]
    return {
        "specificationVersion": "jobtemplate-2023-09",
        "extensions": ["TASK_CHUNKING"],
        "name": _job_name(job),
        "description": "Makes a dataset; what is there is skipped, so every task may run twice, or again.",
        "parameterDefinitions": parameters,
        "steps": steps,
    }


def _job_name(job: Job) -> str:
    """Name of at most `LONGEST_NAME` characters; a folder's braces would be read as a parameter's."""
    folder = Path(job.out).name.replace("{{", "((").replace("}}", "))")
    room = LONGEST_NAME - len(f"facegen  {job.name}")
    return f"facegen {folder if len(folder) <= room else folder[: room - 1] + '…'} {job.name}"


def parameter_values(job: Job) -> dict[str, Any]:
    """Values of the template's parameters that have no default."""
    on_farm = job.resources.on_farm
    values: dict[str, Any] = {"OutDir": job.out}
    if "pack" in job.steps:
        values["PackedDir"] = job.packed
    if {"train", "export"} & set(job.steps):
        values["ModelDir"] = job.model
    return values | {"Python": on_farm(job.resources.python)}


def deadline_values(job: Job) -> dict[str, Any]:
    """``parameter_values.json`` of a Deadline Cloud job bundle."""
    values = parameter_values(job) | {"deadline:maxRetriesPerTask": RETRIES}
    if job.resources.max_parallel:
        values["deadline:maxWorkerCount"] = job.resources.max_parallel
    return {"parameterValues": [{"name": name, "value": value} for name, value in values.items()]}


def path_mapping(job: Job) -> dict[str, Any]:
    """Rules for ``openjd run --path-mapping-rules``; a farm makes its own."""
    return {
        "version": "pathmapping-1.0",
        "path_mapping_rules": [
            {"source_path_format": "POSIX", "source_path": source, "destination_path": target}
            for source, target in job.resources.path_map
        ],
    }


def _parameters(job: Job) -> list[dict[str, Any]]:
    def parameter(name: str, kind: str, description: str, **details: object) -> dict[str, Any]:
        return {"name": name, "type": kind, **details, "description": description}

    def folder(name: str, flow: str, description: str) -> dict[str, Any]:
        return parameter(name, "PATH", description, objectType="DIRECTORY", dataFlow=flow)

    spec = {"objectType": "FILE", "dataFlow": "IN", "default": "spec.toml"}
    parameters = [
        parameter("SpecFile", "PATH", "The spec, in this bundle", **spec),
        folder("OutDir", "INOUT", "The dataset"),
    ]
    if "pack" in job.steps:
        parameters.append(folder("PackedDir", "OUT", "Packed shards"))
    if {"train", "export"} & set(job.steps):
        parameters.append(folder("ModelDir", "INOUT", "The model"))
    parameters.append(parameter("Python", "STRING", "Python with facegen, on the workers"))
    sizes = [len(_numbers(chunk.samples)) for chunk in job.chunks if chunk.samples]
    if sizes:
        seconds = "Let the scheduler adapt the chunks to this time; 0 keeps ChunkSize"
        parameters += [
            {"name": "ChunkSize", "type": "INT", "minValue": 1, "default": max(sizes)},
            parameter("ChunkSeconds", "INT", seconds, minValue=0, default=0),
        ]
    return parameters


def _numbers(ranges: str) -> list[int]:
    return sample_numbers(ranges, total=sys.maxsize, where="chunk")


def _chunked_step(job: Job, name: str, kind: str) -> dict[str, Any]:
    """Make the step of all chunks of a kind, ``"shards"`` or ``"samples"``."""
    arguments: tuple[str, ...] = (f"--{kind}", "{{Task.Param.Ids}}")
    sizes: dict[str, Any] = {"defaultTaskCount": 1}
    if kind == "samples":
        arguments += ("--shards", "none")
        sizes = {
            "defaultTaskCount": "{{Param.ChunkSize}}",
            "targetRuntimeSeconds": "{{Param.ChunkSeconds}}",
        }
    command = generate_command(job, spec="{{Param.SpecFile}}", out="{{Param.OutDir}}", what=arguments)
    ranges = ",".join(filter(None, (getattr(chunk, kind) for chunk in job.chunks)))
    numbers = {
        "name": "Ids",
        "type": "CHUNK[INT]",
        "range": format_ranges(_numbers(ranges)),
        "chunks": sizes | {"rangeConstraint": "NONCONTIGUOUS"},
    }
    return {
        "name": name,
        "parameterSpace": {"taskParameterDefinitions": [numbers]},
        "hostRequirements": _host(job),
        "script": _script(job, [*command, "--progress", "openjd"]),
    }


def _later_step(job: Job, step: str, name: str, *, needs: list[str]) -> dict[str, Any]:
    command = later_command(
        job, step, out="{{Param.OutDir}}", packed="{{Param.PackedDir}}", model="{{Param.ModelDir}}"
    )
    done = f"{{{{Param.OutDir}}}}/farm/{job.name}/{step}.done"
    template = {"name": name, "hostRequirements": _host(job), "script": _script(job, command, done=done)}
    return template | ({"dependencies": [{"dependsOn": need} for need in needs]} if needs else {})


def _host(job: Job) -> dict[str, Any]:
    amounts = [{"name": "amount.worker.vcpu", "min": job.resources.cpus}]
    if job.resources.mem_mib is not None:
        amounts.append({"name": "amount.worker.memory", "min": job.resources.mem_mib})
    return {"amounts": amounts, "attributes": [{"name": "attr.worker.os.family", "anyOf": ["linux"]}]}


def _script(job: Job, command: list[str], *, done: str | None = None) -> dict[str, Any]:
    """What a task runs; ``done`` is a file that says of a step that it has ended well."""
    resources = job.resources
    command = ["{{Param.Python}}", *command[1:]]
    action: dict[str, Any] = {
        "cancelation": {
            "mode": "NOTIFY_THEN_TERMINATE",
            "notifyPeriodInSeconds": min(_MOST_NOTIFY_S, round(resources.grace_s) + NOTIFY_S),
        }
    }
    if resources.time_s is not None:
        action["timeout"] = resources.time_s
    files, setup = [], "" if "{{" in job.rigs else rigs_line(job)
    if resources.env_setup is not None:
        check_setup(resources)
        if "{{" in resources.env_setup:
            raise InputError(
                "--env-setup: OpenJD would read '{{' as the start of a parameter; put it into a script"
            )
        setup += f"{resources.env_setup}\n"
    if setup or done is not None:
        text = setup + (_LAUNCH if done is None else _LAUNCH_AND_SAY)
        files = [{"name": "launch", "type": "TEXT", "filename": "launch.sh", "data": text}]
        command = ["bash", "{{Task.File.launch}}", *([] if done is None else [done]), *command]
    action = {"command": command[0], "args": command[1:], **action}
    return {"actions": {"onRun": action}} | ({"embeddedFiles": files} if files else {})


class OpenJD:
    """A job bundle; run here one task after another with ``openjd run``, or submitted to a farm."""

    def files(self, job: Job) -> dict[str, str]:
        """Write the bundle, and parameters and path mapping for ``openjd run``, which reads no bundles."""
        described = {
            "bundle/template.json": job_template(job),
            "bundle/parameter_values.json": deadline_values(job),
            "bundle/asset_references.json": {
                "assetReferences": {
                    "inputs": {"filenames": [], "directories": []},
                    "outputs": {"directories": []},
                    "referencedPaths": [],
                }
            },
            "parameters.json": parameter_values(job),
        }
        if job.resources.path_map:
            described["path_mapping.json"] = path_mapping(job)
        texts = {name: json.dumps(content, indent=2) + "\n" for name, content in described.items()}
        for name in ("spec.toml", "headset.toml", "recording.csv"):
            source = Path(job.out) / name
            if source.is_file():
                texts[f"bundle/{name}"] = source.read_text(encoding="utf-8")
        return texts

    def check(self, folder: Path) -> None:
        """Let OpenJD's own reader make the job of the template and its parameters, where it is installed."""
        template, values = folder / "bundle" / "template.json", folder / "parameters.json"
        command = [_openjd(), "summary", str(template), "-p", f"file://{values}"]
        if shutil.which(command[0]) is None:
            return
        try:
            read = subprocess.run(
                command, capture_output=True, text=True, errors="replace", timeout=_CHECK_TIMEOUT_S
            )
        except subprocess.TimeoutExpired:
            raise Unanswered(
                f"{command[0]}: has not read the job within {_CHECK_TIMEOUT_S} s; nothing was submitted, so repeat the "
                "command"
            ) from None
        if read.returncode:
            words = " ".join(f"{read.stdout} {read.stderr}".replace(str(template), "the template").split())
            raise InputError(f"OpenJD does not take the job: {words}")

    def notes(self, job: Job) -> list[str]:
        """Say where a cancelled task has less time than its grace."""
        most = _MOST_NOTIFY_S - NOTIFY_S
        if job.resources.grace_s <= most:
            return []
        return [f"--grace {job.resources.grace_s:g}: OpenJD gives a cancelled task {most} s at most"]

    def instructions(self, job: Job) -> list[str]:
        """Commands for this machine, and for Deadline Cloud."""
        return [
            shlex.join(self._run_command(job)),
            shlex.join(["deadline", "bundle", "submit", str(job.folder / "bundle")]),
        ]

    def submit(self, job: Job) -> Submission:
        """Nothing to hand over: the bundle is there for any farm's own submitter."""
        return Submission()

    def wait(self, job: Job, submission: Submission) -> None:
        """Run the bundle on this machine with ``openjd run``, one task after another."""
        command = self._run_command(job)
        if shutil.which(command[0]) is None:
            raise InputError(
                f"{command[0]}: there is no such command here; install it with `pip install openjd-cli`"
            )
        log = job.folder / "logs" / "openjd.out"
        with log.open("ab") as handle:
            # Ctrl-C reaches the command itself, which stops its task; here only its end is waited for
            process = subprocess.Popen(command, stdout=handle, stderr=subprocess.STDOUT)
            try:
                process.wait()
            except KeyboardInterrupt:
                process.wait()

    def activity(self, job: Job, submission: Submission) -> Activity | None:
        """Not known here: each farm has its own monitor."""
        return None

    def cancel(self, job: Job, submission: Submission) -> None:
        """Cannot be done here."""
        raise InputError(
            f"{job.name} is an OpenJD bundle; cancel it where it runs (Ctrl-C, or `deadline job cancel`)"
        )

    def _run_command(self, job: Job) -> list[str]:
        mapping = ["--path-mapping-rules", f"file://{job.folder / 'path_mapping.json'}"]
        return [
            *(_openjd(), "run", str(job.folder / "bundle" / "template.json")),
            *("-p", f"file://{job.folder / 'parameters.json'}"),
            *(mapping if job.resources.path_map else []),
        ]


def _openjd() -> str:
    """The command-line program of this Python, or another one."""
    beside = Path(sys.executable).with_name("openjd")
    return str(beside) if beside.is_file() else "openjd"
