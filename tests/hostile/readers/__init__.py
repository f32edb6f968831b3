"""The table of readers: every file and option by which a stranger reaches the programs."""

from tests.hostile.readers import assets, datasets, headset, landmarks, options
from tests.hostile.readers.reader import Reader

READERS: dict[str, Reader] = {
    reader.name: reader
    for reader in (*landmarks.READERS, *headset.READERS, *datasets.READERS, *assets.READERS, *options.READERS)
}
"""By name; a new reader is one entry in its family's module."""

__all__ = ["READERS", "Reader"]
