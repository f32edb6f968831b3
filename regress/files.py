"""Files that appear whole: written under a temporary name, then renamed."""

import errno
import os
from pathlib import Path


def write_whole(path: Path, content: bytes | str) -> Path:
    """Write a file so that its name never stands for half of it.

    Parameters
    ----------
    path : Path
        Where the file is to stand; an older one is replaced.
    content : bytes or str
        What it holds; text is written as UTF-8 with ``\\n`` line ends on every system, so that the bytes are
        the same everywhere.

    Returns
    -------
    Path
        ``path``, for the exporter's list of what it wrote.

    Raises
    ------
    OSError
        Where the file cannot be written, or ``path`` is a folder.
    """
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    data = content.encode() if isinstance(content, str) else content
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
    return path
