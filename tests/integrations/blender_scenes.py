"""Scenes for blender_test.py, built and rendered inside Blender:

    blender -b --factory-startup --addons ninefold_render --python blender_scenes.py -- ENGINE SCENE FOLDER

Writes FOLDER/ENGINE_SCENE.json: the mean colour of each patch, a part of the picture that shows one thing, by its name; and the
picture itself as .png. Two scenes are a board of bays, one thing in each, seen from above.

    lamps      each bay, between black walls, has a lamp of its own above a grey floor
    surfaces   each bay has a surface, under a sun and an evenly bright sky
    layers     surfaces of one layer and of two, which glTF and Cycles put together otherwise, under that sky
    parallel   the surfaces, by an orthographic camera
    outside    a mirror ball fills the picture; it shows a picture of what is outside, turned
"""
import json
import math
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Euler

COLUMNS, ROWS = 4, 4
HEIGHT = 14          # of the camera [m]; a bay is 2 m wide
SIZE = (96, 96)
SAMPLES = {"lamps": 1536, "surfaces": 1024, "layers": 1024, "parallel": 1024, "outside": 64}  # of Cycles
FRAMES = {"lamps": 512, "surfaces": 512, "layers": 512, "parallel": 512, "outside": 64}      # of Ninefold


def principled(name, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    for key, value in dict({"Specular": 0.0, "Roughness": 0.5}, **inputs).items():
        socket = node.inputs[key.replace("_", " ")]
        socket.default_value = (*value, 1) if isinstance(value, tuple) else value
    return material


def with_shader(name, kind, colour, roughness=None):
    material = principled(name)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = nodes.new(kind)
    shader.inputs["Color"].default_value = (*colour, 1)
    if roughness is not None:
        shader.inputs["Roughness"].default_value = roughness
    if kind == "ShaderNodeEmission":
        shader.inputs["Strength"].default_value = 2
    links.new(shader.outputs[0], nodes["Material Output"].inputs["Surface"])
    return material


def textured(name):
    """A 2x2 picture of linear 0.1 to 0.8, blown up over the tile."""
    image = bpy.data.images.new(name, 4, 4)
    cells = np.tile([[0.9, 0.2, 0.2, 1], [0.2, 0.9, 0.2, 1], [0.2, 0.2, 0.9, 1], [0.9, 0.9, 0.2, 1]], (4, 1))
    image.pixels.foreach_set(cells.astype(np.float32).ravel())
    image.pack()
    material = principled(name)
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image, node.interpolation = image, "Closest"
    material.node_tree.links.new(node.outputs["Color"], material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    return material


def link(name, data, at=(0, 0, 0), turn=(0, 0, 0)):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    thing.location = at
    thing.rotation_euler = Euler([math.radians(t) for t in turn])
    return thing


def rectangle(name, material, width, height, at, turn=(0, 0, 0)):
    mesh = bpy.data.meshes.new(name)
    x, y = width / 2, height / 2
    mesh.from_pydata([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    if material:
        mesh.materials.append(material)
    return link(name, mesh, at, turn)


def ball(name, material, radius, at):
    import bmesh
    mesh, maker = bpy.data.meshes.new(name), bmesh.new()
    bmesh.ops.create_uvsphere(maker, u_segments=96, v_segments=48, radius=radius)
    for face in maker.faces:
        face.smooth = True
    maker.to_mesh(mesh)
    maker.free()
    mesh.materials.append(material)
    return link(name, mesh, at)


def lamp(name, kind, at, turn=(0, 0, 0), **values):
    data = bpy.data.lights.new(name, kind)
    for key, value in values.items():
        setattr(data, key, value)
    return link(name, data, at, turn)


def bays():
    """The middles of the bays, row by row."""
    return [(2 * (c - (COLUMNS - 1) / 2), 2 * ((ROWS - 1) / 2 - r)) for r in range(ROWS) for c in range(COLUMNS)]


def make_lamps():
    """Names of the bays' patches, in order."""
    grey, black = (with_shader(name, "ShaderNodeBsdfDiffuse", (value,) * 3) for name, value in (("grey", 0.6), ("black", 0)))
    rectangle("floor", grey, 2 * COLUMNS, 2 * ROWS, (0, 0, 0))
    for c in range(COLUMNS + 1):
        rectangle("wall", black, 3, 2 * ROWS, (2 * c - COLUMNS, 0, 1.5), (0, 90, 0))
    for r in range(ROWS + 1):
        rectangle("wall", black, 2 * COLUMNS, 3, (0, 2 * r - ROWS, 1.5), (90, 0, 0))
    none = {"shadow_soft_size": 0.0}
    cone = {"energy": 60.0, "spot_size": math.radians(80)}
    shine = {"Base_Color": (0.0, 0.0, 0.0), "Emission": (1.0, 0.8, 0.4), "Emission_Strength": 12.0}
    glow = with_shader("emission", "ShaderNodeEmission", (0.5, 0.7, 1.0))
    glow.node_tree.nodes["Emission"].inputs["Strength"].default_value = 12
    across = dict(energy=40.0, shape="RECTANGLE", size=0.5, size_y=0.2)
    places = {
        "point": lambda x, y: lamp("point", "POINT", (x - 0.7, y, 1), energy=40.0, color=(1, 0.5, 0.2), **none),
        "point of radius 0.1": lambda x, y: lamp("ball", "POINT", (x - 0.7, y, 1), energy=40.0, shadow_soft_size=0.1),
        "spot, sharp": lambda x, y: lamp("spot", "SPOT", (x - 0.7, y, 1.2), (0, -30, 0), spot_blend=0.0, **cone, **none),
        "spot, soft": lambda x, y: lamp("spot", "SPOT", (x - 0.7, y, 1.2), (0, -30, 0), spot_blend=0.9, **cone, **none),
        "area, square": lambda x, y: lamp("area", "AREA", (x - 0.7, y, 1), energy=40.0, size=0.3),
        "area, rectangle, turned": lambda x, y: lamp("area", "AREA", (x - 0.7, y, 1), (0, -30, 20), **across),
        "area, disk": lambda x, y: lamp("area", "AREA", (x - 0.7, y, 1), energy=40.0, shape="DISK", size=0.4),
        "area, ellipse, scaled": lambda x, y: setattr(lamp("area", "AREA", (x - 0.7, y, 1), **dict(across, shape="ELLIPSE")),
                                                      "scale", (1.5, 0.7, 1)),
        "lamp with nodes": lambda x, y: nodes_of(lamp("nodes", "POINT", (x - 0.7, y, 1), energy=10.0, **none).data),
        "emission": lambda x, y: rectangle("glow", glow, 0.3, 0.3, (x - 0.7, y, 1)),
        "principled emission": lambda x, y: rectangle("shine", principled("shine", **shine), 0.3, 0.3, (x - 0.7, y, 1),
                                                      (180, 0, 0)),
        "bounced": bounced,
        "sphere that shines": lambda x, y: ball("sphere", glow, 0.15, (x - 0.7, y, 1)),
    }
    for make, (x, y) in zip(places.values(), bays()):
        make(x, y)
    return list(places)


def nodes_of(light):
    light.use_nodes = True
    node = light.node_tree.nodes["Emission"]
    node.inputs["Color"].default_value, node.inputs["Strength"].default_value = (0.4, 0.6, 1, 1), 4


def bounced(x, y):
    """A lamp below a shade: the floor gets only what the red plate above sends back."""
    rectangle("plate", with_shader("red", "ShaderNodeBsdfDiffuse", (0.8, 0.2, 0.1)), 0.8, 1.6, (x - 0.5, y, 1.6))
    rectangle("shade", bpy.data.materials["black"], 0.6, 0.6, (x - 0.6, y, 1))
    lamp("below", "POINT", (x - 0.6, y, 1.1), energy=60.0, shadow_soft_size=0.0)


def make_sky():
    """It is evenly bright; and a floor below the surfaces."""
    background = bpy.context.scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.5, 0.6, 0.8, 1)
    background.inputs["Strength"].default_value = 0.5
    grey = with_shader("grey", "ShaderNodeBsdfDiffuse", (0.3, 0.3, 0.3))
    rectangle("floor", grey, 2 * COLUMNS, 2 * ROWS, (0, 0, -0.5))


def make_layers():
    """Without a sun: Cycles' coat is no GGX, and shows a small lamp in a wider circle."""
    make_sky()
    red, black = (0.8, 0.3, 0.2), (0.0, 0.0, 0.0)
    materials = {}
    for layer, values in {"bare": {}, "specular": {"Specular": 0.5}, "specular 1": {"Specular": 1.0, "Roughness": 0.2},
                          "coat": {"Clearcoat": 1.0}}.items():
        for below, colour in (("red", red), ("black", black)):
            if values or below == "red":
                name = f"{layer}, {below}"
                materials[name] = principled(name, Base_Color=colour, **values)
    for (name, material), (x, y) in zip(materials.items(), bays()):
        rectangle(name, material, 1.4, 1.4, (x, y, 0))
    return list(materials)


def make_surfaces():
    make_sky()
    lamp("sun", "SUN", (0, 0, 5), (20, 30, 0), energy=2.0, angle=0.0)
    red = (0.8, 0.3, 0.2)
    materials = {
        "diffuse": with_shader("diffuse", "ShaderNodeBsdfDiffuse", red),
        "principled, diffuse": principled("p0", Base_Color=red),
        "principled, usual": principled("p1", Base_Color=red, Specular=0.5),
        "picture": textured("picture"),
        "metal, rough 0.3": principled("m3", Base_Color=(0.9, 0.7, 0.3), Metallic=1.0, Roughness=0.3),
        "metal, rough 0.7": principled("m7", Base_Color=(0.9, 0.7, 0.3), Metallic=1.0, Roughness=0.7),
        "mirror": with_shader("mirror", "ShaderNodeBsdfGlossy", (0.9, 0.9, 0.9), 0.0),
        "emission": with_shader("glow", "ShaderNodeEmission", (0.2, 0.5, 0.3)),
        "half there": principled("half", Base_Color=red, Alpha=0.5),
        "glass": with_shader("glass", "ShaderNodeBsdfGlass", (1, 1, 1), 0.0),
        "coat": principled("coat", Base_Color=red, Clearcoat=1.0),
        "glass, rough": with_shader("rough glass", "ShaderNodeBsdfGlass", (0.9, 1, 1), 0.3),
        "glass, principled": principled("pg", Base_Color=(1.0, 0.8, 0.8), Transmission=1.0, Roughness=0.0, IOR=1.33, Specular=0.5),
        "specular 1": principled("p2", Base_Color=red, Specular=1.0, Roughness=0.2),
        "metal, half": principled("mh", Base_Color=(0.9, 0.7, 0.3), Metallic=0.5, Roughness=0.4),
        "no material": None,
    }
    for (name, material), (x, y) in zip(materials.items(), bays()):
        if "glass" in name:
            ball(name, material, 0.6, (x, y, 0.3))
        else:
            rectangle(name, material, 1.4, 1.4, (x, y, 0))
        if name == "half there" or "glass" in name:  # what is seen through it
            rectangle("behind", materials["emission"], 1.4, 1.4, (x, y, -0.4))
    return list(materials)


def make_parallel():
    camera = bpy.context.scene.camera.data
    camera.type, camera.ortho_scale = "ORTHO", 2 * COLUMNS
    return make_surfaces()


def make_outside():
    """A mirror ball; its patches have no names of their own."""
    ball("mirror", with_shader("mirror", "ShaderNodeBsdfGlossy", (1, 1, 1), 0.0), 6, (0, 0, 0))
    width, height = 16, 8
    picture = bpy.data.images.new("outside", width, height, float_buffer=True)
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    pixels = np.stack([1 + x / 4, np.where(x < 5, 2.0, 0.3), 1 + y / 2, np.ones_like(x)], axis=-1)
    picture.pixels.foreach_set(pixels.astype(np.float32).ravel())
    picture.pack()
    tree = bpy.context.scene.world.node_tree
    background, source, place, where = (tree.nodes["Background"], tree.nodes.new("ShaderNodeTexEnvironment"),
                                        tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord"))
    source.image = picture
    place.inputs["Rotation"].default_value = (0, 0, math.radians(40))
    background.inputs["Strength"].default_value = 0.5
    tree.links.new(where.outputs["Generated"], place.inputs["Vector"])
    tree.links.new(place.outputs["Vector"], source.inputs["Vector"])
    tree.links.new(source.outputs["Color"], background.inputs["Color"])
    return [f"part {i}" for i in range(COLUMNS * ROWS)]


def base_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle_x = "HORIZONTAL", 2 * math.atan(COLUMNS / HEIGHT)
    scene.camera = link("camera", camera, (0, 0, HEIGHT))
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.color_depth = "8"
    return scene


def set_engine(scene, engine, name):
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.samples = SAMPLES[name]
        scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
        scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.transmission_bounces = 32
        scene.cycles.sample_clamp_indirect = 0
        scene.cycles.blur_glossy = 0
        scene.cycles.pixel_filter_type = "BOX"
    else:
        settings = scene.ninefold
        settings.method, settings.frames, settings.local_clients = "path-trace", FRAMES[name], 2


def pixels_of_result(scene, folder, stem):
    """The linear picture [y, x, rgb], y downwards; also saved as .png."""
    result = bpy.data.images["Render Result"]
    result.save_render(str(folder / f"{stem}.png"))
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    path = folder / f"{stem}.exr"
    result.save_render(str(path))
    image = bpy.data.images.load(str(path))
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    width, height = image.size
    return values.reshape(height, width, 4)[::-1, :, :3].astype(float)


def patches(picture, names, right):
    """Means over 10x10 pixels in the middle of each bay, or `right` of it."""
    side = SIZE[0] // COLUMNS
    found = {}
    for i, name in enumerate(names):
        row, column = divmod(i, COLUMNS)
        top, left = row * side + side // 2, column * side + side // 2 + right
        found[name] = picture[top - 5:top + 5, left - 5:left + 5].mean(axis=(0, 1)).tolist()
    return found


def main():
    engine, name, folder = sys.argv[sys.argv.index("--") + 1:]
    scene = base_scene()
    names = {"lamps": make_lamps, "surfaces": make_surfaces, "layers": make_layers, "parallel": make_parallel,
             "outside": make_outside}[name]()
    set_engine(scene, engine, name)
    bpy.ops.render.render()
    picture = pixels_of_result(scene, pathlib.Path(folder), f"{engine}_{name}")
    (pathlib.Path(folder) / f"{engine}_{name}.json").write_text(json.dumps(patches(picture, names, 5 if name == "lamps" else 0)))


if __name__ == "__main__":
    main()
