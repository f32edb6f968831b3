"""Has avatars checked by another process: parsing one takes up to a second, and no thread of this one runs then."""

import asyncio
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process

from room.avatars.examiner import LENGTH_BYTES, framed
from room.errors import FormatError, NotAllowed

CHECK_S = 60.0
"""For one avatar; the worst take two seconds, and a process begins in half of one where the machine has other work."""

_BEGIN = "import sys; sys.path[:] = sys.argv[1:]; from room.avatars.examiner import examine; examine()"
"""Finds what this process finds, and nothing in the folder where the server was started."""


class AvatarChecks:
    """One process, which begins with the first avatar."""

    def __init__(self) -> None:
        self._one, self._process = asyncio.Lock(), None

    async def check(self, content: bytes) -> None:
        """Wait for one's turn, and refuse what is no avatar that others can load.

        Raises
        ------
        FormatError
            As `room.avatars.check_avatar`, or if the other process ended or took too long.
        NotAllowed
            If the system begins no other process now.
        """
        async with self._one:
            wrong = None
            try:
                wrong = await asyncio.wait_for(self._ask(content), CHECK_S)
            except (asyncio.TimeoutError, asyncio.IncompleteReadError, ConnectionError):
                raise FormatError(
                    "this avatar takes more time or memory to check than there is; export a simpler one"
                ) from None
            finally:
                if (
                    wrong is None
                ):  # also where nobody waits any more: its answer would be taken for the next one's
                    await self.close()
        if wrong:
            raise FormatError(wrong)

    async def close(self) -> None:
        """End the process."""
        process, self._process = self._process, None
        if process:
            if process.returncode is None:
                process.kill()
            await process.communicate()

    async def _ask(self, content: bytes) -> str:
        """What is wrong with an avatar; it is asked once more where the process had ended since the last one."""
        if self._process and self._process.returncode is not None:
            await self.close()
        used = self._process is not None
        try:
            return await self._ask_once(content)
        except (asyncio.IncompleteReadError, ConnectionError) as error:
            if not used or getattr(error, "partial", b""):
                raise
        await self.close()
        return await self._ask_once(content)

    async def _ask_once(self, content: bytes) -> str:
        if self._process is None:
            self._process = await _begun()
        process: Process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(framed(content))
        await process.stdin.drain()
        length = int.from_bytes(await process.stdout.readexactly(LENGTH_BYTES), "little")
        return (await process.stdout.readexactly(length)).decode()


async def _begun() -> Process:
    try:
        return await asyncio.create_subprocess_exec(
            sys.executable, "-c", _BEGIN, *sys.path, stdin=PIPE, stdout=PIPE, stderr=DEVNULL
        )
    except OSError:  # no memory, or as many processes as there may be
        raise NotAllowed(
            "no avatar can be checked at this moment; try again in a minute", again=True
        ) from None
