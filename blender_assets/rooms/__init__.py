"""Makes the places of `room`: modelled, lit and baked by Blender, written as .glb."""
