"""Which camera is made to see which shapes, and which cameras are each other's mirror image, by their names."""

from facegen.conventions import BLENDSHAPES

_UPPER = ("eye", "brow", "cheekSquint", "noseSneer")
_LOWER = ("jaw", "mouth", "cheekPuff", "noseSneer", "tongue")
_LOWER_CAMERAS = ("mouth", "jaw", "chin", "lip")
_UPPER_CAMERAS = ("eye", "brow", "cheek")


def part_of(camera: str) -> tuple[str, ...]:
    """Shapes that a camera is made to see.

    A camera called after mouth, jaw, chin or lip sees the lower face; after eye, brow or cheek the upper face, of its
    own side where it has one, browInnerUp included. Nose sneers belong to both: the only shape in which two
    cameras add up (.43 and .33 of its variance alone, .53 together, in the trial). Any other name sees it all.

    Parameters
    ----------
    camera
        For example ``"left_eye"``.

    Returns
    -------
    tuple of str
        Names of blendshapes, in their order.
    """
    words = camera.lower()
    if any(word in words for word in _LOWER_CAMERAS):
        return tuple(name for name in BLENDSHAPES if name.startswith(_LOWER))
    if any(word in words for word in _UPPER_CAMERAS):
        other = {"left": "Right", "right": "Left"}.get(side_of(camera) or "", "neither")
        return tuple(name for name in BLENDSHAPES if name.startswith(_UPPER) and not name.endswith(other))
    return BLENDSHAPES


def side_of(camera: str) -> str | None:
    """``"left"``, ``"right"`` or None, from the words of a camera's name."""
    words = camera.lower().split("_")
    return next((side for side in ("left", "right") if side in words), None)


def mirror_partner(camera: str) -> str:
    """Name of the camera on the other side of the face; a camera without a side names itself."""
    swapped = {"left": "right", "right": "left"}
    return "_".join(swapped.get(word, word) for word in camera.split("_"))


def encoder_owners(cameras: tuple[str, ...]) -> dict[str, str | None]:
    """For each camera the one whose encoder sees its pictures mirrored; None where it has its own.

    The first of two partners owns the encoder, so the right eye's pictures go mirrored through the left's.
    """
    owners: dict[str, str | None] = {}
    for camera in cameras:
        partner = mirror_partner(camera)
        owners[camera] = partner if partner != camera and owners.get(partner, camera) is None else None
    return owners


def is_symmetric(cameras: tuple[str, ...]) -> bool:
    """Whether the mirror image of a frame is a frame of the same headset: every camera has its partner."""
    return all(mirror_partner(camera) in cameras for camera in cameras)
