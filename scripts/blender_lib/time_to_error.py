"""How long a render takes, in Blender: run inside Blender by scripts/blender_time.

    blender -b --factory-startup --addons ninefold_render --python time_to_error.py -- ENGINE SCENE.glb OUT.exr SEED KIND LIMIT
        [ADDRESS KEY CLIENTS]

KIND is error, Ninefold's noise limit [%], or frames, of Cycles samples a pixel. With ADDRESS so many
clients of others come there. Prints TIMES {"exported": until Ninefold has the scene, "first": until
there is a picture, "all": until it is done} [s], all since the render was asked for.
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


def note_times(times):
    """Adds to `times` when the scene is exported, and when a first picture is shown."""
    import ninefold_render
    engine = ninefold_render.NinefoldEngine

    def noted(name, what):
        does = getattr(engine, name)

        def timed(self, *arguments):
            result = does(self, *arguments)
            times.setdefault(what, time.monotonic())
            return result

        setattr(engine, name, timed)

    noted("export", "exported")
    noted("show", "first")


def main():
    engine, path, out, seed, kind, limit, *cluster = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    scene.camera = next(thing for thing in scene.objects if thing.type == "CAMERA")
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    times = {}
    if engine == "CYCLES":
        set_cycles(scene, int(seed), int(limit))
    else:
        set_ninefold(scene, int(seed), kind, float(limit), cluster)
        note_times(times)
    begin = time.monotonic()
    bpy.ops.render.render()
    times["all"] = time.monotonic()
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    bpy.data.images["Render Result"].save_render(out)
    print("TIMES", json.dumps({what: when - begin for what, when in times.items()}), flush=True)


if __name__ == "__main__":
    main()
