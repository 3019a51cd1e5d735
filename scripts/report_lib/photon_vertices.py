"""What light at vertices costs over the number of surfaces, and what saves of it: Figures 25 to 27 of Jozwowski 2002."""
import os

from report_lib import plots
from report_lib.photon_stages import PUBLISHED, QUICK_SIZE, SIZE
from report_lib.scenes import shipped
from report_lib.section import Picture
from report_lib.tables import Table, figure

BOXES, SIMPLE = (16, 64, 256, 1024), 16
LEVELS = (0, 1)
# Names of tools/map_vertex_stages.h, and what he calls them.
WAYS = {"all": "each corner of each triangle", "front": "culling", "corners": "corners", "both": "culling and corners",
        "asked": "asked for by pixels"}


def add_to(context, section):
    table = Table("photon_map_vertices", ["scene", "triangles", "shoot [ms]", "shoot, simpler scene [ms]"]
                  + [f"{text}: estimates, [ms]" for text in WAYS.values()])
    repeats = "5" if context.options.quick else "25"
    size = "%dx%d" % (QUICK_SIZE if context.options.quick else SIZE)

    def stages(*flags):
        return context.programs.photon_map(*flags, *PUBLISHED, "--map-estimate", "vertices", "--size", size, "--repeats", repeats)["stages"]

    def box(surfaces):
        flags = ("--box", str(surfaces), "--map-subdivision", "0")
        return stages(*flags), stages(*flags, "--photon-box", str(SIMPLE))["shoot_ms"]

    series = {"box": [box(surfaces) for surfaces in BOXES],
              "office": [(stages(shipped("office").file, "--map-subdivision", str(level)), None) for level in LEVELS]}
    for scene, points in series.items():
        for made, simple in points:
            _fill(table, scene, made, simple)
    section.tables.append(table)
    plots.times(os.path.join(context.folder, "vertices.png"),
                {f"Figures 24 to 27: {scene}": ("triangles", [triangles_of(made) for made, _ in points], curves(points), None)
                 for scene, points in series.items()})
    section.pictures.append(Picture("vertices.png", f"ms of a frame with light at vertices, one thread, {size} pixels, over the "
                                                    "triangles of the finer mesh. Light blue: shooting in the simpler scene. 'asked' has the carrying "
                                                    "to all pixels in its time", plot=True))


def triangles_of(made):
    return made["vertices"]["all"]["count"] // 3


def curves(points):
    """{stage: ms}, for plots.times; the simpler scene only where there is one."""
    found = {"shoot": [made["shoot_ms"] for made, _ in points]}
    if all(simple is not None for _, simple in points):
        found["shoot, simpler scene"] = [simple for _, simple in points]
    for way in WAYS:
        found[way] = [made["vertices"][way]["ms"] for made, _ in points]
    return found


def _fill(table, scene, made, simple):
    triangles = triangles_of(made)
    entry = {"scene": scene, "triangles": triangles, "shoot_ms": made["shoot_ms"], "shoot_simple_ms": simple}
    for way in WAYS:
        entry[f"{way}_count"], entry[f"{way}_ms"] = made["vertices"][way]["count"], made["vertices"][way]["ms"]
    table.data.append(entry)
    table.rows.append([scene, str(triangles), figure(made["shoot_ms"]), figure(simple)]
                      + [f"{entry[way + '_count']}, {figure(entry[way + '_ms'])}" for way in WAYS])
