"""How long a render takes, in Blender: run inside Blender by scripts/blender_time.

    blender -b --factory-startup --addons ninefold_render --python time_to_error.py -- ENGINE SCENE.glb OUT.exr SEED KIND LIMIT
        [ADDRESS KEY CLIENTS]

KIND is error, Ninefold's noise limit [%], or frames, of Cycles samples a pixel. With ADDRESS so many clients of others come there. Prints
TIMES {"first": until there is a picture, "all": until it is done} [s], both since the render was asked for.
"""
import json
import sys
import time

import bpy
import numpy as np

np.bool = bool  # see public_scenes.py

SIZE = (240, 180)


def set_cycles(scene, seed, samples):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = samples, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 32
    cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"


def set_ninefold(scene, seed, kind, limit, cluster):
    scene.render.engine = "NINEFOLD"
    settings = scene.ninefold
    settings.seed, settings.local_clients, settings.frames = seed, 2, 0
    if kind == "error":
        settings.error = limit
    else:
        settings.frames = int(limit)
    if cluster:
        settings.local_clients = 0
        settings.listen, settings.key_file, count = cluster
        settings.more = f"--wait-clients {count}"


def note_pictures(shown):
    """Adds to `shown` when a picture is."""
    import ninefold_render
    show = ninefold_render.NinefoldEngine.show

    def timed(self, *arguments):
        show(self, *arguments)
        shown.append(time.monotonic())

    ninefold_render.NinefoldEngine.show = timed


def main():
    engine, path, out, seed, kind, limit, *cluster = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    scene.camera = next(thing for thing in scene.objects if thing.type == "CAMERA")
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    shown = []
    if engine == "CYCLES":
        set_cycles(scene, int(seed), int(limit))
    else:
        set_ninefold(scene, int(seed), kind, float(limit), cluster)
        note_pictures(shown)
    begin = time.monotonic()
    bpy.ops.render.render()
    end = time.monotonic()
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    bpy.data.images["Render Result"].save_render(out)
    print("TIMES", json.dumps({"first": (shown or [end])[0] - begin, "all": end - begin}), flush=True)


if __name__ == "__main__":
    main()
