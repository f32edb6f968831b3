"""Tries new cases for hours, keeps what fails, and says how it goes."""

import random
import sys
import threading
import time
from collections import Counter
from pathlib import Path

from tests.hostile import corpus
from tests.hostile.mutators import FAMILIES
from tests.hostile.readers import READERS
from tests.hostile.running import Server
from tests.hostile.summary import lines
from tests.hostile.trial import Case, Outcome, clear, mutators_of, try_case
from tests.hostile.verdict import Verdict
from tests.hostile.workshop import Workshop

LINE_EVERY_S = 20.0


class Fuzz:
    """Hours of new cases, by several servers.

    Parameters
    ----------
    seed
        First seed; the cases of a run follow from it, up to their order.
    scratch
        Folder for cases.
    readers
        Names of those that are tried.
    """

    def __init__(self, *, seed: int, scratch: Path, readers: list[str]) -> None:
        self.workshop = Workshop(scratch)
        self._scratch, self._seed, self._readers = scratch, seed, readers
        self._tried = 0
        self._verdicts: Counter[tuple[str, str]] = Counter()
        self._causes: dict[tuple[str, Verdict], str] = {}
        self._lock, self._stop = threading.Lock(), threading.Event()

    def run(self, *, minutes: float, workers: int) -> int:
        """Try cases until the time is up or Ctrl-C; returns the number of causes of failures."""
        self.workshop.complete()
        threads = [
            threading.Thread(target=self._work, args=(number,), daemon=True) for number in range(workers)
        ]
        began = last = time.monotonic()
        for thread in threads:
            thread.start()
        try:
            while (now := time.monotonic()) - began < 60 * minutes and any(
                thread.is_alive() for thread in threads
            ):
                time.sleep(0.5)
                if now - last >= LINE_EVERY_S:
                    last = now
                    self._say(f"{(now - began) / 60:.1f} of {minutes:g} minutes")
        except KeyboardInterrupt:
            self._say("stopped")
        self._stop.set()
        for thread in threads:
            thread.join()
        for line in lines(self._verdicts.elements()):
            print(line)
        for (_, verdict), case in sorted(self._causes.items(), key=lambda item: item[1]):
            print(f"{verdict.kind}\t{verdict.detail}\tpython -m tests.hostile {case}")
        return len(self._causes)

    def _say(self, word: str) -> None:
        with self._lock:
            print(
                f"fuzz: {word}, {self._tried:,} cases, {len(self._causes)} causes of failure",
                file=sys.stderr,
                flush=True,
            )

    def _work(self, number: int) -> None:
        server, folder = Server(), self._scratch / f"case-{number}"
        while not self._stop.is_set():
            case = self._next()
            outcome = self._try(case, server, folder)
            with self._lock:
                self._verdicts[case.reader.name, outcome.verdict.kind] += 1
                key = case.reader.name, outcome.verdict
                new = not outcome.verdict.good and key not in self._causes
                if new:
                    self._causes[key] = str(case)
            if new:
                self._keep(outcome, server, folder)
        server.close()

    def _next(self) -> Case:
        """The next case; slow readers come more seldom."""
        with self._lock:
            self._tried += 1
            seed = self._seed + self._tried
        chance = random.Random(seed)
        readers = [READERS[name] for name in self._readers]
        reader = chance.choices(readers, [reader.weight for reader in readers])[0]
        return Case(reader=reader, mutator=chance.choice(mutators_of(reader)), seed=seed)

    def _try(self, case: Case, server: Server, folder: Path, replay: bytes | None = None) -> Outcome:
        outcome = try_case(case, server, self.workshop, folder, replay=replay)
        clear(folder)
        return outcome

    def _keep(self, outcome: Outcome, server: Server, folder: Path) -> None:
        case = outcome.case
        content = None
        if case.mutator in FAMILIES.get(case.reader.kind, {}) and outcome.damaged is not None:
            content = outcome.damaged
        place = corpus.keep(outcome, content, lambda data: self._try(case, server, folder, data))
        self._say(f"{outcome.verdict.kind} ({outcome.verdict.detail[:120]}), kept in {place}")
