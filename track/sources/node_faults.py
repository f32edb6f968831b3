"""Why a Linux camera gives no picture: asks its node itself, because OpenCV keeps what the system answered.

References
----------
.. [1] https://docs.kernel.org/userspace-api/media/v4l/user-func.html, and linux/videodev2.h for the numbers below,
   which are those of machines of 64 bits.
"""

import contextlib
import errno
import os
import struct
import sys
from collections.abc import Iterator

_QUERYCAP, _QUERYCAP_BYTES = 0x80685600, 104
_G_FMT, _S_FMT, _FORMAT_BYTES = 0xC0D05604, 0xC0D05605, 208
_REQBUFS = 0xC0145608
_STREAMON, _STREAMOFF = 0x40045612, 0x40045613

_CAPTURE, _MMAP = 1, 1
"""Kinds of streams and of memory."""

_CAPTURES = 0x1 | 0x1000
"""Capabilities: pictures in one plane, and in several."""

_HAS_DEVICE_CAPS = 0x80000000


def is_mute(number: int) -> bool:
    """Whether a node is known to give no pictures: a camera's second one, of times and other data, or an output."""
    with contextlib.suppress(OSError), _opened(number) as node:
        return node is not None and not _gives_pictures(node)
    return False


def refusal(number: int) -> str | None:
    """What the system says to who wants pictures of a camera now, and what to do; None where it does not object."""
    place = f"/dev/video{number}"
    try:
        with _opened(number) as node:
            if node is None:
                return None
            if not _gives_pictures(node):
                return f"{place} is no camera but a node of other data; the camera's own has another number"
            _stream(node)
    except OSError as error:
        return {
            errno.EACCES: f"you are not in the group video, which may open {place}; say `sudo usermod -aG video $USER` "
            "and sign in again",
            errno.EPERM: f"this user may not open {place}; in a container, hand the device to it",
            errno.EBUSY: f"another program uses it; end that one (`fuser -v {place}` says which)",
            errno.ENOSPC: "the USB port has no room for it beside others; use another port, format=MJPG, or a smaller "
            "size (0,size=320x240)",
        }.get(error.errno)
    return None


@contextlib.contextmanager
def _opened(number: int) -> Iterator[int | None]:
    """A node's file; None where numbers of requests are not known."""
    if not sys.platform.startswith("linux") or struct.calcsize("P") != 8:
        yield None
        return
    node = os.open(f"/dev/video{number}", os.O_RDWR | os.O_NONBLOCK)
    try:
        yield node
    finally:
        os.close(node)


def _ask(node: int, request: int, argument: bytearray) -> None:
    import fcntl  # no other system has it

    fcntl.ioctl(node, request, argument)


def _gives_pictures(node: int) -> bool:
    answer = bytearray(_QUERYCAP_BYTES)
    _ask(node, _QUERYCAP, answer)
    of_driver, of_node = struct.unpack_from("=II", answer, 84)
    return bool((of_node if of_driver & _HAS_DEVICE_CAPS else of_driver) & _CAPTURES)


def _stream(node: int) -> None:
    """Go as far as a program that wants pictures, in the mode that the last one asked for."""
    wanted = bytearray(struct.pack("=I", _CAPTURE).ljust(_FORMAT_BYTES, b"\0"))
    _ask(node, _G_FMT, wanted)
    _ask(node, _S_FMT, wanted)
    _ask(node, _REQBUFS, bytearray(struct.pack("=IIIII", 2, _CAPTURE, _MMAP, 0, 0)))
    kind = bytearray(struct.pack("=i", _CAPTURE))
    _ask(node, _STREAMON, kind)
    _ask(node, _STREAMOFF, kind)
