"""Lets bash read what it shall run on a farm, so that an open quote is found where the job is submitted."""

import os
import shutil
import subprocess

from facegen.errors import InputError, Unanswered
from facegen.farm.resources import Resources

_READ_TIMEOUT_S = 60


def check_shell(text: str, *, what: str) -> None:
    """Refuse a script that bash cannot read or warns of; nothing is run.

    Raises
    ------
    InputError
        With bash's own words; ``what`` names the script.
    Unanswered
        If bash is not done in time.
    """
    bash = shutil.which("bash", path=os.environ.get("PATH") or os.defpath)
    if bash is None:
        return  # no machine to submit from, but its scripts can be looked at
    try:
        read = subprocess.run(
            [bash, "--norc", "-n"], input=text.encode(), capture_output=True, timeout=_READ_TIMEOUT_S
        )
    except subprocess.TimeoutExpired:
        raise Unanswered(
            f"{what}: bash has not read it within {_READ_TIMEOUT_S} s; nothing was submitted, so repeat the command"
        ) from None
    # of a document without an end bash only warns, and takes all that follows for part of it
    if read.returncode or read.stderr:
        said = read.stderr.decode(errors="replace").strip().splitlines()
        raise InputError(
            f"{what}: bash cannot read it ({said[0] if said else f'exit code {read.returncode}'})"
        )


def check_setup(resources: Resources) -> None:
    """Refuse a setup command that is not whole, and so would take in what follows it in a script.

    Raises
    ------
    InputError
        If bash cannot read it by itself, or it ends within a line.
    """
    setup = resources.env_setup
    if setup is None:
        return
    if setup.endswith("\\"):
        raise InputError(
            f"--env-setup {setup!r}: ends in a backslash and would go on in the next line; leave it out"
        )
    check_shell(f"{setup}\n", what=f"--env-setup {setup!r}")
