"""From options to what happens before and after the networks."""

from pathlib import Path

from regress.errors import InputError
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output


def output_of(
    *,
    filter_name: str,
    cutoff_hz: float | None,
    beta: float,
    adjust: Path | None,
    retarget: str | None,
    **settings: float | bool | None,
) -> Output:
    """Read the files that options name.

    Parameters
    ----------
    filter_name
        As ``--filter`` takes it; auto is none here.
    cutoff_hz, beta
        Of One-Euro smoothing.
    adjust, retarget
        A file of adjustments, a target's name or file.
    settings
        The other fields of `Output`.

    Raises
    ------
    InputError
        Where a file cannot be used, or beta has nothing to act on.
    """
    if cutoff_hz is None and beta != OneEuro.beta:
        raise InputError(f"--beta {beta:g} is of --one-euro, which is not given; add --one-euro 1")
    # each reader imports the settings library, which takes as long as NumPy
    adjustments, retargeting = {}, None
    if adjust is not None:
        from regress.runtime.stages.adjustment_file import read_adjustments

        adjustments = read_adjustments(adjust)
    if retarget is not None:
        from regress.runtime.stages.retargeting.target_file import read_retargeting

        retargeting = read_retargeting(retarget)
    one_euro = None if cutoff_hz is None else OneEuro(cutoff_hz=cutoff_hz, beta=beta)
    filter_ = None if filter_name in ("auto", "none") else filter_name
    return Output(
        filter=filter_, one_euro=one_euro, adjustments=adjustments, retargeting=retargeting, **settings
    )
