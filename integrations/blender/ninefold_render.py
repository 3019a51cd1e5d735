"""Ninefold as a render engine of Blender (3.4 and later).

docs/blender.md tells how to install and use it.

    F12 ─► render(): .blend copy ─► a Blender without window: glTF
        ─► ninefold-master ─► .exr ─► passes

An animation whose frames differ by places alone goes to one master, as a glTF animation
(`Sequence`).

The exporter needs a context that render() does not have. A Blender of its own has one. There the
scene may be changed, so that the exporter sees what a render sees. This file is both: the add-on,
and what runs there (`export_main`).

Units: lamps become W/sr and W/m^2, emission W/(m^2 sr), as Cycles has them.
Threads: render() runs in a thread of Blender's, or in its main thread without a window. The
master's log has a thread here.
Errors: Trouble, told in one line in Blender's report area. Whatever happens, both programs are
ended before render() returns. They end by themselves when Blender dies.
"""
import atexit
import collections
import functools
import json
import math
import os
import pathlib
import queue
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import zlib

import bpy
import numpy as np
from mathutils import Matrix

bl_info = {
    "name": "Ninefold",
    "description": "Global illumination on a cluster of ordinary computers",
    "author": "The Ninefold developers",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties > Render Engine > Ninefold",
    "category": "Render",
}

MOST_PIXELS = 16384  # of a side, as the master takes them
WIDEST_PICTURE = 8192  # of what is outside, as the master takes it
EVERY = 2            # a new look at the picture so often [s]
PATIENCE = 20        # of an interrupted master, before it is killed [s]
FAR = 1e10           # Blender's depth where nothing is
PICTURES = "none|COLOR|FILE"  # in the help of a master that takes pictures of what is outside
EXPORT_FLAG = "--ninefold-export"
OPEN = 0.5  # of the second that a frame of the exported animation takes: its shutter, whatever Blender's

Pass = collections.namedtuple("Pass", "name channels id type source")
COMBINED = Pass("Combined", 4, "RGBA", "COLOR", ("R", "G", "B"))
PASSES = (
    Pass("Depth", 1, "Z", "VALUE", ("Z",)),
    Pass("Normal", 3, "XYZ", "VECTOR", ("N.x", "N.y", "N.z")),
    Pass("Albedo", 3, "RGB", "COLOR", ("albedo.R", "albedo.G", "albedo.B")),
    Pass("Irradiance", 3, "RGB", "COLOR", ("irradiance.R", "irradiance.G", "irradiance.B")),
    Pass("Caustic", 3, "RGB", "COLOR", ("caustic.R", "caustic.G", "caustic.B")),
    Pass("Error", 1, "X", "VALUE", ("error.Y",)),
    Pass("Object", 1, "X", "VALUE", ("objectId",)),
)


class Trouble(Exception):
    """What keeps a picture from being made, and what to do: one line."""


class Cancelled(Exception):
    """The user has had enough."""


# ---------------------------------------------------------------- pictures

def read_exr(path):
    """Size and channels of an OpenEXR file as the master writes it: {name: array[y, x]}, y upwards as in Blender.

    Scan lines of float or unsigned channels, stored plain or by ZIP: deflate over differences of bytes, the even ones of
    a block before the odd ones (openexr.com, "OpenEXR File Layout")."""
    data = pathlib.Path(path).read_bytes()
    if data[:4] != b"v/1\x01" or data[5] & 0x1A:
        raise Trouble(f"{path} is no OpenEXR picture of scan lines")
    attributes, at = {}, 8
    while data[at]:
        name_end = data.index(b"\0", at)
        kind_end = data.index(b"\0", name_end + 1)
        size, = struct.unpack_from("<i", data, kind_end + 1)
        start = kind_end + 5
        attributes[data[at:name_end]] = data[start:start + size]
        at = start + size
    at += 1
    left, bottom, right, top = struct.unpack("<4i", attributes[b"dataWindow"])
    width, height = right - left + 1, top - bottom + 1
    names, types = [], []
    listed = attributes[b"channels"]
    while listed[0]:
        name, listed = listed.split(b"\0", 1)
        names.append(name.decode())
        types.append({1: np.float16, 0: np.uint32, 2: np.float32}[struct.unpack_from("<i", listed)[0]])
        listed = listed[16:]
    lines = {0: 1, 2: 1, 3: 16}[attributes[b"compression"][0]]
    line_bytes = width * sum(np.dtype(t).itemsize for t in types)
    channels = {name: np.empty((height, width), np.float32) for name in names}
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        first, size = struct.unpack_from("<2i", data, offset)
        first -= bottom
        count = min(lines, height - first)
        block = _plain(data[offset + 8:offset + 8 + size], count * line_bytes)
        place = 0
        for y in range(first, first + count):
            for name, kind in zip(names, types):
                channels[name][height - 1 - y] = np.frombuffer(block, kind, width, place)
                place += width * np.dtype(kind).itemsize
    return width, height, channels


def _plain(block, size):
    """A block of scan lines without its compression."""
    if len(block) == size:
        return block
    coded = np.frombuffer(zlib.decompress(block), np.uint8).copy()
    coded[1:] -= 128
    split = np.cumsum(coded, dtype=np.uint8)
    plain = np.empty(size, np.uint8)
    half = (size + 1) // 2
    plain[0::2], plain[1::2] = split[:half], split[half:]
    return plain.tobytes()


def pass_values(kind, channels, shape):
    """What a pass holds, [y, x, channel] as Blender means it; zeros where the picture has no such channel."""
    height, width = shape
    if any(name not in channels for name in kind.source):
        return np.zeros((height, width, kind.channels), np.float32)
    planes = [channels[name] for name in kind.source]
    if kind.name == "Combined":
        planes.append(np.ones_like(planes[0]))
    elif kind.name == "Depth":
        planes = [np.where(planes[0] > 0, planes[0], np.float32(FAR))]
    elif kind.name == "Normal":
        planes = [planes[0], -planes[2], planes[1]]  # glTF has y upwards
    return np.stack(planes, axis=-1)


# ---------------------------------------------------------------- programs

class Program:
    """A program that is watched, ended when this object is closed, and by the kernel when Blender dies."""

    def __init__(self, command, **more):
        guard = shutil.which("setpriv")
        if guard:
            command = [guard, "--pdeathsig", "TERM", "--"] + command
        try:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                            text=True, errors="replace", **more)
        except OSError as error:
            raise Trouble(f"{command[0]} cannot be started: {error.strerror}") from error
        self.lines = queue.SimpleQueue()
        self.last = collections.deque(maxlen=20)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.last.append(line.rstrip())
            self.lines.put(line.rstrip())

    def follow(self, engine):
        """Its lines as they come, "" when none came for a while. Returns when it has ended. Raises Cancelled."""
        while True:
            if engine.test_break():
                raise Cancelled()
            try:
                yield self.lines.get(timeout=0.1)
            except queue.Empty:
                if not self.reader.is_alive() and self.lines.empty():
                    self.process.wait()
                    return
                yield ""

    def close(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.reader.join(1)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def master_path():
    addon = bpy.context.preferences.addons.get(__name__)
    stated = bpy.path.abspath(addon.preferences.master) if addon else ""
    found = shutil.which(stated or "ninefold-master")
    if found:
        return found
    raise Trouble(f"there is no program {stated}: correct the path in the preferences of the add-on Ninefold" if stated else
                  "ninefold-master is not in PATH: give its path in the preferences of the add-on Ninefold")


@functools.lru_cache
def flags_of(master, changed):  # `changed`: another build may know others
    """The names of the master's flags."""
    try:
        said = subprocess.run([master, "--help"], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL).stdout
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Trouble(f"{master} does not run: {error}") from error
    flags = {word for word in said.split() if word.startswith("--")}
    if "--local-clients" not in flags:
        raise Trouble(f"{master} is no ninefold-master: correct the path in the preferences of the add-on Ninefold")
    return flags | ({PICTURES} if PICTURES in said else set())


def master_command(master, flags, settings, scene, exported, folder, passes):
    """The command line; refuses what cannot come to an end."""
    s, (width, height) = settings, exported["size"]
    command = [master, scene, "--size", f"{width}x{height}", "--seed", str(s.seed), "--method", s.method,
               "--output", str(folder / ("picture.####.exr" if is_played(exported) else "picture.exr")),
               "--environment", exported["environment"], "--local-clients", str(s.local_clients)]
    if not (s.frames or s.seconds or s.error):
        raise Trouble("nothing ends the render: set frames, a time limit or a noise limit")
    if s.local_clients == 0 and not s.listen:
        raise Trouble("no client can come: set local clients, or an address to listen at")
    for flag, value in (("--frames", s.frames), ("--seconds", s.seconds), ("--until-error", s.error / 100), ("--listen", s.listen),
                        ("--key-file", bpy.path.abspath(s.key_file)), ("--denoise", "on" if s.denoise else "")):
        if value:
            command += [flag, f"{value:.7g}" if isinstance(value, float) else str(value)]
    usual = {"--light-units": "radiometric"}
    if is_played(exported):
        usual["--animate"] = f"0:{exported['frames'] - 1 + exported['shutter']}:1"
        if exported["shutter"]:
            command += ["--shutter", str(exported["shutter"])]
    else:
        usual["--save-every"] = str(EVERY)
    for flag, value in usual.items():
        if flag in flags:
            command += [flag, value]
    if passes:
        command.append("--aovs")
    try:
        return command + shlex.split(s.more)
    except ValueError as error:
        raise Trouble(f"more options: {error}") from error


def exporter_environment():
    """Where Blender's own scripts lie in a folder of the system's, as those of Debian's package do,
    Python would compile them at each start: half a second. A cache of the user's keeps them."""
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return {"PYTHONPYCACHEPREFIX": os.path.join(cache, "ninefold-blender"), **os.environ}


def complaint(program, what):
    """Why a program ended badly."""
    status = program.process.returncode
    if status < 0 or status > 128:
        return f"{what}: killed by signal {abs(status) % 128}; render again, the system's log may tell why"
    told = [line for line in program.last if line and not line.startswith("progress:")]
    return f"{what}: {told[-1] if told else f'ended with status {status}'}"


# ---------------------------------------------------------------- animations

class Job:
    """A picture that is asked for, and what pictures of one sequence have in common."""

    def __init__(self, depsgraph, engine, master):
        scene = depsgraph.scene
        self.frame = scene.frame_current
        self.layer = depsgraph.view_layer.name
        self.master = master
        settings = [getattr(scene.ninefold, name) for name in NinefoldSettings.__annotations__]
        self.alike = (scene.name, self.layer, master, engine.resolution_x, engine.resolution_y,
                      shutter_of(scene), *settings)


def frames_ahead(scene):
    return list(range(scene.frame_current, scene.frame_end + 1, scene.frame_step))


def can_play(scene):
    """Whether the master can make pictures by playing an animation: by a number of frames, in one layer, radiance alone."""
    s = scene.ninefold
    limited = s.seconds or s.error or s.passes or s.denoise
    return bool(s.frames) and not limited and sum(l.use for l in scene.view_layers) == 1


def is_played(exported):
    return exported["frames"] > 1 or exported["shutter"] > 0


def shutter_of(scene):
    """When the shutter opens, is half through and closes, in frames after a picture's own. None without motion blur."""
    render = scene.render
    if not render.use_motion_blur:
        return None
    # It was Cycles' own before Blender 4.2.
    owner = render if hasattr(render, "motion_blur_position") else getattr(scene, "cycles", None)
    length = render.motion_blur_shutter
    opens = {"START": 0, "END": -length}.get(getattr(owner, "motion_blur_position", "CENTER"), -length / 2)
    return opens, opens + length / 2, opens + length


class Sequence:
    """Frames of an animation that one master makes, each as soon as it can. Blender asks for them one by one."""
    latest = None  # at most one

    def __init__(self, job, program, folder, frames, crop):
        self.alike, self.program, self.folder, self.frames, self.crop = job.alike, program, folder, frames, crop
        self.made = 0  # pictures

    def goes_on(self, job):
        return job.alike == self.alike and job.frame in self.frames[self.made:]

    def wait_for(self, frame, engine):
        """The file of its picture. Those before it were not asked for."""
        number = self.frames.index(frame)
        wanted = f"picture {number + 1} of {len(self.frames)} in "
        for line in self.program.follow(engine):
            if line.startswith("warning: "):
                engine.report({"WARNING"}, f"Ninefold: {line[len('warning: '):]}")
            if wanted in line:
                self.made = number + 1
                engine.update_progress(self.made / len(self.frames))
                return self.folder / f"picture.{number:04}.exr"
        raise Trouble(complaint(self.program, "the master"))

    @classmethod
    def end(cls, *_):
        """The master has no more to do."""
        ended, cls.latest = cls.latest, None
        if ended:
            ended.program.close()
            shutil.rmtree(ended.folder, ignore_errors=True)


@bpy.app.handlers.persistent
def end_sequence(*_):
    Sequence.end()


# ---------------------------------------------------------------- the engine

class NinefoldEngine(bpy.types.RenderEngine):
    bl_idname = "NINEFOLD"
    bl_label = "Ninefold"
    bl_use_preview = False
    bl_use_eevee_viewport = True  # materials look alike there, as far as it can
    bl_use_shading_nodes_custom = False

    def update_render_passes(self, scene, layer):
        for kind in (COMBINED,) + (PASSES if scene.ninefold.passes else ()):
            self.register_pass(scene, layer, kind.name, kind.channels, kind.id, kind.type)

    def render(self, depsgraph):
        try:
            settings = depsgraph.scene.ninefold
            master = master_path()
            job = Job(depsgraph, self, master)
            if not Sequence.latest or not Sequence.latest.goes_on(job):
                Sequence.end()
                self.check(depsgraph.scene)
                self.begin(job, depsgraph, settings)
            elif self.show_next(Sequence.latest, job):
                Sequence.end()
        except Cancelled:
            Sequence.end()
        except Trouble as trouble:
            Sequence.end()
            self.report({"ERROR"}, f"Ninefold: {trouble}")

    def begin(self, job, depsgraph, settings):
        """A picture, or the first one of a sequence."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="ninefold-"))
        try:
            flags = flags_of(job.master, os.path.getmtime(job.master))
            frames = frames_ahead(depsgraph.scene) if self.is_animation and can_play(depsgraph.scene) else [job.frame]
            exported = self.export(folder, depsgraph, PICTURES in flags, frames)
            for warning in exported["warnings"]:
                self.report({"WARNING"}, f"Ninefold: {warning}")
            passes = PASSES if settings.passes else ()
            command = master_command(job.master, flags, settings, str(folder / "scene.gltf"), exported, folder, passes)
            if is_played(exported):
                Sequence.latest = Sequence(job, Program(command, cwd=folder), folder, frames[:exported["frames"]], exported["crop"])
                if self.show_next(Sequence.latest, job):
                    Sequence.end()
                return
            with Program(command, cwd=folder) as program:
                self.gather(program, folder / "picture.exr", exported["crop"], passes, depsgraph.view_layer.name)
        finally:
            if not Sequence.latest:
                shutil.rmtree(folder, ignore_errors=True)

    def show_next(self, sequence, job):
        """Shows the job's frame. True if there is none after it."""
        left, bottom, width, height = sequence.crop
        result = self.begin_result(0, 0, width, height, layer=job.layer)
        try:
            if len(sequence.frames) > 1:
                self.update_stats("", f"Rendering {len(sequence.frames)} frames of an animation")
            picture = sequence.wait_for(job.frame, self)
            self.show(result, picture, sequence.crop)
        except (Cancelled, Trouble):
            self.end_result(result, cancel=True)
            raise
        self.end_result(result)
        picture.unlink()
        return job.frame == sequence.frames[-1]

    def check(self, scene):
        """Refuses what would be a wrong picture."""
        camera = scene.camera
        if camera is None or camera.type != "CAMERA":
            raise Trouble("the scene has no camera")
        if camera.data.type not in {"PERSP", "ORTHO"}:
            raise Trouble(f"camera {camera.name} is panoramic: make it perspective or orthographic")
        if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
            raise Trouble("pixels must be square: set both aspects in the output's format to 1")

    def export(self, folder, depsgraph, pictures, frames):
        """The scene as glTF in `folder`, by another Blender, and what that said of it. With it the places of things in those
        `frames` that follow, as far as nothing else changes."""
        self.update_stats("", "Exporting the scene")
        scene = depsgraph.scene.original
        copy = folder / "scene.blend"
        order = {"blend": str(copy), "scene": scene.name, "layer": depsgraph.view_layer.name, "frame": scene.frame_current,
                 "subframe": scene.frame_subframe, "resolution": [self.resolution_x, self.resolution_y],
                 "folder": str(folder), "pictures": pictures, "frames": frames[1:],
                 "blur": can_play(depsgraph.scene) and depsgraph.scene.ninefold.frames > 1}
        trust = "--enable-autoexec" if bpy.context.preferences.filepaths.use_scripts_auto_execute else "--disable-autoexec"
        command = [bpy.app.binary_path, "--background", "--factory-startup", trust, "--python-exit-code", "1", "--python",
                   os.path.abspath(__file__), "--", EXPORT_FLAG, json.dumps(order)]
        with Program(command, env=exporter_environment()) as program:
            unfinished = folder / "unfinished.blend"  # while the other one starts
            bpy.data.libraries.write(str(unfinished), {scene}, path_remap="ABSOLUTE", fake_user=True)
            unfinished.rename(copy)
            for _ in program.follow(self):
                pass
        said = folder / "export.json"
        if program.process.returncode or not said.exists():
            raise Trouble(complaint(program, "the scene cannot be exported"))
        return json.loads(said.read_text())

    def gather(self, program, picture, crop, passes, layer):
        """Shows the picture as it converges, until the master ends."""
        left, bottom, width, height = crop
        for kind in passes:
            self.add_pass(kind.name, kind.channels, kind.id)
        result = self.begin_result(0, 0, width, height, layer=layer)
        shown = False
        try:
            for line in program.follow(self):
                if line.startswith("progress: "):
                    self.tell(line[len("progress: "):])
                elif " frame(s) in " in line:
                    self.show(result, picture, crop)
                    shown = True
                elif line.startswith("warning: "):
                    self.report({"WARNING"}, f"Ninefold: {line[len('warning: '):]}")
        except Cancelled:
            program.close()  # the master leaves the picture so far
            if picture.exists():
                self.show(result, picture, crop)
            self.end_result(result, cancel=not picture.exists())
            raise
        self.end_result(result, cancel=not shown)
        if program.process.returncode:
            raise Trouble(complaint(program, "the master"))

    def tell(self, text):
        percent = text.split("%")[0]
        if percent.isdigit():
            self.update_progress(int(percent) / 100)
        self.update_stats("", text)

    def show(self, result, picture, crop):
        left, bottom, width, height = crop
        *_, channels = read_exr(picture)
        known = {kind.name: kind for kind in (COMBINED,) + PASSES}
        seen = {name: plane[bottom:bottom + height, left:left + width] for name, plane in channels.items()}
        # What a view layer asks for beside ours stays black.
        values = [pass_values(known[p.name], seen, (height, width)).ravel() if p.name in known else
                  np.zeros(width * height * p.channels, np.float32) for p in result.layers[0].passes]
        result.layers[0].passes.foreach_set("rect", np.concatenate(values))
        self.update_result(result)


class NinefoldPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    master: bpy.props.StringProperty(name="ninefold-master", subtype="FILE_PATH",
                                     description="The program; empty: the one in PATH")

    def draw(self, _):
        self.layout.prop(self, "master")


class NinefoldSettings(bpy.types.PropertyGroup):
    method: bpy.props.EnumProperty(name="Method", default="instant-radiosity", description="How light is computed", items=[
        ("instant-radiosity", "Instant Radiosity", "Virtual lights and caustic photons"),
        ("bidirectional", "Bidirectional", "Virtual lights chosen for the camera; finds light that comes round corners"),
        ("auto", "Automatic", "One of both kinds of instant radiosity, as a short trial tells"),
        ("photon-map", "Photon Map", "A rolling pool of photons; blurs bounced light"),
        ("selective-photons", "Selective Photons", "Light kept in mesh elements; blurs bounced light"),
        ("intersection-field", "Intersection Field", "Light among lines that are drawn through the scene; blurs"),
        ("path-trace", "Path Tracing", "The slow, unbiased reference")])
    frames: bpy.props.IntProperty(name="Frames", default=64, min=0, soft_max=4096,
                                  description="Frames that the picture is the mean of; 0: no limit")
    seconds: bpy.props.FloatProperty(name="Time Limit", default=0, min=0, unit="TIME_ABSOLUTE", description="0: none")
    error: bpy.props.FloatProperty(name="Noise Limit", default=0, min=0, max=100, precision=2, subtype="PERCENTAGE",
                                   description="Ends when the picture's relative standard error is below this; 0: none")
    seed: bpy.props.IntProperty(name="Seed", default=1, min=0)
    denoise: bpy.props.BoolProperty(name="Denoise", description="A last touch of filtering, by no more than the noise")
    passes: bpy.props.BoolProperty(name="Passes", description="Depth, normal, albedo, irradiance, caustic, error and object",
                                   update=lambda self, _: self.id_data.view_layers.update())
    local_clients: bpy.props.IntProperty(name="Local Clients", default=os.cpu_count() or 1, min=0, max=1024,
                                         description="Processes that render on this machine; 0: only others render")
    listen: bpy.props.StringProperty(name="Listen At", description="ADDR:PORT where other machines' clients connect, such as "
                                                                   "0.0.0.0:4700; empty: none")
    key_file: bpy.props.StringProperty(name="Key File", subtype="FILE_PATH",
                                       description="The cluster's key (ninefold-master --new-key FILE makes one)")
    more: bpy.props.StringProperty(name="More Options", description="Of ninefold-master, as its --help lists them")


class NinefoldPanel(bpy.types.Panel):
    bl_idname = "RENDER_PT_ninefold"
    bl_label = "Ninefold"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {NinefoldEngine.bl_idname}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def draw(self, context):
        layout, settings = self.layout, context.scene.ninefold
        layout.use_property_split = True
        layout.use_property_decorate = False
        for names in (("method", "seed"), ("frames", "seconds", "error"), ("denoise", "passes"),
                      ("local_clients", "listen", "key_file"), ("more",)):
            column = layout.column()
            for name in names:
                column.prop(settings, name)


def shared_panels():
    """Blender's own panels of what is carried over: those of every engine, and of Eevee's those of lamps and surfaces."""
    unfit = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_freestyle", "RENDER_PT_gpencil", "DATA_PT_light"}
    eevee = {"EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "EEVEE_WORLD_PT_surface", "DATA_PT_EEVEE_light"}
    for panel in bpy.types.Panel.__subclasses__():
        if panel.__name__ in eevee or ("BLENDER_RENDER" in getattr(panel, "COMPAT_ENGINES", ()) and panel.__name__ not in unfit):
            yield panel


MOMENTS_OF_AN_END = ("render_complete", "render_cancel", "load_pre")
CLASSES = (NinefoldPreferences, NinefoldSettings, NinefoldEngine, NinefoldPanel)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.ninefold = bpy.props.PointerProperty(type=NinefoldSettings)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add(NinefoldEngine.bl_idname)
    for moment in MOMENTS_OF_AN_END:
        getattr(bpy.app.handlers, moment).append(end_sequence)
    atexit.register(Sequence.end)


def unregister():
    Sequence.end()
    atexit.unregister(Sequence.end)
    for moment in MOMENTS_OF_AN_END:
        getattr(bpy.app.handlers, moment).remove(end_sequence)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard(NinefoldEngine.bl_idname)
    del bpy.types.Scene.ninefold
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)


# ---------------------------------------------------------------- what runs in a Blender of its own

class Exporter:
    """Writes the scene of a .blend copy as `folder`/scene.gltf, and export.json: {size, crop, environment, warnings, frames,
    shutter}.

    What a render sees is made anew as plain meshes, one a mesh and material, placed as often as it is seen: so the glTF exporter
    needs to know nothing of modifiers, instances, poses and parents. Lamps, camera and what else it does not say as Cycles
    means it are put into its file afterwards."""

    def __init__(self, order):
        self.order = order
        self.warnings = []
        self.parts = []      # of what is seen, in its order; the camera at the end
        self.punctual = []   # (light, radiant quantity, part)
        self.meshes = {}     # by what they were made of
        self.none = None     # the material of what has none
        self.files = pathlib.Path(order["folder"])

    def run(self):
        scene = self.load()
        self.show_as_rendered(scene)
        bpy.context.evaluated_depsgraph_get()  # from now on what is animated reaches lamps and materials themselves
        scene.frame_set(self.order["frame"], subframe=self.order["subframe"])
        for material in bpy.data.materials:
            self.prepare(material)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        camera = scene.camera.evaluated_get(depsgraph).data
        size, crop, lens = frame_of(camera, scene.render, self.order["resolution"])
        self.warn_of_the_rest(scene, camera)
        environment = self.environment_of(scene.world)
        first = self.what_is_there(scene)
        plain = bpy.data.scenes.new("plain")
        self.realise(plain, depsgraph)
        bpy.context.window.scene = plain
        self.write(plain)
        bpy.context.window.scene = scene
        frames = self.frames(scene, first)
        path = self.files / "scene.gltf"
        gltf = json.loads(path.read_text())
        self.complete(gltf, lens)
        self.animate(gltf, first.places, frames)
        path.write_text(json.dumps(gltf))
        (self.files / "export.json").write_text(json.dumps(
            {"size": size, "crop": crop, "environment": environment, "warnings": self.warnings, "frames": len(frames),
             "shutter": OPEN if len(frames[0]) > 1 else 0}))

    def warn_of_the_rest(self, scene, camera):
        for is_on, what in ((camera.dof.use_dof, "depth of field"), (scene.render.film_transparent, "transparent film")):
            if is_on:
                self.warn(f"there is no {what}: it is left out")

    def warn(self, text):
        if text not in self.warnings:
            self.warnings.append(text)

    def load(self):
        while not os.path.exists(self.order["blend"]):  # who writes it ends this program if it cannot
            time.sleep(0.005)
        with bpy.data.libraries.load(self.order["blend"]) as (_, wanted):
            wanted.scenes = [self.order["scene"]]
        scene = wanted.scenes[0]
        bpy.context.window.scene = scene
        bpy.context.window.view_layer = scene.view_layers[self.order["layer"]]
        return scene

    def show_as_rendered(self, scene):
        """This Blender only knows the viewport: it gets the render's eyes."""
        for thing in list(bpy.data.objects) + list(bpy.data.collections):
            thing.hide_viewport = thing.hide_render
        show_layers(bpy.context.view_layer.layer_collection)
        for thing in scene.objects:
            thing.hide_set(False)
        for thing in bpy.data.objects:
            for modifier in thing.modifiers:
                modifier.show_viewport = modifier.show_render
                for shown, rendered in (("levels", "render_levels"), ("screw_steps", "render_steps")):
                    if hasattr(modifier, rendered) and hasattr(modifier, shown):
                        setattr(modifier, shown, getattr(modifier, rendered))
            if thing.type in {"CURVE", "SURFACE", "FONT"} and thing.data.render_resolution_u:
                thing.data.resolution_u = thing.data.render_resolution_u
            elif thing.type == "META":
                thing.data.resolution = thing.data.render_resolution
        scene.render.simplify_subdivision = scene.render.simplify_subdivision_render
        scene.render.simplify_child_particles = scene.render.simplify_child_particles_render

    def seen(self, depsgraph):
        """Things and their places; meshes: so come curves, texts and metaballs, too. A thing is only there until the next one."""
        for instance in depsgraph.object_instances:
            if not instance.show_self:
                continue
            thing = instance.object
            if thing.type in {"MESH", "LIGHT"}:
                yield thing, instance.matrix_world.copy()
            elif thing.type in {"VOLUME", "CURVES", "POINTCLOUD", "GPENCIL", "GREASEPENCIL"}:
                self.warn(f"{thing.name} is left out: glTF has no {thing.type.lower()}")

    def what_is_there(self, scene):
        """At the scene's frame: what is seen, but for the places; and these, the camera's at the end."""
        depsgraph = bpy.context.evaluated_depsgraph_get()
        camera = scene.camera.evaluated_get(depsgraph)
        there, places = [frame_of(camera.data, scene.render, self.order["resolution"]), animated_values(scene)], []
        shapes = {}
        for thing, matrix in self.seen(depsgraph):
            places.append(matrix)
            if not (self.order["frames"] or scene.render.use_motion_blur):  # nobody compares
                continue
            if thing.type == "LIGHT":
                there.append(self.lamp_values(thing.data.original, matrix))
                continue
            key = thing.data.as_pointer()
            if key not in shapes:
                shapes[key] = shape_print(thing.data)
            there.append((thing.name, shapes[key], materials_of(thing), None if is_upright(matrix) else tuple(map(tuple, matrix))))
        return Seen(there, places + [camera.matrix_world.copy()])

    def frames(self, scene, first):
        """Places of this frame and those that follow, as long as nothing but places changes: of each at its moments, which are
        one, or three where it is blurred."""
        moments = self.moments(scene)
        if moments == (0,) and not self.order["frames"]:
            return [[first.places]]
        found = []
        for frame in (self.order["frame"] + self.order["subframe"], *self.order["frames"]):
            places = self.places_at(scene, first, [frame + moment for moment in moments])
            if places is None:
                break
            found.append(places)
        if not found and len(moments) > 1:
            self.warn("motion blur is of places alone: it is left out where something else changes while the shutter is open")
        moves = any(places != first.places for frame in found for places in frame)
        return found if moves or len(found) > 1 else [[first.places]]

    def moments(self, scene):
        """Of a picture, in frames after its own."""
        shutter = shutter_of(scene)
        if shutter and not self.order["blur"]:
            self.warn("motion blur needs two frames or more, and no limit of time or noise, passes, "
                      "denoising or second view layer: it is left out")
        return shutter if shutter and self.order["blur"] else (0,)

    def places_at(self, scene, first, times):
        """None if something else differs from what is there first."""
        found = []
        for time in times:
            scene.frame_set(math.floor(time), subframe=time - math.floor(time))
            seen = self.what_is_there(scene)
            if seen.there != first.there:
                return None
            found.append(seen.places)
        return found

    def realise(self, plain, depsgraph):
        """All that is seen, in the scene `plain`, and lamps that are none there in `punctual`; all in `parts`, in their order."""
        for thing, matrix in self.seen(depsgraph):
            if thing.type == "LIGHT":
                self.place_lamp(plain, thing.data.original, matrix)
                continue
            mesh = self.mesh_of(thing)
            made = add_object(plain, thing.name, *upright(mesh, matrix)) if mesh.polygons else None
            self.parts.append(Part(made and made.name, lambda place: Y_UP @ place @ Y_UP.inverted()))
        self.parts.append(Part(None, lambda place: Y_UP @ unscaled(place)))  # the camera

    def mesh_of(self, thing):
        key = (thing.original.as_pointer(), thing.data.as_pointer(), materials_of(thing))
        if key not in self.meshes:
            mesh = thing.data.copy()
            for slot, place in zip(thing.material_slots, range(len(mesh.materials))):
                mesh.materials[place] = slot.material.original if slot.material else self.grey()
            if not mesh.materials:
                mesh.materials.append(self.grey())
            if thing.particle_systems and any(s.settings.render_type == "PATH" for s in thing.particle_systems):
                self.warn(f"the hair of {thing.name} is left out")
            self.meshes[key] = mesh
        return self.meshes[key]

    # ------------------------------------------------------------ materials

    def grey(self):
        """What a surface without material looks like."""
        if self.none is None:
            self.none = bpy.data.materials.new("no material")
            self.prepare(self.none)
        return self.none

    def prepare(self, material):
        """As Cycles sees it: both sides, transparent where it says so; and a plain shader as the one the exporter knows."""
        material.use_backface_culling = False
        if not material.use_nodes or material.node_tree is None:
            return as_diffuse(material)
        tree = material.node_tree
        output = tree.get_output_node("CYCLES") or tree.get_output_node("ALL")
        if output is None or not output.inputs["Surface"].is_linked:
            return self.warn(f"material {material.name} has no surface: it is rendered white")
        shader = output.inputs["Surface"].links[0].from_node
        if shader.type in PLAIN_SHADERS:
            shader = principled_for(tree, shader, output)
        if shader.type not in {"BSDF_PRINCIPLED", "EMISSION"}:
            self.warn(f"material {material.name}: the exporter cannot tell all that its node {shader.name} does")
        elif shader.type == "BSDF_PRINCIPLED":
            alpha = shader.inputs["Alpha"]
            if getattr(material, "blend_method", "") == "OPAQUE" and (alpha.is_linked or alpha.default_value < 1):
                material.blend_method = "HASHED"
            for name in UNTOLD:
                socket = shader.inputs.get(name)
                if socket and (socket.is_linked or socket.default_value):
                    self.warn(f"material {material.name}: {name} is not carried over")
        for name in ("Volume", "Displacement"):
            if output.inputs[name].is_linked:
                self.warn(f"material {material.name}: its {name.lower()} is not carried over")

    # ------------------------------------------------------------ light

    def environment_of(self, world):
        """The value of --environment."""
        if world is None:
            return "none"
        if not world.use_nodes:
            return colour_text(world.color)
        output = world.node_tree.get_output_node("CYCLES") or world.node_tree.get_output_node("ALL")
        node = output and output.inputs["Surface"].is_linked and output.inputs["Surface"].links[0].from_node
        if not node:
            return "none"
        if node.type != "BACKGROUND":
            self.warn(f"world {world.name}: only a Background node is carried over; it is rendered black")
            return "none"
        colour, strength = node.inputs["Color"], node.inputs["Strength"]
        if strength.is_linked:
            self.warn(f"world {world.name}: what is linked to Strength is left out")
        if not colour.is_linked:
            return colour_text([c * strength.default_value for c in colour.default_value[:3]])
        source = colour.links[0].from_node
        if source.type != "TEX_ENVIRONMENT" or source.image is None:
            self.warn(f"world {world.name}: its colour by nodes is not carried over; it is rendered black")
            return "none"
        picture = self.checked_picture(world, source.image)
        width, height = picture.size
        if self.order["pictures"] and source.projection == "EQUIRECTANGULAR" and width == 2 * height:
            return self.picture_of(world, source, picture, strength.default_value)
        self.warn(f"world {world.name}: its picture is carried over as its mean colour")
        return colour_text([c * strength.default_value for c in mean_radiance(picture)])

    def checked_picture(self, world, picture):
        """No larger than the master takes it."""
        width, height = picture.size
        if width == 0:
            name = picture.filepath or picture.name
            raise Trouble(f"world {world.name}: its picture {name} cannot be read: mend it, or unlink it")
        if width > WIDEST_PICTURE:
            self.warn(f"world {world.name}: its picture of {width}x{height} is carried over {WIDEST_PICTURE} pixels wide")
            picture = picture.copy()
            picture.scale(WIDEST_PICTURE, round(height * WIDEST_PICTURE / width))
        if picture.is_float and not np.isfinite(pixels_of(picture)).all():
            raise Trouble(f"world {world.name}: its picture {picture.name} has values that are no finite numbers: mend it")
        return picture

    def picture_of(self, world, source, picture, strength):
        """FILE:ROTATION:STRENGTH; the picture's middle is +x for both. A turned place of looking turns the picture back."""
        name, turn = "environment.exr", 0
        if source.inputs["Vector"].is_linked:
            node = source.inputs["Vector"].links[0].from_node
            if node.type == "MAPPING" and node.vector_type in {"POINT", "TEXTURE"}:
                x, y, z = node.inputs["Rotation"].default_value
                turn = math.degrees(z) * (-1 if node.vector_type == "POINT" else 1)
                if x or y or any(node.inputs["Location"].default_value) or tuple(node.inputs["Scale"].default_value) != (1, 1, 1):
                    self.warn(f"world {world.name}: of its Mapping only the turn about z is carried over")
            elif node.type != "TEX_COORD":
                self.warn(f"world {world.name}: how its picture is placed is not carried over")
        saver = bpy.data.scenes.new("saver")
        saver.render.image_settings.file_format, saver.render.image_settings.color_depth = "OPEN_EXR", "32"
        picture.save_render(str(self.files / name), scene=saver)
        return f"{name}:{turn:.9g}:{strength:.9g}" if strength > 0 else "none"

    def place_lamp(self, plain, light, matrix):
        """One with a size is a surface that shines."""
        colour = self.power_of(light)
        if light.type == "AREA":
            made = add_shining(plain, light.name, area_mesh(light), matrix, lambda area: [c / (4 * area) for c in colour])
            if light.spread < math.pi - 1e-3:
                self.warn(f"lamp {light.name}: its spread is left out, it lights the whole half space")
        elif light.type == "POINT" and light.shadow_soft_size > 0:
            made = add_shining(plain, light.name, ball_mesh(light.shadow_soft_size), unscaled(matrix),
                               lambda area: [c / (math.pi * area) for c in colour])
        else:
            if light.type == "SUN" and light.angle > 0.02:
                self.warn(f"sun {light.name}: its angle is left out, shadows are sharp")
            part = Part(None, lambda place: Y_UP @ unscaled(place))
            self.punctual.append((light, colour if light.type == "SUN" else [c / (4 * math.pi) for c in colour], part))
            self.parts.append(part)
            return
        self.parts.append(Part(made and made.name, lambda place: Y_UP @ unscaled(place) @ Y_UP.inverted()))

    def lamp_values(self, light, matrix):
        """All that counts but its place."""
        names = ("type", "shadow_soft_size", "angle", "spread", "shape", "size", "size_y", "spot_size", "spot_blend")
        return (light.name, self.power_of(light), [getattr(light, name, None) for name in names],
                [round(side, 6) for side in matrix.to_scale()])

    def power_of(self, light):
        """Colour times strength, as the light's panel means them: [W], of a sun [W/m^2]."""
        colour = [c * light.energy for c in light.color]
        if not light.use_nodes or light.node_tree is None:
            return colour
        output = light.node_tree.get_output_node("CYCLES") or light.node_tree.get_output_node("ALL")
        node = output and output.inputs["Surface"].is_linked and output.inputs["Surface"].links[0].from_node
        if not node or node.type != "EMISSION":
            self.warn(f"lamp {light.name}: its nodes are left out")
            return colour
        if node.inputs["Color"].is_linked or node.inputs["Strength"].is_linked:
            self.warn(f"lamp {light.name}: what is linked to its Emission is left out")
        strength = node.inputs["Strength"].default_value
        return [c * n * strength for c, n in zip(colour, node.inputs["Color"].default_value)]

    # ------------------------------------------------------------ the file

    def write(self, scene):
        wanted = {"filepath": str(self.files / "scene.gltf"), "export_format": "GLTF_SEPARATE", "use_active_scene": True,
                  "export_yup": True, "export_apply": False, "export_animations": False, "export_skins": False,
                  "export_morph": False, "export_lights": False, "export_cameras": False, "export_extras": False}
        known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
        bpy.ops.export_scene.gltf(**{name: value for name, value in wanted.items() if name in known})

    def complete(self, gltf, lens):
        """What the exporter does not say, or not as Cycles means it."""
        gltf["asset"]["generator"] = "Ninefold for Blender"  # lamps are in W/sr, whoever wrote the rest
        for material in gltf.get("materials", []):
            extensions = material.get("extensions", {})
            if "KHR_materials_transmission" in extensions:  # Cycles refracts, glTF's alone is a thin wall
                extensions.setdefault("KHR_materials_volume", {"thicknessFactor": 1})
                use_extension(gltf, "KHR_materials_volume")
            specular = extensions.get("KHR_materials_specular", {})
            if specular.get("specularColorFactor") == [0, 0, 0]:  # glTF's alone still reflects at grazing angles
                specular["specularFactor"] = 0
        nodes = gltf.setdefault("nodes", [])
        by_name = {node["name"]: i for i, node in enumerate(nodes)}
        for part in self.parts:
            part.node = by_name.get(part.name)
        roots = gltf["scenes"][gltf.get("scene", 0)].setdefault("nodes", [])

        def add_node(part, node):
            part.node = len(nodes)
            roots.append(part.node)
            nodes.append(node)

        gltf["cameras"] = [lens]
        add_node(self.parts[-1], {"name": "camera", "camera": 0})
        for light, intensity, part in self.punctual:
            add_node(part, {"name": light.name, "extensions": self.punctual_light(gltf, light, intensity)})

    def animate(self, gltf, first, frames):
        """Gives camera and lamps their place, and all parts that move those of the frames, one a second. The camera counts as
        moving, as a master plays nothing where nothing does."""
        for part, place in zip(self.parts, first):
            if part.node is not None and part.name is None:
                gltf["nodes"][part.node].update(zip(PATHS, told(part.place(place))))
        poses = [places for moments in frames for places in moments]
        if len(poses) == 1:
            return
        data, samplers, channels = Accessors(gltf), [], []
        within = [OPEN * k / 2 for k in range(len(frames[0]))]
        times = data.add([[i + t] for i in range(len(frames)) for t in within])
        for part, places in zip(self.parts, zip(*poses)):
            rests = part is not self.parts[-1] and all(place == places[0] for place in places)
            if part.node is None or rests:
                continue
            gltf["nodes"][part.node].pop("matrix", None)
            for path, values in zip(PATHS, zip(*(told(part.place(place)) for place in places))):
                samplers.append({"input": times, "output": data.add(values)})
                channels.append({"sampler": len(samplers) - 1, "target": {"node": part.node, "path": path}})
        gltf["animations"] = [{"name": "frames", "samplers": samplers, "channels": channels}]
        (self.files / "places.bin").write_bytes(data.bytes)
        gltf.setdefault("buffers", []).append({"uri": "places.bin", "byteLength": len(data.bytes)})

    def punctual_light(self, gltf, light, intensity):
        strength = max(max(intensity), 1e-30)
        colour = [c / strength for c in intensity]
        if light.type == "SPOT":
            lights = extension_list(gltf, "EXT_lights_ies")
            name = f"spot{len(lights)}.ies"
            (self.files / name).write_text(spot_profile(light))
            lights.append({"uri": name})
            return {"EXT_lights_ies": {"light": len(lights) - 1, "multiplier": strength, "color": colour}}
        lights = extension_list(gltf, "KHR_lights_punctual")
        lights.append({"type": "directional" if light.type == "SUN" else "point", "color": colour, "intensity": strength})
        return {"KHR_lights_punctual": {"light": len(lights) - 1}}


Seen = collections.namedtuple("Seen", "there places")


class Part:
    """A thing in the file: the name of its node there, if the exporter writes it; its place of a place in Blender; its node."""

    def __init__(self, name, place):
        self.name, self.place, self.node = name, place, None


class Accessors:
    """Rows of numbers that become a last buffer of a glTF file."""

    def __init__(self, gltf):
        self.gltf, self.bytes = gltf, bytearray()
        self.buffer = len(gltf.get("buffers", []))

    def add(self, rows):
        rows = np.asarray(rows, np.float32)
        views, accessors = self.gltf.setdefault("bufferViews", []), self.gltf.setdefault("accessors", [])
        views.append({"buffer": self.buffer, "byteOffset": len(self.bytes), "byteLength": rows.nbytes})
        self.bytes += rows.tobytes()
        kind = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[rows.shape[1]]
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(rows), "type": kind,
                          "min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()})
        return len(accessors) - 1


PATHS = ("translation", "rotation", "scale")
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
# Of other shaders the settings of the Principled one that mean the same. Roughness and colour are the shader's.
PLAIN_SHADERS = {"BSDF_DIFFUSE": {"Specular": 0, "Specular IOR Level": 0}, "BSDF_GLOSSY": {"Metallic": 1},
                 "BSDF_GLASS": {"Transmission": 1, "Transmission Weight": 1}}
UNTOLD = ("Subsurface", "Subsurface Weight", "Anisotropic", "Sheen", "Sheen Weight")


def principled_for(tree, shader, output):
    """A Principled node that means the same as a plain `shader`, in its place."""
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    for name, value in PLAIN_SHADERS[shader.type].items():
        if name in node.inputs:
            node.inputs[name].default_value = value
    for theirs, ours in (("Color", "Base Color"), ("Roughness", "Roughness"), ("IOR", "IOR"), ("Normal", "Normal")):
        socket = shader.inputs.get(theirs)
        if socket is None or (shader.type == "BSDF_DIFFUSE" and theirs == "Roughness"):
            continue
        if socket.is_linked:
            tree.links.new(socket.links[0].from_socket, node.inputs[ours])
        elif theirs != "Normal":
            node.inputs[ours].default_value = socket.default_value
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return node


def as_diffuse(material):
    """Without nodes a material scatters its viewport colour."""
    colour = material.diffuse_color
    material.use_nodes = True
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    node.inputs["Base Color"].default_value = colour
    for name, value in PLAIN_SHADERS["BSDF_DIFFUSE"].items():
        if name in node.inputs:
            node.inputs[name].default_value = value


def materials_of(thing):
    return tuple(slot.material and slot.material.name for slot in thing.material_slots)


def shape_print(mesh):
    """A number that tells meshes apart: corners, faces, materials, texture places and colours."""
    def values(rows, name, width, kind):
        got = np.empty(len(rows) * width, kind)
        rows.foreach_get(name, got)
        return got

    layers = [values(layer.data, "uv", 2, np.float32) for layer in mesh.uv_layers]
    layers += [values(layer.data, "color", 4, np.float32) for layer in mesh.color_attributes]
    code = 0
    for part in (values(mesh.vertices, "co", 3, np.float32), values(mesh.loops, "vertex_index", 1, np.int32),
                 values(mesh.polygons, "material_index", 1, np.int32), *layers):
        code = zlib.crc32(part, code)
    return len(mesh.vertices), len(mesh.polygons), code


def animated_values(scene):
    """All that changes over time at materials, nodes and the world, as it is now."""
    owners = [*bpy.data.materials, *bpy.data.node_groups, *bpy.data.worlds, *bpy.data.textures]
    trees = [owner.node_tree for owner in owners if getattr(owner, "node_tree", None)]
    found = [scene.frame_current for image in bpy.data.images if image.source in {"SEQUENCE", "MOVIE"} and image.users]
    for owner in owners + trees:
        animation = owner.animation_data
        if not animation:
            continue
        actions = [animation.action] + [strip.action for track in animation.nla_tracks for strip in track.strips]
        curves = [curve for action in actions if action for curve in action.fcurves] + list(animation.drivers)
        for curve in curves:
            try:
                value = owner.path_resolve(curve.data_path)
            except ValueError:  # what it animated is gone
                continue
            found.append((owner.name, curve.data_path, tuple(value) if hasattr(value, "__len__") else value))
    return found


def show_layers(layer):
    layer.hide_viewport = False
    for child in layer.children:
        show_layers(child)


def frame_of(camera, render, resolution):
    """(size, crop, glTF's camera) of the picture that holds the wanted one.

    The master's line of sight goes through the middle of its picture. A shifted lens or a border asks for a part beside it: the
    picture gets as large as to hold that, and is cropped [left, bottom, width, height]; to a quarter of a pixel.

        p = sensor / (lens n)   tangent of a pixel, n pixels along the sensor's side that counts
        p = scale / n           its side, of an orthographic camera [m]
        x0 = shift n - width/2 + border   of the wanted part's left edge, in pixels from the line of sight"""
    width, height = resolution
    fit = camera.sensor_fit if camera.sensor_fit != "AUTO" else ("HORIZONTAL" if width >= height else "VERTICAL")
    along = width if fit == "HORIZONTAL" else height
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    shift = (camera.shift_x * along, camera.shift_y * along)
    edges = ((0, 1), (0, 1))
    if render.use_border:
        edges = ((render.border_min_x, render.border_max_x), (render.border_min_y, render.border_max_y))
    size, start, part = [], [], []
    for side, moved, (low, high) in zip(resolution, shift, edges):
        first, last = int(low * side), int(high * side)
        if last <= first:
            raise Trouble("the render border holds no pixel")
        x0, x1 = moved - side / 2 + first, moved - side / 2 + last
        least = max(1, math.ceil(2 * max(abs(x0), abs(x1)) - 1e-6))
        offset = lambda n: x0 + n / 2
        whole = min((least, least + 1), key=lambda n: (round(abs(offset(n) - round(offset(n))), 6), n))
        size.append(whole)
        start.append(min(max(round(offset(whole)), 0), whole - (last - first)))
        part.append(last - first)
    if max(size) > MOST_PIXELS:
        raise Trouble(f"the picture has {size[0]}x{size[1]} pixels, with what the shift needs; at most are {MOST_PIXELS} a side")
    if camera.type == "ORTHO":
        pixel = camera.ortho_scale / along
        xmag, ymag = (pixel * n / 2 for n in size)
        return size, start + part, {"type": "orthographic",
                                    "orthographic": {"xmag": xmag, "ymag": ymag, "znear": 0, "zfar": 1e6}}
    angle = 2 * math.atan(sensor / (camera.lens * along) * size[1] / 2)
    return size, start + part, {"type": "perspective", "perspective": {"yfov": angle, "znear": 0.01}}


def told(matrix):
    """Position, rotation and scale, as a node has them."""
    place, turn, scale = matrix.decompose()
    return list(place), [turn.x, turn.y, turn.z, turn.w], list(scale)


def is_upright(matrix):
    """Whether position, rotation and scale can say it."""
    again = Matrix.LocRotScale(*matrix.decompose())
    size = max(abs(v) for row in matrix.to_3x3() for v in row)
    return all(abs(a - b) <= 1e-5 * size for again_row, row in zip(again.to_3x3(), matrix.to_3x3()) for a, b in zip(again_row, row))


def upright(mesh, matrix):
    """The mesh and its place; what cannot be said as a place goes into a copy of the mesh."""
    if is_upright(matrix):
        return mesh, matrix
    mesh = mesh.copy()
    mesh.transform(matrix)
    if matrix.is_negative:
        mesh.flip_normals()
    return mesh, Matrix()


def unscaled(matrix):
    """Place and direction alone."""
    place, turn, _ = matrix.decompose()
    return Matrix.LocRotScale(place, turn, None)


def add_object(scene, name, mesh, matrix):
    thing = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(thing)
    thing.matrix_world = matrix
    return thing


def add_shining(scene, name, mesh, matrix, radiance):
    """A surface that sends out radiance(its area in the world) on the side of its normals."""
    place = unscaled(matrix)
    mesh.transform(place.inverted() @ matrix)
    if matrix.is_negative:
        mesh.flip_normals()
    area = sum(polygon.area for polygon in mesh.polygons)
    if area == 0:
        return None
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.use_backface_culling = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    emission = nodes.new("ShaderNodeEmission")
    colour = radiance(area)
    strength = max(max(colour), 1e-30)
    emission.inputs["Color"].default_value = (*(c / strength for c in colour), 1)
    emission.inputs["Strength"].default_value = strength
    links.new(emission.outputs[0], material.node_tree.get_output_node("ALL").inputs["Surface"])
    mesh.materials.append(material)
    return add_object(scene, name, mesh, place)


def area_mesh(light):
    """In the lamp's plane, seen from below: it shines down its z."""
    x = light.size / 2
    y = (light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size) / 2
    if light.shape in {"SQUARE", "RECTANGLE"}:
        corners = [(-x, -y), (-x, y), (x, y), (x, -y)]
    else:
        steps = 64
        grow = math.sqrt(2 * math.pi / steps / math.sin(2 * math.pi / steps))  # the polygon has the ellipse's area
        turns = [-2 * math.pi * i / steps for i in range(steps)]
        corners = [(grow * x * math.cos(t), grow * y * math.sin(t)) for t in turns]
    mesh = bpy.data.meshes.new("area")
    mesh.from_pydata([(a, b, 0) for a, b in corners], [], [list(range(len(corners)))])
    return mesh


def ball_mesh(radius):
    import bmesh
    mesh, maker = bpy.data.meshes.new("ball"), bmesh.new()
    bmesh.ops.create_icosphere(maker, subdivisions=3, radius=radius)
    maker.to_mesh(mesh)
    maker.free()
    return mesh


def spot_profile(light):
    """A spot's cone as IES LM-63, 1 cd along its axis.

        f = s t^2 (3 - 2t),   t = (cos - cos o) / ((1 - cos o) blend) in [0, 1],   o half the angle of the cone
        s = cos up to Blender 3.x, 1 since"""
    outer = light.spot_size / 2
    edge, width = math.cos(outer), (1 - math.cos(outer)) * light.spot_blend

    def falloff(angle):
        t = min(max((math.cos(angle) - edge) / width, 0), 1) if width > 1e-9 else 1
        return t * t * (3 - 2 * t) * (math.cos(angle) if bpy.app.version < (4, 0, 0) else 1)

    angles = [outer * i / 512 for i in range(513)]
    end = math.degrees(outer)
    rows = [(math.degrees(a), max(falloff(a), 0)) for a in angles] + [(end + 1e-3, 0), (max(90, end + 2e-3), 0)]
    vertical = " ".join(f"{angle:.9g}" for angle, _ in rows)
    candela = " ".join(f"{value:.9g}" for _, value in rows)
    return f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(rows)} 1 1 2 0 0 0\n1 1 0\n{vertical}\n0\n{candela}\n"


def pixels_of(image):
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels


def mean_radiance(image):
    """Mean of an equirectangular picture over all directions: rows count by the cosine of their height."""
    width, height = image.size
    rows = pixels_of(image).reshape(height, width, 4)[:, :, :3].astype(float)
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        rows = np.where(rows <= 0.04045, rows / 12.92, ((rows + 0.055) / 1.055) ** 2.4)
    rows = rows.mean(axis=1)
    weights = np.cos((np.arange(height) + 0.5) / height * math.pi - math.pi / 2)
    return (weights[:, None] * rows).sum(axis=0) / weights.sum()


def colour_text(colour):
    colour = [max(float(c), 0) for c in colour]
    return ",".join(f"{c:.9g}" for c in colour) if max(colour) > 0 else "none"


def use_extension(gltf, name):
    used = gltf.setdefault("extensionsUsed", [])
    if name not in used:
        used.append(name)


def extension_list(gltf, name):
    use_extension(gltf, name)
    return gltf.setdefault("extensions", {}).setdefault(name, {}).setdefault("lights", [])


def export_main():
    try:
        Exporter(json.loads(sys.argv[sys.argv.index(EXPORT_FLAG) + 1])).run()
    except Trouble as trouble:
        sys.exit(f"{trouble}")
    except Exception as error:  # the last line is what the other Blender tells
        traceback.print_exc()
        sys.exit(f"{type(error).__name__}: {' '.join(str(error).split())}")


if __name__ == "__main__":
    if EXPORT_FLAG in sys.argv:
        export_main()
    else:
        register()
