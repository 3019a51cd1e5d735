"""The scenes of the report: the seven that are shipped, and known ones from elsewhere where they are at hand."""
import dataclasses
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

SHIPPED = ("cornell", "table_room", "egg_room", "invisible_date", "office", "conference", "u_office")
# Name, file, camera. Bitterli's and McGuire's; the camera of the boxes is the one that McGuire's page shows.
ELSEWHERE = (("veach_bidir", "veach-bidir.glb", ()),
             ("box_original", "CornellBox-Original.obj", ("--camera", "0,1,3.9:0,1,0:40")),
             ("box_water", "CornellBox-Water.obj", ("--camera", "0,1,3.9:0,1,0:40")))
# Rooms of the section bidirectional: light enters through a hole, or after three bounces.
ROUND_CORNERS = ("keyhole", "three_turns")
# Path tracing hardly finds their light: the bidirectional method makes their references.
DARK = ("u_office",) + ROUND_CORNERS
# Segovia's criterion and the relMSE steps are asked of these.
TARGETS = ("table_room", "veach_bidir", "u_office")


@dataclasses.dataclass(frozen=True)
class Scene:
    name: str
    file: str
    flags: tuple = ()
    square: bool = False

    def size(self, width):
        """Of about the same number of pixels for all scenes: 4:3, or the square that `elsewhere` scenes are made for."""
        return (width * 7 // 8, width * 7 // 8) if self.square else (width, width * 3 // 4)

    def bytes(self):
        """Of the file, and of the materials beside an .obj."""
        files = [self.file]
        if self.file.endswith(".obj"):
            files.append(self.file[:-4] + ".mtl")
        content = b""
        for name in files:
            with open(name, "rb") as file:
                content += file.read()
        return content


def shipped(name):
    return Scene(name, os.path.join(ROOT, "scenes", name + ".glb"))


def known(folder):
    """All scenes that are there; `folder` holds those from elsewhere."""
    scenes = [shipped(name) for name in SHIPPED]
    for name, file, flags in ELSEWHERE:
        path = os.path.join(folder, file) if folder else ""
        if os.path.exists(path):
            scenes.append(Scene(name, path, flags, square=True))
    return scenes


def chosen(names, folder):
    """The scenes of these names, in that order. Raises KeyError with the name that is not there."""
    by_name = {scene.name: scene for scene in known(folder)}
    return [by_name[name] for name in names] if names else list(by_name.values())
