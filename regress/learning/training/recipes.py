"""Lists named ways to train. A new recipe is one new entry."""

from dataclasses import dataclass

from regress.learning.training.noise import DetectorNoise


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """How features are made and networks are fitted.

    Parameters
    ----------
    name
        What the command line calls it.
    alignment
        One of ``regress.runtime.features.ALIGNMENTS``.
    denoise
        Show networks features shrunk as far as the noise of the face before them says
        (``regress.runtime.networks.Denoising``), rather than features as they are.
    undo_turn
        Undo the head's turn by the mean face's depth before the alignment (``regress.runtime.features.turn``).
    hidden
        Hidden units of each network.
    start
        ``"ridge_knots"`` or ``"nguyen_widrow"``.
    mirror
        Train on every face and its mirror image.
    symmetric
        Average every answer with the mirrored answer to the mirrored face (``regress.runtime.model.symmetrised``).
    steps, patience, improvement
        Of :class:`regress.learning.levenberg_marquardt.Settings`.
    strengths
        ``"validation"``: the L2 strength of each network is the one of ``alphas`` with the least validation
        error; ``"evidence"``: it follows from the training rows (``levenberg_marquardt.evidence``).
    alphas
        L2 strengths to choose from for each network, in units of half the sum of squares of z-scored targets.
    search_rows
        Training rows on which alphas are compared; the best one then sees all rows.
    search_steps
        Steps at most while alphas are compared: their order shows long before they are done.
    smooth_frames
        Moving average that the recipe wants for video.
    noise
        How training faces are displaced for the networks that see one frame alone; None leaves them as the
        dataset has them.
    calibrated_noise
        The same for the networks that also see a neutral frame of the person.
    calibrated
        Whether to train those: they serve where a recording has a neutral frame.
    calibrated_alignment
        What those see: one of ``ALIGNMENTS``.
    calibrated_denoise
        ``denoise`` for those.
    calibrated_whitening
        Share of their inputs' spread along the principal axes, in its logarithm, that is taken off: 0 leaves faint
        axes faint, 1 makes all alike.
    calibrated_linear
        Share of ridge regression on the same rows in their answers (``regress.learning.training.linear_share``); not
        with ``calibrated_denoise``.
    calibrated_gain
        Whether their answers are stretched about the neutral face's until they spread as far as true weights
        (``regress.learning.training.gain``).
    """

    name: str
    alignment: str = "affine"
    denoise: bool = False
    undo_turn: bool = True
    hidden: int = 20
    start: str = "ridge_knots"
    mirror: bool = True
    symmetric: bool = False
    steps: int = 30
    patience: int = 6
    improvement: float = 1e-3
    strengths: str = "validation"
    alphas: tuple[float, ...] = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
    search_rows: int = 3000
    search_steps: int = 30
    smooth_frames: int = 1
    noise: DetectorNoise | None = None
    calibrated_noise: DetectorNoise | None = None
    calibrated: bool = True
    calibrated_alignment: str = "affine"
    calibrated_denoise: bool = False
    calibrated_whitening: float = 0.0
    calibrated_linear: float = 0.0
    calibrated_gain: bool = False


RECIPES: dict[str, Recipe] = {
    "default": Recipe(
        name="default",
        denoise=True,
        symmetric=True,
        noise=DetectorNoise(bias=0.5, jitter=0.002, jitter_most=0.03, clean=0.4, unbiased=0.25),
        calibrated_noise=DetectorNoise(bias=1.0, jitter=0.005, jitter_most=0.03, clean=0.0, eyes=0.7),
        calibrated_alignment="stable",
        calibrated_whitening=0.5,
        calibrated_linear=0.3,
        calibrated_gain=True,
    ),
    "exact": Recipe(name="exact"),
    "paper": Recipe(
        name="paper",
        undo_turn=False,
        start="nguyen_widrow",
        mirror=False,
        steps=1000,
        improvement=3e-3,
        alphas=(1.0, 3.0, 10.0, 30.0),
        search_steps=15,
        smooth_frames=10,
        calibrated=False,
    ),
}
"""``paper`` follows the paper. ``exact`` adds mirrored faces, starts from ridge regression and has a second
set of networks that compare a frame with the person's neutral one. ``default`` adds detectors' noise to that, as
real landmarks are not where the dataset's are, measures the noise of each face and takes it off first, and answers a
mirrored face with the mirrored answer."""
