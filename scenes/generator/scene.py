"""A scene: models placed in a room, and cameras. A model that is placed often is stored once."""

import math
from dataclasses import dataclass
from typing import Tuple

from . import vectors as vec
from .mesh import Model


@dataclass(frozen=True)
class Placement:
    name: str
    model: Model
    at: Tuple[float, float, float]
    rotation: Tuple[float, float, float, float]  # quaternion x, y, z, w
    scale: Tuple[float, float, float]


@dataclass(frozen=True)
class Camera:
    name: str
    eye: Tuple[float, float, float]
    rotation: Tuple[float, float, float, float]
    fov: float  # vertical, full angle [rad]


def _round(values):
    return tuple(round(v, 6) + 0.0 for v in values)


def _quaternion(axis, degrees):
    s, c = math.sin(math.radians(degrees) / 2), math.cos(math.radians(degrees) / 2)
    return (axis[0] * s, axis[1] * s, axis[2] * s, c)


def _product(p, q):
    """First q, then p."""
    u, v = p[:3], q[:3]
    w = vec.add(vec.add(vec.mul(v, p[3]), vec.mul(u, q[3])), vec.cross(u, v))
    return (*w, p[3] * q[3] - vec.dot(u, v))


@dataclass(frozen=True)
class Motion:
    """Of the placement of that name: at `times` [s] it is moved by `offsets` [m] from where it was placed."""

    name: str
    times: Tuple[float, ...]
    offsets: Tuple[Tuple[float, float, float], ...]


@dataclass(frozen=True)
class Lamp:
    """A point that shines as a photometric file says, straight down; its horizontal angle 0 is north (-z)."""

    name: str
    profile: str  # the text of the file
    at: Tuple[float, float, float]
    colour: Tuple[float, float, float]


class Scene:
    def __init__(self, name):
        self.name = name
        self.placements = []
        self.cameras = []
        self.motions = []
        self.lamps = []
        self.exposure = 0  # [EV] that suits the views

    def place(self, model, at=(0, 0, 0), turn=0, name=None, tilt=0, scale=1):
        """`turn` degrees about y (from +z towards +x), after `tilt` about x (+y towards +z)."""
        rotation = _product(_quaternion((0, 1, 0), turn), _quaternion((1, 0, 0), tilt))
        size = scale if isinstance(scale, tuple) else (scale, scale, scale)
        name = name or model.name
        self.placements.append(Placement(name, model, _round(at), _round(rotation), size))

    def move(self, name, times, offsets):
        """An animation, straight from one place to the next. It begins where the thing was placed."""
        assert times[0] == 0 and offsets[0] == (0, 0, 0)
        self.motions.append(Motion(name, tuple(times), tuple(offsets)))

    def lamp(self, name, profile, at, colour=(1, 1, 1)):
        self.lamps.append(Lamp(name, profile, _round(at), colour))

    def camera(self, name, eye, target, fov):
        """`fov`: vertical, in degrees. The image is meant to be 4:3."""
        d = vec.unit(vec.sub(target, eye))
        yaw = math.degrees(math.atan2(-d[0], -d[2]))
        pitch = math.degrees(math.asin(d[1]))
        rotation = _product(_quaternion((0, 1, 0), yaw), _quaternion((1, 0, 0), pitch))
        self.cameras.append(
            Camera(name, _round(eye), _round(rotation), round(math.radians(fov), 6))
        )

    def statistics(self):
        """(unique triangles, triangles after instancing, lights = emitting parts of things, and lamps)."""
        models = {id(p.model): p.model for p in self.placements}
        lights = sum(any(m.radiance) for p in self.placements for m in p.model.meshes)
        return (
            sum(m.triangle_count() for m in models.values()),
            sum(p.model.triangle_count() for p in self.placements),
            lights + len(self.lamps),
        )
