"""Scenes of other people, as Blender opens them: run inside Blender by scripts/blender_side_by_side,
which tells where they are from.

    blender -b --factory-startup --addons ninefold_render --python public_scenes.py --
        ENGINE SCENE FILES OUT SAMPLES WIDTHxHEIGHT METHOD

FILES: the folder with the scene's files. METHOD: Ninefold's. Writes OUT/ENGINE_SCENE.exr and .png. What
a file lacks (a camera, light, nodes) is added here, and said on the page.
"""
import math
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Vector

np.bool = bool  # Debian's Blender 3.4 imports glTF by that name, which its numpy has no more


def open_file(path):
    if path.suffix == ".blend":
        bpy.ops.wm.open_mainfile(filepath=str(path))
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.suffix == ".obj":
        bpy.ops.wm.obj_import(filepath=str(path))
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))


def link(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def look(eye, target, degrees):
    """A camera; degrees: its vertical angle."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle_y = "VERTICAL", math.radians(degrees)
    camera = link("camera", data)
    camera.location = eye
    camera.rotation_euler = (Vector(target) - Vector(eye)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = camera


def sun(strength, turn):
    data = bpy.data.lights.new("sun", "SUN")
    data.energy, data.angle = strength, 0
    link("sun", data).rotation_euler = [math.radians(t) for t in turn]


def world(strength, colour=None, picture=None):
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("outside")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = strength
    if colour:
        background.inputs["Color"].default_value = (*colour, 1)
    if picture:
        source = tree.nodes.new("ShaderNodeTexEnvironment")
        source.image = bpy.data.images.load(str(picture))
        tree.links.new(source.outputs["Color"], background.inputs["Color"])


def floor(side, z, grey):
    material = bpy.data.materials.new("floor")
    material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    node.inputs["Base Color"].default_value, node.inputs["Specular"].default_value = (grey, grey, grey, 1), 0
    mesh = bpy.data.meshes.new("floor")
    mesh.from_pydata([(-side, -side, z), (side, -side, z), (side, side, z), (-side, side, z)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    link("floor", mesh)


def with_shader(name, kind, **inputs):
    """One node in place of those of a material."""
    tree = bpy.data.materials[name].node_tree
    shader = tree.nodes.new(kind)
    for key, value in dict({"Color": (1, 1, 1, 1), "Roughness": 0}, **inputs).items():
        shader.inputs[key].default_value = value
    tree.links.new(shader.outputs[0], tree.get_output_node("ALL").inputs["Surface"])


def water(files):
    """The Cornell box half full of water, with a sphere of glass and a mirror: dark plastics to Blender's
    reader, so they get nodes."""
    open_file(files / "CornellBox-Water.obj")
    with_shader("water", "ShaderNodeBsdfGlass", IOR=1.33)
    with_shader("rightSphere", "ShaderNodeBsdfGlass", IOR=2.5)
    with_shader("leftSphere", "ShaderNodeBsdfGlossy", Color=(0.95, 0.95, 0.95, 1))
    look((0, -3.4, 1), (0, 0, 1), 40)
    return 1


def water_diffuse(files):
    """The same without Principled nodes, but for the lamp's."""
    exposure = water(files)
    for material in bpy.data.materials:
        surface = material.use_nodes and material.node_tree.get_output_node("ALL").inputs["Surface"]
        if surface and surface.links[0].from_node.type == "BSDF_PRINCIPLED" and material.name != "light":
            colour = surface.links[0].from_node.inputs["Base Color"].default_value[:]
            with_shader(material.name, "ShaderNodeBsdfDiffuse", Color=colour)
    return exposure


def veach(files):
    open_file(files / "veach-bidir.glb")
    bpy.context.scene.camera = next(thing for thing in bpy.context.scene.objects if thing.type == "CAMERA")
    return 0


def crate(files):
    """As it is: a sun of strength 1, materials without nodes."""
    open_file(files / "04_common_materials.blend")
    return 1


def forklift(files):
    """Of 2018, without nodes, camera and light: they get nodes with the pictures that lie beside the file."""
    open_file(files / "flying_forklift.blend")
    thing = bpy.data.objects["BlueFlyingForklift"]
    corners = [thing.matrix_world @ Vector(corner) for corner in thing.bound_box]
    middle, low = sum(corners, Vector()) / 8, min(corner.z for corner in corners)
    material = bpy.data.materials["flying_forklift"]
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes["Principled BSDF"]

    def picture(name, is_data):
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = bpy.data.images.load(str(files / f"flying_forklift_{name}.png"))
        node.image.colorspace_settings.name = "Non-Color" if is_data else "sRGB"
        return node.outputs["Color"]

    tree.links.new(picture("albedo", False), shader.inputs["Base Color"])
    tree.links.new(picture("emission", False), shader.inputs["Emission"])
    parts = tree.nodes.new("ShaderNodeSeparateColor")
    tree.links.new(picture("orm", True), parts.inputs["Color"])
    tree.links.new(parts.outputs["Green"], shader.inputs["Roughness"])
    tree.links.new(parts.outputs["Blue"], shader.inputs["Metallic"])
    bump = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(picture("normal", True), bump.inputs["Color"])
    tree.links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    floor(30, low, 0.4)
    world(1, picture=files / "st_fagans_interior_1k.hdr")
    look(middle + Vector((5, -8, 4.5)), middle, 35)
    return 0.5


CITY = (("building-small-a", "road-straight", "building-small-b"), ("building-small-c", "road-intersection", "building-small-d"),
        ("grass-trees", "road-straight-lightposts", "building-garage"), ("pavement-fountain", "road-straight", "grass-trees-tall"))


def city(files):
    """Twelve of its blocks, a metre each, put together here."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for row, names in enumerate(CITY):
        for column, name in enumerate(names):
            before = set(bpy.data.objects)
            bpy.ops.import_scene.gltf(filepath=str(files / f"{name}.glb"))
            for thing in set(bpy.data.objects) - before:
                if thing.parent is None:
                    thing.location = (column - 1, 1.5 - row, 0)
    floor(20, -0.02, 0.5)
    sun(3, (40, 15, 0))
    world(0.5, colour=(0.5, 0.65, 0.9))
    look((2.6, -4.2, 2.6), (0, -0.1, 0.2), 40)
    return -0.5


SCENES = {"water": water, "water_diffuse": water_diffuse, "veach": veach, "crate": crate, "forklift": forklift, "city": city}


def prepare(engine, name, files, samples, size, method):
    """Opens the scene; gives the exposure at which it is shown [EV]."""
    exposure = SCENES[name](files)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform, scene.view_settings.look = "Standard", "None"
    scene.view_settings.exposure = exposure
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.samples = samples
        scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
        for kind in ("max", "diffuse", "glossy", "transmission"):
            setattr(scene.cycles, f"{kind}_bounces", 32)
        scene.cycles.sample_clamp_indirect = scene.cycles.blur_glossy = 0
        scene.cycles.pixel_filter_type = "BOX"
    else:
        scene.ninefold.frames, scene.ninefold.local_clients, scene.ninefold.method = samples, 2, method
    return scene


def main():
    engine, name, files, out, samples, size, method = sys.argv[sys.argv.index("--") + 1:]
    scene = prepare(engine, name, pathlib.Path(files), int(samples), [int(s) for s in size.split("x")], method)
    bpy.ops.render.render()
    result = bpy.data.images["Render Result"]
    stem = pathlib.Path(out) / f"{engine}_{name}"
    scene.render.image_settings.color_mode, scene.render.image_settings.color_depth = "RGB", "8"
    result.save_render(f"{stem}.png")
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    result.save_render(f"{stem}.exr")


if __name__ == "__main__":
    main()
