"""What is seen, and from where, as Blender means it: built and rendered inside Blender, for blender_test.py.

    blender -b --factory-startup --addons ninefold_render --python blender_things.py -- ENGINE FOLDER

Everything shines in a colour of its own and nothing lights anything else, so that a pixel tells which thing it sees. Writes
FOLDER/ENGINE_things.npz: a picture for each of VIEWS.
"""
import math
import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from blender_scenes import base_scene, link, pixels_of_result, rectangle, with_shader  # noqa: E402

VIEWS = {
    "wide": {},
    "tall": dict(size=(36, 48)),
    "tall, fit to the width": dict(size=(36, 48), fit="HORIZONTAL"),
    "wide, fit to the height": dict(fit="VERTICAL"),
    "shifted": dict(shift=(0.25, -0.125)),
    "shifted, tall": dict(size=(36, 48), shift=(-0.125, 0.25)),
    "border": dict(border=(0.25, 0.75, 0.0, 0.5)),
    "half the resolution": dict(percent=50),
    "turned": dict(turn=(10, 5, 30)),
    "orthographic": dict(scale=9),
    "orthographic, tall": dict(size=(36, 48), scale=9),
    "orthographic, fit to the height, shifted": dict(fit="VERTICAL", scale=6, shift=(0.25, -0.125)),
    "orthographic, border": dict(border=(0.25, 0.75, 0.0, 0.5), scale=9),
    "orthographic, turned": dict(turn=(10, 5, 30), scale=7),
    "second frame": dict(frame=2),
    "blurred from the frame on": dict(shutter=(1, "START")),
    "blurred about the frame": dict(frame=2, shutter=(1.2, "CENTER")),
    "blurred up to the frame": dict(frame=2, shutter=(0.5, "END")),
}


def shining(name, colour):
    """Seen from both sides; dark enough for a PNG, and with nothing that reflects."""
    material = with_shader(name, "ShaderNodeEmission", colour)
    material.node_tree.nodes["Emission"].inputs["Strength"].default_value = 1
    return material


def cube(name, material, at, size=0.6):
    import bmesh
    mesh, maker = bpy.data.meshes.new(name), bmesh.new()
    bmesh.ops.create_cube(maker, size=size)
    maker.to_mesh(mesh)
    maker.free()
    mesh.materials.append(material)
    return link(name, mesh, at)


def make_things(scene):
    row = cube("row", shining("row", (0.9, 0.1, 0.1)), (-3, 1.5, 0))
    array = row.modifiers.new("array", "ARRAY")
    array.count, array.show_viewport = 3, False                       # rendered all the same
    array.relative_offset_displace = (1.5, 0, 0)
    soft = cube("soft", shining("soft", (0.1, 0.9, 0.1)), (1.5, 1.5, 0), 1.2)
    levels = soft.modifiers.new("levels", "SUBSURF")
    levels.levels, levels.render_levels = 0, 3
    soft.shape_key_add(name="Basis")
    flat = soft.shape_key_add(name="flat")
    for point in flat.data:
        point.co.x *= 1.5
    flat.value = 1
    cube("only in the viewport", shining("hidden", (1, 1, 1)), (0, 0, 0)).hide_render = True
    cube("only in the render", shining("rendered", (0.1, 0.1, 0.9)), (-1.5, -0.3, 0)).hide_viewport = True
    away = cube("unseen", shining("unseen", (1, 1, 1)), (0, -1, 0))
    closed = bpy.data.collections.new("closed")
    closed.hide_render = True
    scene.collection.children.link(closed)
    scene.collection.objects.unlink(away)
    closed.objects.link(away)
    part = cube("part", shining("part", (0.9, 0.9, 0.1)), (0, 0, 0), 0.4)
    group = bpy.data.collections.new("group")
    scene.collection.objects.unlink(part)
    group.objects.link(part)
    for at in ((2.5, 0, 0), (3, -1, 0.5)):
        instance = link("instance", None, at)
        instance.instance_type, instance.instance_collection = "COLLECTION", group
    parent = link("parent", None, (-2.5, -1.5, 0), (0, 0, 30))
    parent.scale = (2, 0.5, 1)
    child = cube("sheared", shining("sheared", (0.1, 0.9, 0.9)), (0, 0, 0))
    child.parent, child.rotation_euler = parent, (0, 0, math.radians(45))
    curve = bpy.data.curves.new("text", "FONT")
    curve.body, curve.size = "N", 1.2
    curve.materials.append(shining("text", (0.9, 0.1, 0.9)))
    link("text", curve, (0.4, -1.6, 0))
    scatter(shining("scattered", (0.3, 0.6, 0.9)))
    moving = rectangle("moving", shining("moving", (0.5, 0.5, 0.5)), 0.5, 0.5, (1, 0.2, 0))
    for frame, x in ((1, 1.0), (2, -0.5)):
        moving.location.x = x
        moving.keyframe_insert("location", frame=frame)


def scatter(material):
    """Four cubes by geometry nodes, instanced on the corners of a square."""
    square = rectangle("scatter", material, 1, 0.8, (-0.9, 1.4, 0))
    tree = bpy.data.node_groups.new("scatter", "GeometryNodeTree")
    tree.inputs.new("NodeSocketGeometry", "Geometry"), tree.outputs.new("NodeSocketGeometry", "Geometry")
    nodes = {kind: tree.nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints",
                                                     "GeometryNodeMeshCube", "GeometryNodeSetMaterial")}
    nodes["GeometryNodeMeshCube"].inputs["Size"].default_value = (0.3, 0.3, 0.3)
    nodes["GeometryNodeSetMaterial"].inputs["Material"].default_value = material
    place = nodes["GeometryNodeInstanceOnPoints"]
    for source, target in ((nodes["NodeGroupInput"].outputs[0], place.inputs["Points"]),
                           (nodes["GeometryNodeMeshCube"].outputs[0], nodes["GeometryNodeSetMaterial"].inputs["Geometry"]),
                           (nodes["GeometryNodeSetMaterial"].outputs[0], place.inputs["Instance"]),
                           (place.outputs[0], nodes["NodeGroupOutput"].inputs[0])):
        tree.links.new(source, target)
    square.modifiers.new("scatter", "NODES").node_group = tree


def look(scene, view):
    camera, render = scene.camera, scene.render
    render.resolution_x, render.resolution_y = view.get("size", (48, 36))
    render.resolution_percentage = view.get("percent", 100)
    camera.data.type, camera.data.ortho_scale = "ORTHO" if "scale" in view else "PERSP", view.get("scale", 1)
    camera.data.sensor_fit = view.get("fit", "AUTO")
    camera.data.shift_x, camera.data.shift_y = view.get("shift", (0, 0))
    camera.rotation_euler = [math.radians(t) for t in view.get("turn", (0, 0, 0))]
    render.use_border = render.use_crop_to_border = "border" in view
    if "border" in view:
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = view["border"]
    render.use_motion_blur = "shutter" in view
    render.motion_blur_shutter, scene.cycles.motion_blur_position = view.get("shutter", (0.5, "CENTER"))
    scene.frame_set(view.get("frame", 1))


def main():
    engine, folder = sys.argv[sys.argv.index("--") + 1:]
    folder = pathlib.Path(folder)
    scene = base_scene()
    make_things(scene)
    scene.camera.data.lens, scene.camera.data.sensor_width, scene.camera.data.sensor_height = 45, 36, 24
    scene.camera.location.z = 10
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.samples, scene.cycles.use_adaptive_sampling, scene.cycles.use_denoising = 64, False, False
        scene.cycles.pixel_filter_type = "BOX"
    else:
        scene.ninefold.method, scene.ninefold.frames, scene.ninefold.local_clients = "path-trace", 64, 1
    pictures = {}
    for name, view in VIEWS.items():
        look(scene, view)
        bpy.ops.render.render()
        pictures[name] = pixels_of_result(scene, folder, f"{engine}_{name}")
    np.savez(folder / f"{engine}_things.npz", **pictures)


if __name__ == "__main__":
    main()
