"""Runs jobs that go on as long as a server, and has the server end where one of them fails."""

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import asynccontextmanager

AGAIN_S = 1.0
"""Between cancellations of a job that goes on: before Python 3.12 `asyncio.wait_for` swallows one that comes in the
moment of its answer (https://github.com/python/cpython/issues/86296), and a server would wait without end."""


@asynccontextmanager
async def supervised(
    *jobs: Callable[[], Coroutine[None, None, None]], failed: Callable[[], None]
) -> AsyncIterator[None]:
    """Run jobs until the context ends.

    A task whose error nobody awaits is silent: a server without ticks would go on to say that it is well.

    Parameters
    ----------
    jobs
        That do not end by themselves.
    failed
        Called once one of them has raised; its error is raised when the context ends.
    """

    def ended(task: "asyncio.Task[None]") -> None:
        if not task.cancelled() and task.exception():
            failed()

    tasks = [asyncio.create_task(job()) for job in jobs]
    for task in tasks:
        task.add_done_callback(ended)
    try:
        yield
    finally:
        going = set(tasks)
        while going:
            for task in going:
                task.cancel()
            _, going = await asyncio.wait(going, timeout=AGAIN_S)
        for answer in await asyncio.gather(*tasks, return_exceptions=True):
            if isinstance(answer, Exception):
                raise answer
