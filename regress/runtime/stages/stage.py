"""The one interface of what a frame passes through, and several of them in a row."""

from collections.abc import Iterable, Iterator, Sequence

from regress.runtime.sample import Sample


class Stage:
    """Takes a sample and gives one. A stage may remember earlier samples, so it serves one take."""

    def step(self, sample: Sample) -> Sample:
        """The next frame's sample, with what this stage adds or changes."""
        raise NotImplementedError

    def run(self, samples: Sequence[Sample]) -> list[Sample]:
        """All samples of a take, as `step` gives them one by one; a stage may have a quicker way for many."""
        return [self.step(sample) for sample in samples]


class BatchStage(Stage):
    """A stage for which one frame is a take of one: what it does, it does to arrays of many."""

    def step(self, sample: Sample) -> Sample:
        """The next frame's sample."""
        return self.run([sample])[0]

    def run(self, samples: Sequence[Sample]) -> list[Sample]:
        """All samples of a take at once, in their order."""
        return self.batch(samples) if samples else []

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """One sample or more, with what this stage adds or changes."""
        raise NotImplementedError


class Chain(Stage):
    """Stages in a row.

    Parameters
    ----------
    stages
        In the order in which a sample passes them.
    """

    def __init__(self, stages: Iterable[Stage]) -> None:
        self.stages = tuple(stages)

    def step(self, sample: Sample) -> Sample:
        """The sample behind the last stage."""
        for stage in self.stages:
            sample = stage.step(sample)
        return sample

    def run(self, samples: Sequence[Sample]) -> list[Sample]:
        """All samples, stage by stage: each stage may take them at once."""
        for stage in self.stages:
            samples = stage.run(samples)
        return list(samples)

    def stream(self, samples: Iterable[Sample]) -> Iterator[Sample]:
        """Each sample as soon as it comes."""
        return map(self.step, samples)
