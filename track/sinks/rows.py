"""Rows of a recording that go to the disk as they come, each whole or not at all."""

from pathlib import Path


class Rows:
    """A file that grows by rows; where no more can be written those before stay.

    Nothing waits in a buffer of ours: what is counted is the system's, and a full disk is met by the row that fills it.

    Parameters
    ----------
    path
        The file, which is made anew.

    Attributes
    ----------
    count
        Of rows that are there.

    Raises
    ------
    OSError
        Here, in `add` and in `close`, where the system refuses to write.
    """

    def __init__(self, path: Path) -> None:
        self.count = 0
        self._file, self._bytes = open(path, "wb", buffering=0), 0

    def add(self, row: bytes) -> None:
        """Write one more."""
        left = memoryview(row)
        try:
            while left:
                left = left[self._file.write(left) :]
        except OSError:
            self._file.truncate(self._bytes)
            self._file.seek(self._bytes)
            raise
        self._bytes += len(row)
        self.count += 1

    def close(self) -> None:
        """Let the file go."""
        self._file.close()
