"""Says which extensions of glTF a file may have: none by which it acts, and required ones that are read.

References
----------
.. [1] https://github.com/KhronosGroup/glTF/tree/main/extensions, and https://github.com/vrm-c/vrm-specification
"""

from collections.abc import Iterable

from room.errors import FormatError

LIGHTS = "KHR_lights_punctual"
"""Which stay dark in avatars, and shine in places."""

READ = frozenset(
    """
    KHR_lights_punctual KHR_materials_anisotropy KHR_materials_clearcoat KHR_materials_dispersion
    KHR_materials_emissive_strength KHR_materials_ior KHR_materials_iridescence KHR_materials_sheen
    KHR_materials_specular KHR_materials_transmission KHR_materials_unlit KHR_materials_volume
    KHR_mesh_quantization KHR_texture_transform EXT_texture_webp
    """.split()
)
"""What every file may require: the page's reader knows it, and it needs nothing from outside."""

VRM = frozenset(
    """
    VRM VRMC_vrm VRMC_springBone VRMC_node_constraint VRMC_materials_mtoon VRMC_materials_hdr_emissiveMultiplier
    """.split()
)
"""What an avatar may require beside these."""

HOW = {
    "KHR_draco_mesh_compression": "export it without Draco compression",
    "EXT_meshopt_compression": "export it without meshopt compression",
    "KHR_meshopt_compression": "export it without meshopt compression",
    "KHR_texture_basisu": "export it with PNG or JPEG in place of KTX2",
}

ACTING = ("interactivity", "behavior", "script", "audio", "event", "link", "hubs", "gpu_instancing")
"""Words in names of extensions by which a file does something, asks for something, or multiplies what it draws."""


def check_extensions(used: Iterable[str], required: Iterable[str], *, read: frozenset[str]) -> None:
    """Refuse what acts, and what is needed and not read.

    Parameters
    ----------
    used
        Names that stand anywhere in the file: a reader takes an extension where it stands, declared or not.
    required
        Without which the file is another one.
    read
        What this kind of file may require.

    Raises
    ------
    FormatError
        With the extension's name, and what to do; it begins behind the name of the file.
    """
    required = tuple(required)
    for name in (*used, *required):
        if any(word in name.lower() for word in ACTING):
            raise FormatError(f"has {name[:60]}, by which a file acts by itself; export it without")
    for name in required:
        if name not in read:
            raise FormatError(
                f"requires {name[:60]}, which the room's page does not read; "
                f"{HOW.get(name, 'export it without')}"
            )
