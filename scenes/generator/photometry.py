"""Photometric files (IES LM-63-2002, type C) of lamps that nobody sells, from formulas."""

import math


def text(name, vertical, horizontal, candela):
    """`candela(v, h)` at angles in degrees, rounded to tenths. Absolute photometry."""
    rows = [" ".join(f"{round(candela(v, h), 1):g}" for v in vertical) for h in horizontal]
    return "\n".join(
        [
            "IESNA:LM-63-2002",
            "[TEST] a formula of scenes/generator/photometry.py",
            "[MANUFAC] Ninefold",
            f"[LUMCAT] {name}",
            "TILT=NONE",
            f"1 -1 1 {len(vertical)} {len(horizontal)} 1 2 0 0 0",
            "1 1 0",
            " ".join(f"{v:g}" for v in vertical),
            " ".join(f"{h:g}" for h in horizontal),
            *rows,
            "",
        ]
    )


def _degrees(last, step):
    return [i * step for i in range(round(last / step) + 1)]


def wall_washer():
    """Brightest towards horizontal angle 0, between the foot and the middle of a wall; mirrored in the
    plane of 0 and 180. What goes to the back only lights the floor."""

    def candela(v, h):
        sideways = min(1, v / 20)  # straight down there is only one value
        forward = ((1 + math.cos(math.radians(h))) / 2) ** 3 * sideways + 0.2 * (1 - sideways)
        beam = math.exp(-(((v - 38) / 20) ** 2)) * forward
        floor = 0.12 * math.cos(math.radians(v)) ** 2
        return 1600 * (beam + floor) * min(1, (90 - v) / 12)

    return text("wall washer", _degrees(90, 5), _degrees(180, 15), candela)


def scallop():
    """A narrow beam with a sharp edge and a faint ring around it, the same to all sides."""

    def candela(v, _):
        core = 1 / (1 + math.exp((v - 17) / 1.3))
        ring = 0.16 * math.exp(-(((v - 33) / 4) ** 2))
        return 3200 * (core + ring) * (v < 60)

    return text("scallop", _degrees(90, 2.5), [0], candela)
