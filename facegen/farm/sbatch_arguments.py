"""Reads a user's arguments for sbatch, as far as tasks would be lost by them or run too early."""

from facegen.errors import InputError

_OURS = {"--job-name": "-J", "--array": "-a", "--clusters": "-M"}
"""Options of sbatch by which tasks are found again, and their short forms."""

_HOLDING = {"--wait": "-W", "--test-only": ""}
"""Options by which sbatch comes back after the job's end, or with no job; `farm submit` has ``--wait`` of its own."""

_NEED = {"--dependency": "-d"}


def check_arguments(arguments: tuple[str, ...]) -> None:
    """See that tasks keep the names and numbers by which they are asked for, and come one step after another.

    Raises
    ------
    InputError
        With the argument, and why it cannot be passed on.
    """
    for argument in arguments:
        if long := _option(argument, _OURS):
            raise InputError(
                f"--sbatch-arg={argument}: tasks of another name, array or cluster ({long}) would not be found "
                "again and be submitted twice; leave it out"
            )
        if long := _option(argument, _HOLDING):
            raise InputError(
                f"--sbatch-arg={argument}: sbatch would give no job's number at once ({long}); leave it out, and give "
                "--wait or --dry-run of farm submit"
            )
        if is_need(argument) and (argument == "-d" or (argument[:2] == "--" and "=" not in argument)):
            raise InputError(
                f"--sbatch-arg={argument}: names no job to wait for; write --sbatch-arg=--dependency=afterok:NUMBER"
            )


def is_need(argument: str) -> bool:
    """Whether an argument says what a job is to wait for."""
    return _option(argument, _NEED) is not None


def _option(argument: str, options: dict[str, str]) -> str | None:
    """Which of some options of sbatch an argument gives, by its long name; sbatch takes shortened names as well."""
    name = argument.partition("=")[0]
    for long, short in options.items():
        if (len(name) > 2 and long.startswith(name)) or (short and argument[:2] == short):
            return long
    return None
