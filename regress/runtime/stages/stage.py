"""The one interface of what a frame passes through, and several of them in a row."""

from collections.abc import Iterable, Iterator, Sequence

from regress.runtime.sample import Sample


class Stage:
    """Takes samples as they come and gives them on, each once and in their order.

    A stage may remember earlier samples, so it serves one take. Most give each sample as soon as it comes and have a
    `step`; one that looks ahead holds samples back (`DelayingStage`). `feed` and `finish` serve both.
    """

    def step(self, sample: Sample) -> Sample:
        """The next frame's sample, with what this stage adds or changes."""
        raise NotImplementedError

    def feed(self, sample: Sample) -> list[Sample]:
        """Take the next frame's sample; give those that are ready, which may be none, one or several."""
        return [self.step(sample)]

    def finish(self) -> list[Sample]:
        """The samples that were held back, at the end of the take."""
        return []

    def run(self, samples: Sequence[Sample]) -> list[Sample]:
        """All samples of a take, as they come out one by one; a stage may have a quicker way for many."""
        return [ready for sample in samples for ready in self.feed(sample)] + self.finish()


class DelayingStage(Stage):
    """A stage that looks ahead: `feed` gives samples later than they come, and `finish` the last ones."""

    def step(self, sample: Sample) -> Sample:
        """Not to be had: a sample cannot be answered before those behind it have come."""
        raise TypeError(f"{type(self).__name__} looks ahead: use feed and finish, not step")


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
        """The sample behind the last stage, where none looks ahead."""
        for stage in self.stages:
            sample = stage.step(sample)
        return sample

    def feed(self, sample: Sample) -> list[Sample]:
        """The samples that are ready behind the last stage."""
        samples = [sample]
        for stage in self.stages:
            samples = [ready for given in samples for ready in stage.feed(given)]
        return samples

    def finish(self) -> list[Sample]:
        """What each stage held back, through all stages behind it."""
        samples: list[Sample] = []
        for stage in self.stages:
            samples = [ready for given in samples for ready in stage.feed(given)] + stage.finish()
        return samples

    def run(self, samples: Sequence[Sample]) -> list[Sample]:
        """All samples, stage by stage: each stage may take them at once."""
        for stage in self.stages:
            samples = stage.run(samples)
        return list(samples)

    def stream(self, samples: Iterable[Sample]) -> Iterator[Sample]:
        """Each sample as soon as it is ready, and at the end those that were held back."""
        for sample in samples:
            yield from self.feed(sample)
        yield from self.finish()
