"""Reads NumPy's files (.npy, .npz) that strangers wrote: their headers are believed only where the file bears them out.

`numpy.load` allocates what a header claims before it reads: a cut file of 100 bytes can ask for 8 GB, and an archive
of 5 MB can unpack to 3 GB. Pickled objects are never read.
"""

import io
import math
import os
import struct
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.lib import format as npy_format

from facegen.documents import read_bytes, unreadable
from facegen.errors import FormatError

MOST_BYTES = 256 * 1024**2
"""Of all arrays of a file that is read into memory: ten times our largest model, three times our largest rig."""

MOST_ARRAYS = 1000
"""In one archive; the largest of ours has some 200."""

_DIRECTORY_BYTES = 1024**2
"""Of an archive, beside its numbers: a thousand headers and entries take half of it."""

_ZIP_ERRORS = (
    *(zipfile.BadZipFile, zlib.error, struct.error, EOFError, ValueError),
    *(NotImplementedError, RuntimeError),  # of members compressed in other ways, or encrypted
    OSError,  # of places before the file's beginning
)
"""What `zipfile` raises at damage."""

_HEADER_ERRORS = (ValueError, SyntaxError, tokenize.TokenError, TypeError, MemoryError, RecursionError)
"""What NumPy raises at headers that are no literals of Python."""

_PLAIN_KINDS = "biufUS"
"""NumPy's letters for truth values, whole numbers, fractions and texts of one length."""

_READERS = {(1, 0): npy_format.read_array_header_1_0, (2, 0): npy_format.read_array_header_2_0}


def load_npy(path: str | os.PathLike[str], *, most_bytes: int = MOST_BYTES, mmap: bool = False) -> np.ndarray:
    """Read an array of a .npy file.

    Parameters
    ----------
    path
        The file.
    most_bytes
        More is refused; a mapped array is not held against it.
    mmap
        Map the file read-only instead of reading it.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is no .npy file, claims more or less than it holds, holds objects, or is too large.
    """
    path = Path(path)
    try:
        with open(path, "rb") as file:
            size = os.fstat(file.fileno()).st_size
            header = _Header.read(file, size, where=str(path))
            if not mmap:
                header.check_size(most_bytes, where=str(path))
                return header.array(file.read(header.data_bytes))
    except (OSError, ValueError) as error:
        raise unreadable(path, error) from None
    if header.data_bytes == 0:  # nothing can be mapped
        return header.array(b"")
    order = "F" if header.fortran else "C"
    return np.memmap(path, header.dtype, "r", size - header.data_bytes, header.shape, order)


def load_npz(path: str | os.PathLike[str], *, most_bytes: int = MOST_BYTES) -> dict[str, np.ndarray]:
    """Read all arrays of an .npz archive.

    Raises
    ------
    InputError
        If there is no such file, or it cannot be read.
    FormatError
        If it is no such archive, is damaged, holds anything but plain arrays, or too much of them.
    """
    # whole, and no more than that: in a device that goes on for ever zipfile looks for the end
    content = read_bytes(path, most_bytes=most_bytes + _DIRECTORY_BYTES)
    return parse_npz(content, where=str(path), most_bytes=most_bytes)


def parse_npz(content: bytes, *, where: str, most_bytes: int = MOST_BYTES) -> dict[str, np.ndarray]:
    """Arrays of an .npz archive that has been read; ``where`` begins the sentence of an error.

    Raises
    ------
    FormatError
        As `load_npz`.
    """
    return _arrays(io.BytesIO(content), most_bytes, where=where)


def _arrays(file: BinaryIO, most_bytes: int, *, where: str) -> dict[str, np.ndarray]:
    arrays: dict[str, np.ndarray] = {}
    try:
        with zipfile.ZipFile(file) as archive:
            members = archive.infolist()
            total = sum(member.file_size for member in members)
            if len(members) > MOST_ARRAYS or total > most_bytes:
                raise FormatError(
                    f"{where}: unpacks to {total:,} bytes in {len(members):,} arrays, but at most {most_bytes:,} bytes "
                    f"in {MOST_ARRAYS:,} arrays are read here"
                )
            for member in members:
                name = member.filename.removesuffix(".npy")
                if name == member.filename or name in arrays:
                    raise FormatError(f"{where}: {member.filename!r} is no array, or stands there twice")
                place = f"{where}: array {name!r}"
                with archive.open(member) as stream:
                    header = _Header.read(stream, member.file_size, where=place)
                    arrays[name] = header.array(stream.read(header.data_bytes))
                    stream.read(1)  # only a stream that is read to its end is held against its checksum
    except _ZIP_ERRORS as error:
        raise FormatError(f"{where}: is no archive of NumPy's arrays, or a damaged one ({error})") from None
    return arrays


@dataclass(frozen=True, kw_only=True)
class _Header:
    """Claim of a .npy header that the bytes after it bear out."""

    shape: tuple[int, ...]
    fortran: bool
    dtype: np.dtype
    data_bytes: int

    @classmethod
    def read(cls, stream: BinaryIO, size: int, *, where: str) -> "_Header":
        """Read a header from a stream of ``size`` bytes; refuse what the rest of the bytes does not bear out."""
        try:
            version = npy_format.read_magic(stream)
            if version not in _READERS:
                raise FormatError(f"{where}: is a .npy file of version {version}; 1.0 and 2.0 are read")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of headers that Python 2 wrote
                shape, fortran, dtype = _READERS[version](stream)
        except _HEADER_ERRORS as error:
            raise FormatError(f"{where}: is no .npy file that can be read ({error})") from None
        if dtype.kind not in _PLAIN_KINDS or dtype.itemsize == 0:
            raise FormatError(f"{where}: holds {dtype}, but only arrays of numbers or texts are read")
        if any(type(length) is not int or length < 0 for length in shape):
            raise FormatError(f"{where}: has a shape of {shape}, whose lengths must be whole numbers from 0")
        data_bytes = size - stream.tell()
        claimed = math.prod(shape) * dtype.itemsize
        if claimed != data_bytes or math.prod(length or 1 for length in shape) >= 2**62:
            raise FormatError(
                f"{where}: is cut or damaged: its header claims {claimed:,} bytes, and {data_bytes:,} are there"
            )
        return cls(shape=shape, fortran=fortran, dtype=dtype, data_bytes=data_bytes)

    def check_size(self, most_bytes: int, *, where: str) -> None:
        if self.data_bytes > most_bytes:
            raise FormatError(
                f"{where}: has {self.data_bytes:,} bytes of numbers, but at most {most_bytes:,} are read here"
            )

    def array(self, content: bytes) -> np.ndarray:
        """The array, writable, of the bytes that follow the header."""
        flat = np.frombuffer(bytearray(content), self.dtype)
        return flat.reshape(self.shape[::-1]).T if self.fortran else flat.reshape(self.shape)


def check_shapes(
    arrays: Mapping[str, np.ndarray], shapes: Mapping[str, tuple[int | None, ...]], *, where: str
) -> None:
    """Refuse an archive without these arrays in these shapes, of finite numbers.

    Parameters
    ----------
    arrays
        What `load_npz` gave.
    shapes
        Shape by name; None stands for any length.
    where
        Begins the sentence of an error.

    Raises
    ------
    FormatError
        Names the first array that is missing, of another shape, no number, or not finite.
    """
    for name, shape in shapes.items():
        array = arrays.get(name)
        if array is None:
            raise FormatError(f"{where}: array {name!r} is missing; it has {', '.join(arrays) or 'none'}")
        fits = array.ndim == len(shape) and all(
            want in (None, have) for want, have in zip(shape, array.shape, strict=True)
        )
        if not fits or array.dtype.kind not in "biuf":
            wish = " x ".join("any" if length is None else str(length) for length in shape)
            raise FormatError(
                f"{where}: array {name!r} is {array.dtype} of shape {array.shape}, but must be numbers of {wish}"
            )
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise FormatError(f"{where}: array {name!r} has a value that is not finite")
