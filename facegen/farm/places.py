"""Checks the folders into which the later steps of a job write: of its pack, and of its model."""

from facegen.errors import InputError
from facegen.farm.job import Job
from facegen.packing import check_pack
from facegen.store import Dataset


def refuse_rivals(job: Job, at_work: tuple[tuple[Job, str], ...]) -> None:
    """Refuse a job of which a step writes into a folder that a step of another job is to write into.

    Parameters
    ----------
    job
        The job.
    at_work
        Later steps of other jobs that engines have.

    Raises
    ------
    InputError
        If two steps would write into one folder of a pack or a model at a time.
    """
    for rival, step in at_work:
        place = _place(rival, step)
        if place is not None and place in {_place(job, own) for own in job.steps}:
            raise InputError(
                f"{place}: the step {step!r} of {rival.name} is to write there, and two at a time must not; submit the "
                "steps that write there when it has ended, or name another folder with --packed or --model"
            )


def check_packed(dataset: Dataset, job: Job) -> None:
    """See that ``pack`` will be able to begin: it is told when the job is submitted, and not hours later.

    Raises
    ------
    InputError
        If the folder holds another pack, or anything else.
    """
    samples = dataset.samples_to_render(job.samples)
    try:
        check_pack(dataset, job.packed, samples=samples, chosen=None if job.whole else job.samples)
    except InputError as error:
        raise InputError(f"{error}; --packed of farm submit names the folder of the step 'pack'") from error


def _place(job: Job, step: str) -> str | None:
    return {"pack": job.packed, "train": job.model, "export": job.model}.get(step)
