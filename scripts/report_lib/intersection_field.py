"""Section: an intersection field beside its paper: sizes and times (Tables 2 and 3), time over surface and over triangles (Figure 8),
and error by the number of lines (Figure 9)."""
import json
import os

from report_lib import pictures, plots
from report_lib.measure import path
from report_lib.photon_bias import common_error
from report_lib.programs import Job
from report_lib.scenes import shipped
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure, signed_percents

METHOD = ("--method", "intersection-field")
GRIDS = ((9, 16), (13, 24), (19, 32), (27, 46), (38, 63))  # N_dir x N_dist
# Scene, what moves in its edit.
EDITS = {"cornell": {"object": "tall block", "by": [0.1, 0, 0.1]}, "table_room": {"object": "chair on the right", "by": [0.4, 0, 0]},
         "office": {"object": "main chair", "by": [0.4, 0, 0.3]}}
ROOM = ("--max-field-memory", "4096")
TEXT = [
    "After Ren, Hua, Chen and Bao, \"Intersection Fields for Interactive Global Illumination\", 2005. ninefold-intersection-field makes "
    "the field of a scene in one thread: its runs, the lines through the nodes of mesh elements, V of all lamps, and the photons of one "
    "picture at rest. Then one thing moves, and what belongs to it is made again.",
    "Theirs, a Pentium 4 of 2.4 GHz and a graphics card, 76 x 127 in two groups of lines (here four): 37,767, 57,545 and 87,001 "
    "triangles with fields of 14.1, 72.6 and 113.0 MB; V 61.5, 309.5 and 335.0 ms, indirect light 30.9, 141.3 and 194.5 ms. They do not "
    "tell how long a field of a whole scene takes.",
    "Their Figure 8: the time goes with the surface, and hardly with the triangles. Here a ball in a room is cut finer and finer, and "
    "made larger and larger.",
    "Their Figure 9, in figures: bias is the relMSE that stays when frames are averaged, of two runs of unlike seeds and two halves of the "
    "reference, so that noise cancels; the means of R, G, B are against the reference."]


def run(context):
    section = Section("intersection-field", "Intersection field", list(TEXT))
    _add_sizes(context, section)
    _add_surfaces(context, section)
    _add_resolutions(context, section)
    return section


def _add_sizes(context, section):
    table = Table("field_sizes", ["scene", "lines", "triangles", "surface [m2]", "hits", "field [MB]", "field [s]", "node lines [MB]",
                                  "node lines [s]", "V [s]", "photons", "photons [s]", "after an edit: field [s]", "node lines [s]", "V [s]"])
    for name, event in EDITS.items():
        file = os.path.join(context.folder, f"edit_{name}.json")
        with open(file, "w", encoding="utf-8") as out:
            json.dump({"seconds": 1, "events": [{"from": 0, "to": 1, **event}]}, out)
        for directions, distances in GRIDS[2::2]:
            made = context.programs.intersection_field(shipped(name).file, "--edit", file, *METHOD, *_grid(directions, distances), *ROOM)
            edit = made["edit"]
            table.data.append({**{k: v for k, v in made.items() if k != "edit"}, **{"edit_" + k: v for k, v in edit.items()}})
            table.rows.append([name, f"{directions} x {distances}", str(made["triangles"]), figure(made["surface"]), str(made["hits"]),
                               figure(made["field_bytes"] / 1e6), figure(made["field_seconds"]), figure(made["node_bytes"] / 1e6),
                               figure(made["node_seconds"]), figure(made["lamp_seconds"]), str(made["photons"]),
                               figure(made["photon_seconds"]), figure(edit["field_seconds"]), figure(edit["node_seconds"]),
                               figure(edit["lamp_seconds"])])
    section.tables.append(table)


def _add_surfaces(context, section):
    table = Table("field_surface", ["radius of the ball", "triangles", "field [s]", "field [MB]"])
    for radius in (0.2, 0.5, 0.8):
        for rings in (16, 64) if context.options.quick else (16, 32, 64, 128):
            file = os.path.join(context.folder, "ball.obj")
            with open(file, "w", encoding="utf-8") as out:
                out.write(ball_in_a_room(radius, rings))
            made = context.programs.intersection_field(file, "--camera", "0,0,0.9:0,0,0:40", *METHOD, *ROOM)
            table.data.append({"radius": radius, "triangles": made["triangles"], "seconds": made["field_seconds"],
                               "bytes": made["field_bytes"]})
            table.rows.append([figure(radius), str(made["triangles"]), figure(made["field_seconds"]), figure(made["field_bytes"] / 1e6)])
    section.tables.append(table)


def ball_in_a_room(radius, rings):
    """An .obj: a cube of side 2, and a ball of 2 rings columns in its middle."""
    from math import cos, pi, sin
    lines = [f"v {x} {y} {z}" for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    for r in range(rings + 1):
        for c in range(2 * rings):
            theta, phi = pi * r / rings, pi * c / rings
            lines.append(f"v {radius * sin(theta) * cos(phi):.7f} {radius * cos(theta):.7f} {radius * sin(theta) * sin(phi):.7f}")
    at = lambda r, c: 9 + r * 2 * rings + c % (2 * rings)
    for r in range(rings):
        for c in range(2 * rings):
            if r + 1 < rings:
                faces.append((at(r, c), at(r + 1, c + 1), at(r + 1, c)))
            if r > 0:
                faces.append((at(r, c), at(r, c + 1), at(r + 1, c + 1)))
    return "\n".join(lines + ["f " + " ".join(map(str, face)) for face in faces]) + "\n"


def _add_resolutions(context, section):
    table = Table("field_resolutions", ["scene", "lines", "direct light", "relMSE of one run", "bias", "reference's noise",
                                        "mean R, G, B against the reference [%]"])
    frames = 32 if context.options.quick else 128
    series = {}
    for name in ("cornell",) if context.options.quick else ("cornell", "table_room", "office"):
        scene = shipped(name)
        size = scene.size(context.options.width)
        reference = context.references.get(scene, size)
        halves = pictures.mean(reference.batches[0::2]), pictures.mean(reference.batches[1::2])
        for direct in ("vpls", "field"):
            for directions, distances in GRIDS:
                job = Job(scene, size, (*METHOD, *_grid(directions, distances), *ROOM, "--filter", "none", "--field-direct", direct))
                files = [path(context, f"{name}_{directions}_{direct}", seed) for seed in (1, 2)]
                for seed, file in enumerate(files, 1):
                    context.programs.render(job, seed, ("--frames", frames), file)
                against = context.programs.compare(files[0], reference.picture)
                entry = {"scene": name, "directions": directions, "distances": distances, "direct": direct,
                         "relmse": against["relmse"], "noise": reference.noise["relmse"],
                         "bias": common_error(*[pictures.read(file) for file in files], *halves)}
                table.data.append(entry)
                table.rows.append([name, f"{directions} x {distances}", direct] +
                                  [figure(entry[key]) for key in ("relmse", "bias", "noise")] + [signed_percents(against["bias"])])
                series.setdefault(f"{name}, direct light by {direct}", []).append((directions, entry["bias"]))
    section.tables.append(table)
    plots.bias(os.path.join(context.folder, "resolutions.png"), series, dict.fromkeys(series),
               "directions, N_dir")
    section.pictures.append(Picture("resolutions.png", "relMSE that stays when frames are averaged, over N_dir (their Figure 9)", plot=True))


def _grid(directions, distances):
    return "--field-directions", str(directions), "--field-distances", str(distances)
