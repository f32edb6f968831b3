"""Sets up Cycles as all pictures need it, each setting with the measurement that chose it."""

import bpy


def set_up_cycles(scene: bpy.types.Scene, *, threads: int) -> None:
    """Give an empty scene a dark world and the settings that all pictures share.

    Parameters
    ----------
    scene
        Blender's scene.
    threads
        Threads of Cycles, at least two.
    """
    world = bpy.data.worlds.new("dark")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.world = world
    scene.render.engine = "CYCLES"
    scene.render.threads_mode = "FIXED"
    # measured: a single thread is joined by a second one that does nothing but wait, at full load; two
    # share the work
    scene.render.threads = max(2, threads)
    # kept data made pictures depend on chance: Cycles may take a new mesh for an old one at the same address, and
    # then normals and hits differ in the last bit (in half of 98 renders; in none of 40 without, for 0.1 s a view)
    scene.render.use_persistent_data = False
    scene.render.use_compositing = False
    scene.render.use_sequencer = False
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.use_adaptive_sampling = False
    cycles.use_animated_seed = False
    # measured: the default, blue noise, gives other noise after a render with more samples, for good
    cycles.sampling_pattern = "TABULATED_SOBOL"
    # measured: more bounces change nothing, a second diffuse one is 1 % of the brightness
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces = 4, 2, 2
    cycles.transmission_bounces, cycles.transparent_max_bounces = 4, 4
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.denoiser = "OPENIMAGEDENOISE"
    cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
    # ACCURATE costs a second more per view and changes less than 1 dB; the quick network saves less than the paths
    # that its pictures need in addition (2 paths with HIGH and FAST are as good as 4 with FAST and NONE)
    cycles.denoising_prefilter = "FAST"
    cycles.denoising_use_gpu = False
