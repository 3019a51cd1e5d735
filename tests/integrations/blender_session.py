"""Renders that go wrong, one after another, and what Blender says of them: run inside Blender for blender_test.py.

    blender -b --factory-startup --addons ninefold_render --python blender_session.py -- SESSION FOLDER

SESSION is a name at the end of this file. Prints for each render a line: OUTCOME {"what", "error" or "result", "mean"}.
"""
import json
import pathlib
import sys

import addon_utils
import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from blender_scenes import base_scene, lamp, link, pixels_of_result, rectangle, with_shader  # noqa: E402

FOLDER = pathlib.Path(sys.argv[-1])


def make_scene():
    scene = base_scene()
    scene.render.engine = "NINEFOLD"
    scene.render.resolution_x, scene.render.resolution_y = 48, 36
    grey = with_shader("grey", "ShaderNodeBsdfDiffuse", (0.5, 0.5, 0.5))
    rectangle("floor", grey, 40, 40, (0, 0, 0))
    rectangle("step", grey, 3, 3, (0, 0, 1))
    lamp("sun", "SUN", (0, 0, 5), energy=2.0, angle=0.0)
    scene.ninefold.frames, scene.ninefold.local_clients, scene.ninefold.method = 2, 1, "path-trace"
    return scene


def render(what):
    outcome = {"what": what}
    try:
        outcome["result"] = list(bpy.ops.render.render())
        outcome["mean"] = pixels_of_result(bpy.context.scene, FOLDER, what.replace(" ", "_")).mean()
    except RuntimeError as error:
        outcome["error"] = str(error)
    print("OUTCOME", json.dumps(outcome), flush=True)


def go_wrong(scene):
    camera, settings = scene.camera, scene.ninefold
    addon_utils.enable("ninefold_render", default_set=True)  # with preferences
    preferences = bpy.context.preferences.addons["ninefold_render"].preferences

    def wrong(what, owner, name, value):
        right = getattr(owner, name)
        setattr(owner, name, value)
        render(what)
        setattr(owner, name, right)

    wrong("no camera", scene, "camera", None)
    wrong("a panorama", camera.data, "type", "PANO")
    wrong("no square pixels", scene.render, "pixel_aspect_x", 2)
    wrong("a far shift", camera.data, "shift_x", 200)
    wrong("no program", preferences, "master", "/nowhere/ninefold-master")
    wrong("another program", preferences, "master", "/bin/true")
    wrong("no end", settings, "frames", 0)
    wrong("no client", settings, "local_clients", 0)
    wrong("no key", settings, "listen", "0.0.0.0:4700")
    wrong("no address", settings, "listen", "here")
    wrong("an address of another machine", settings, "listen", "192.0.2.1:4700")
    wrong("no such option", settings, "more", "--brightness 3")
    wrong("an open quotation", settings, "more", "--stats 'a")
    render("all right")


def look_outside(scene):
    """Pictures of what is outside that are none, or odd ones."""
    tree = scene.world.node_tree
    background, source = tree.nodes["Background"], tree.nodes.new("ShaderNodeTexEnvironment")
    background.inputs["Strength"].default_value = 1
    tree.links.new(source.outputs["Color"], background.inputs["Color"])

    def made(width, height, value):
        image = bpy.data.images.new("made", width, height, float_buffer=True)
        pixels = np.ones((height, width, 4), np.float32)
        pixels[0, 0, 1] = value
        image.pixels.foreach_set(pixels.ravel())
        image.pack()
        return image

    def broken(kind, suffix):
        image, path = made(64, 32, 1), FOLDER / f"broken.{suffix}"
        scene.render.image_settings.file_format = kind
        image.save_render(str(path), scene=scene)
        path.write_bytes(path.read_bytes()[:100])
        return bpy.data.images.load(str(path))

    for what, image in (("not a number", made(16, 8, float("nan"))), ("infinite", made(16, 8, float("inf"))),
                        ("negative", made(16, 8, -1)), ("one pixel", made(1, 1, 1)), ("two pixels", made(2, 1, 1)),
                        ("truncated HDR", broken("HDR", "hdr")), ("truncated EXR", broken("OPEN_EXR", "exr")),
                        ("large", bpy.data.images.new("large", 16384, 8192))):
        source.image = image
        render(what)
        bpy.data.images.remove(image)


def take_long(scene):
    scene.ninefold.frames, scene.ninefold.seconds = 0, 1000
    render("long")
    scene.ninefold.frames, scene.ninefold.seconds = 2, 0
    render("after that")


def converge(scene):
    """Tells each picture that is shown."""
    import ninefold_render
    engine = ninefold_render.NinefoldEngine
    show = engine.show

    def told(self, *arguments):
        show(self, *arguments)
        print("SHOWN 1", flush=True)

    engine.show = told
    scene.ninefold.frames, scene.ninefold.seconds = 0, 5
    render("converging")


def join_cluster(scene):
    scene.ninefold.local_clients, scene.ninefold.listen = 0, (FOLDER / "address").read_text()
    scene.ninefold.key_file = str(FOLDER / "cluster.key")
    render("first")
    render("second")


def give_passes(scene):
    """Saves the passes, as the compositor gets them, into one .exr."""
    scene.ninefold.passes = True
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    layers, files = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("CompositorNodeOutputFile")
    files.base_path, files.format.file_format, files.format.color_depth = str(FOLDER), "OPEN_EXR", "32"
    files.file_slots.clear()
    for output in [o for o in layers.outputs if o.enabled and o.name not in ("Image", "Alpha")]:
        files.file_slots.new(output.name)
        tree.links.new(output, files.inputs[-1])
    render("passes")
    values = {}
    for slot in files.file_slots:
        image = bpy.data.images.load(str(FOLDER / f"{slot.path}0001.exr"))
        pixels = np.array(image.pixels[:]).reshape(36, 48, 4)
        values[slot.path] = pixels[18, 24, :3].tolist()
    print("PASSES", json.dumps(values), flush=True)


def animate(scene):
    """The sun goes out in the second of three frames, and is back in the third above a floor that got darker."""
    sun = bpy.data.lights["sun"]
    for frame, energy in ((1, 2.0), (2, 0.0), (3, 1.0)):
        sun.energy = energy
        sun.keyframe_insert("energy", frame=frame)
    colour = bpy.data.materials["grey"].node_tree.nodes["Diffuse BSDF"].inputs["Color"]
    for frame, value in ((1, 0.5), (2, 0.5), (3, 0.25)):
        colour.default_value = (value, value, value, 1)
        colour.keyframe_insert("default_value", frame=frame)
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.filepath = str(FOLDER / "frame")
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    bpy.ops.render.render(animation=True)
    means = [float(np.array(bpy.data.images.load(str(FOLDER / f"frame{i:04}.exr")).pixels[:]).reshape(-1, 4)[:, 0].mean())
             for i in (1, 2, 3)]
    print("FRAMES", json.dumps(means), flush=True)


def key(owner, name, *values):
    """One frame after another."""
    for frame, value in enumerate(values, 1):
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)


def render_frames(scene, last):
    scene.frame_start, scene.frame_end = 1, last
    scene.render.filepath = str(FOLDER / "frame")
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    bpy.ops.render.render(animation=True)


def pixels(path):
    return np.array(bpy.data.images.load(str(path)).pixels[:]).reshape(36, 48, 4)[::-1, :, :3]


def move(scene):
    """Only places change in four frames: of things, one of them squeezed by its parent, of lamps of all kinds, of the camera. Then
    each frame by itself."""
    key(bpy.data.objects["step"], "location", (0, 0, 1), (1, 0, 1), (1, 1, 1.5), (-1, 0, 1))
    key(bpy.data.objects["step"], "scale", (1, 1, 1), (1, 1, 1), (0.5, 1, 1), (1, 2, 1))
    key(bpy.data.objects["sun"], "rotation_euler", (0, 0, 0), (0.5, 0, 0), (0, 0.5, 0), (0, 0, 1))
    key(scene.camera, "location", (0, 0, 14), (1, 0, 14), (0, 1, 13), (0, 0, 12))
    hand = link("hand", None)
    key(hand, "rotation_euler", (0, 0, 0), (0, 0, 0.4), (0, 0, 0.8), (0, 0, 1.2))
    for thing in (lamp("area", "AREA", (2, 1, 2), (20, 0, 0), energy=60.0, size=0.5),
                  lamp("ball", "POINT", (-2, 1, 2), energy=60.0, shadow_soft_size=0.2),
                  lamp("spot", "SPOT", (0, -2, 3), (20, 0, 0), energy=200.0, shadow_soft_size=0.0),
                  rectangle("child", bpy.data.materials["grey"], 1, 1, (2, -1, 0.5))):
        thing.parent = hand
    scene.ninefold.frames = 64
    render_frames(scene, 4)
    for frame in range(1, 5):
        scene.frame_set(frame)
        render(f"still {frame}")
        compare(frame)


def blur(scene):
    """Three frames with motion blur, then each by itself, then what has no blur: with a limit of noise,
    and of a sun that goes out."""
    key(bpy.data.objects["step"], "location", (0, 0, 1), (2, 0, 1), (4, 1, 1))
    scene.render.use_motion_blur = True
    scene.ninefold.frames = 64
    render_frames(scene, 3)
    for frame in range(1, 4):
        scene.frame_set(frame)
        render(f"still {frame}")
        compare(frame)
    scene.frame_set(2)
    scene.ninefold.error = 20
    render("limited")
    scene.ninefold.error = 0
    key(bpy.data.lights["sun"], "energy", 2.0, 0.0)
    render("changing")
    blurred, sharp = pixels(FOLDER / "still_2.exr"), pixels(FOLDER / "limited.exr")
    print("BLUR", float(abs(blurred - sharp).max()), flush=True)


def compare(frame):
    """The picture of an animation and the still of the same moment."""
    moved, still = pixels(FOLDER / f"frame{frame:04}.exr"), pixels(FOLDER / f"still_{frame}.exr")
    print("MOVED", json.dumps({"mean": float(still.mean()), "difference": float(abs(moved - still).mean())}), flush=True)


def move_for_long(scene):
    """Prints a line for each frame that is done."""
    key(bpy.data.objects["step"], "location", *[(i / 100, 0, 1) for i in range(300)])
    scene.ninefold.frames = 8
    bpy.app.handlers.render_post.append(lambda *_: print("FRAME", scene.frame_current, flush=True))
    try:
        render_frames(scene, 300)
    except RuntimeError as error:
        print("OUTCOME", json.dumps({"what": "many", "error": str(error)}), flush=True)
    bpy.app.handlers.render_post.clear()
    render("after that")


SESSIONS = {"wrong": go_wrong, "long": take_long, "converges": converge, "cluster": join_cluster, "passes": give_passes,
            "animation": animate, "moves": move, "blurred": blur, "pictures": look_outside, "many": move_for_long}

if __name__ == "__main__":
    SESSIONS[sys.argv[-2]](make_scene())
