"""Runs works that last as long as a server, and has the server end where one of them fails."""

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import asynccontextmanager


@asynccontextmanager
async def lasting(
    *works: Callable[[], Coroutine[None, None, None]], failed: Callable[[], None]
) -> AsyncIterator[None]:
    """Run works until the context ends.

    A task whose error nobody awaits is silent: a server without ticks would go on to say that it is well.

    Parameters
    ----------
    works
        That do not end by themselves.
    failed
        Called once one of them has raised; its error is raised when the context ends.
    """

    def ended(task: "asyncio.Task[None]") -> None:
        if not task.cancelled() and task.exception():
            failed()

    tasks = [asyncio.create_task(work()) for work in works]
    for task in tasks:
        task.add_done_callback(ended)
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        for answer in await asyncio.gather(*tasks, return_exceptions=True):
            if isinstance(answer, Exception):
                raise answer
