"""Writes blender_default.glb: Blender's scene at the start, exported by its own exporter.

usage: blender -b --factory-startup --python tests/scene/blender_default.py -- FOLDER [cycles]

The file beside this one is by Debian 12's Blender 3.4.1. With "cycles" also FOLDER/cycles.exr, by Cycles, with a
black world as glTF knows none: tests/gi/blender_test.cpp has its means.
"""

import sys

import bpy


def render(path):
    scene = bpy.context.scene
    for node in scene.world.node_tree.nodes:
        if node.type == "BACKGROUND":
            node.inputs["Strength"].default_value = 0
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1024, False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 480, 270, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


arguments = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.export_scene.gltf(filepath=arguments[0] + "/blender_default.glb", export_format="GLB", export_lights=True,
                          export_cameras=True)
if "cycles" in arguments:
    render(arguments[0] + "/cycles.exr")
