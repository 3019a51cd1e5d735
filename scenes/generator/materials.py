"""Materials and textures as plain descriptions. Colours are linear, radiance is in W/(m² sr)."""

from dataclasses import dataclass
from typing import Callable, Optional, Tuple

Colour = Tuple[float, float, float]


@dataclass(frozen=True)
class Texture:
    """`paint` returns (width, height, palette, indices) as png.encode takes them; `size` is what
    one repetition measures on a surface [m], (1, 1) for pictures fitted to their rectangle."""

    name: str
    paint: Callable
    size: Tuple[float, float] = (1, 1)


@dataclass(frozen=True)
class Material:
    name: str
    colour: Colour = (1, 1, 1)  # factor of the texture, if there is one
    texture: Optional[Texture] = None
    metallic: float = 0
    roughness: float = 1  # 1 = matte: renderers treat a rough dielectric as diffuse
    radiance: Colour = (0, 0, 0)  # emitted by front faces
    glass: bool = False  # solid, clear, index 1.5


def matte(name, *colour):
    return Material(name, colour)


def textured(name, paint, width, height, colour=(1, 1, 1)):
    return Material(name, colour, Texture(name, paint, (width, height)))


def picture(name, paint):
    return Material(name, (1, 1, 1), Texture(name, paint))


def metal(name, *colour, roughness=0.3):
    return Material(name, colour, metallic=1, roughness=roughness)


def glass(name="glass"):
    return Material(name, roughness=0, glass=True)


def light(name, *radiance):
    return Material(name, (0.8, 0.8, 0.8), radiance=radiance)


def describe(material, texture_index):
    """The glTF object; `texture_index` is None without a texture."""
    pbr = {
        "baseColorFactor": [*material.colour, 1],
        "metallicFactor": material.metallic,
        "roughnessFactor": material.roughness,
    }
    if texture_index is not None:
        pbr["baseColorTexture"] = {"index": texture_index}
    result = {"name": material.name, "pbrMetallicRoughness": pbr}
    strength = max(material.radiance)
    if strength > 0:
        result["emissiveFactor"] = [round(c / strength, 6) for c in material.radiance]
        result["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
    if material.glass:
        result["extensions"] = {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": {"thicknessFactor": 1},
        }
    return result
