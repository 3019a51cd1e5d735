"""Section: an intersection field beside its paper: sizes and times (Table 2), how often a second it follows each interaction (Table 3),
time over surface and over triangles (Figure 8), and error and time by the number of lines (Figure 9)."""
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
# Their Table 2: triangles, lamps, field [MB], V [ms], indirect light [ms], all [ms].
THEIR_SIZES = {"1": (37767, 1, 14.1, 61.5, 30.9, 112), "2": (57545, 2, 72.6, 309.5, 141.3, 535), "3": (87001, 3, 113.0, 335.0, 194.5, 626)}
# Their Table 3: pictures a second, by scene.
THEIR_RATES = {"a lamp moves": "7.0-10.9, 1.7-4.5, 3.0-5.1", "a lamp is deformed": "6.2-9.6, 1.5-2.3, 1.2-2.2",
               "a thing moves": "8.3-24.8, 3.6-8.1, 3.5-7.9", "a thing is deformed": "-, -, 2.0-2.4"}
# What is done to each scene; a twist of 30 degrees is the deformation. Flat lamps cannot be twisted.
INTERACTIONS = {
    "cornell": {"a lamp moves": {"object": "lamp", "by": [0.05, -0.05, 0]}, "a thing moves": EDITS["cornell"],
                "a thing is deformed": {"object": "tall block", "twist": 30}},
    "table_room": {"a lamp moves": {"object": "lamp", "by": [0.3, -0.1, 0]}, "a thing moves": EDITS["table_room"],
                   "a thing is deformed": {"object": "chair on the right", "twist": 30}},
    "office": {"a lamp moves": {"object": "desk lamp", "by": [0.2, 0, 0]}, "a lamp is deformed": {"object": "desk lamp", "twist": 30},
               "a thing moves": EDITS["office"], "a thing is deformed": {"object": "main chair", "twist": 30}}}
RADII = (0.2, 0.35, 0.5, 0.65, 0.8)  # of the ball [m]
RINGS = (51, 71, 87, 101)  # of it: 10, 20, 30 and 40 thousand triangles, as theirs have
ROOM_TRIANGLES, ROOM_SURFACE = 12, 24  # around it
IN_MOTION = 1 / 4  # of the photons are traced for a frame in motion (common/scene/methods.cpp)
TEXT = [
    "After Ren, Hua, Chen and Bao, \"Intersection Fields for Interactive Global Illumination\", 2005. ninefold-intersection-field makes "
    "the field of a scene in one thread: its runs, the lines through the nodes of mesh elements, V of all lamps, and the photons of one "
    "picture at rest. Then one thing moves, and what belongs to it is made again.",
    "Theirs, a Pentium 4 of 2.4 GHz and a graphics card, 76 x 127 in two groups of lines (here four). They do not tell how long a field "
    "of a whole scene takes.",
    "Their Table 3 counts pictures a second. Here one thread makes anew what an interaction touches, and the photons of a frame in motion; "
    "pixels, which theirs leave to the graphics card, come on top.",
    "Their Figure 8: the time goes with the surface, and hardly with the triangles. Theirs are statues of 10 to 40 thousand triangles; the "
    "figure's seconds are not in its text. Here a ball of as many triangles grows in a room.",
    "Their Figure 9, pictures by number of lines, in figures: bias is the relMSE that stays when frames are averaged, of two runs of unlike "
    "seeds and two halves of the reference, so that noise cancels; the means of R, G, B are against the reference."]


def run(context):
    section = Section("intersection-field", "Intersection field", list(TEXT))
    _add_sizes(context, section)
    _add_interactions(context, section)
    _add_surfaces(context, section)
    _add_resolutions(context, section)
    return section


def _add_sizes(context, section):
    table = Table("field_sizes", ["scene", "lines", "triangles", "surface [m2]", "hits", "field [MB]", "field [s]", "node lines [MB]",
                                  "node lines [s]", "V [s]", "photons", "photons [s]", "after an edit: field [s]", "node lines [s]", "V [s]"])
    for name, event in EDITS.items():
        file = _script(context, event)
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


def _script(context, event):
    file = os.path.join(context.folder, "edit.json")
    with open(file, "w", encoding="utf-8") as out:
        json.dump({"seconds": 1, "events": [{"from": 0, "to": 1, **event}]}, out)
    return file


def _add_interactions(context, section):
    sizes = Table("field_beside_theirs", ["scene", "lines", "triangles", "lamps", "field [MB]", "V [ms]", "indirect light [ms]",
                                          "all [ms]"])
    for name, values in THEIR_SIZES.items():
        sizes.rows.append([f"theirs, {name}", "76 x 127", *[figure(v) if isinstance(v, float) else str(v) for v in values]])
    rates = Table("field_interactions", ["scene", "interaction", "lines [ms]", "lines of nodes [ms]", "V [ms]", "photons of a frame [ms]",
                                         "a second, one thread", "theirs, scenes 1, 2, 3"])
    for name, events in INTERACTIONS.items():
        for interaction, event in events.items():
            made = context.programs.intersection_field(shipped(name).file, "--edit", _script(context, event), *METHOD, *_grid(19, 32),
                                                       *ROOM)
            edit = made["edit"]
            photons = IN_MOTION * made["photon_seconds"] + made["digest_seconds"]
            parts = [edit["field_seconds"] + edit["element_seconds"], edit["node_seconds"], edit["lamp_seconds"], photons]
            rates.data.append({"scene": name, "interaction": interaction, "lines": parts[0], "nodes": parts[1], "v": parts[2],
                               "photons": photons})
            rates.rows.append([name, interaction, *[figure(1e3 * part) for part in parts], figure(1 / sum(parts)), THEIR_RATES[interaction]])
        indirect = made["photon_seconds"] + made["digest_seconds"]
        sizes.data.append({key: value for key, value in made.items() if key != "edit"})
        sizes.rows.append([name, "19 x 32", str(made["triangles"]), str(made["lamps"]), figure(made["field_bytes"] / 1e6),
                           figure(1e3 * made["lamp_seconds"]), figure(1e3 * indirect), figure(1e3 * (made["lamp_seconds"] + indirect))])
    section.tables.extend([sizes, rates])


def _add_surfaces(context, section):
    table = Table("field_surface", ["radius of the ball", "its surface [m2]", "its triangles", "field [s]", "field [MB]"])
    over_surface, over_triangles = {}, {}
    for radius in RADII[::2] if context.options.quick else RADII:
        for rings in RINGS:
            file = os.path.join(context.folder, "ball.obj")
            with open(file, "w", encoding="utf-8") as out:
                out.write(ball_in_a_room(radius, rings))
            made = context.programs.intersection_field(file, "--camera", "0,0,0.9:0,0,0:40", *METHOD, *_grid(*GRIDS[-1]),
                                                       *ROOM)
            triangles, surface = made["triangles"] - ROOM_TRIANGLES, made["surface"] - ROOM_SURFACE
            seconds = made["field_seconds"]
            table.data.append({"radius": radius, "surface": surface, "triangles": triangles, "seconds": seconds,
                               "bytes": made["field_bytes"]})
            table.rows.append([figure(radius), figure(surface), str(triangles), figure(seconds), figure(made["field_bytes"] / 1e6)])
            over_surface.setdefault(f"{triangles} triangles", []).append((surface, seconds))
            over_triangles.setdefault(f"radius {radius} m", []).append((triangles, seconds))
    section.tables.append(table)
    section.text.append(_growth(over_surface, over_triangles))
    plots.side_by_side(os.path.join(context.folder, "surface.png"),
                       [(over_surface, "surface of the ball [m2]"), (over_triangles, "triangles of the ball")], "time of the field [s]")
    section.pictures.append(Picture("surface.png", "time of the field, at the same triangles over the surface (their Figure 8), and at the same "
                                                   "surface over the triangles", plot=True))


def _growth(over_surface, over_triangles):
    """What the two plots say."""
    def grown(series):
        ratios = [points[-1][1] / points[0][1] for points in series.values()]
        times = next(iter(series.values()))
        return times[-1][0] / times[0][0], f"{figure(min(ratios))} to {figure(max(ratios))}"
    surface, triangles = grown(over_surface), grown(over_triangles)
    return (f"Ours: at the same triangles {figure(surface[0])} times the surface takes {surface[1]} times as long; at the same surface "
            f"{figure(triangles[0])} times the triangles take {triangles[1]} times as long. What it rises with the triangles comes of cuts: "
            "each slice cuts each triangle that it crosses, and looks at all slopes for each cut, whether a line meets it or not. A triangle of "
            "a quarter of the surface is crossed by half as many slices, so that cuts go with the square root of surface times triangles.")


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
    table = Table("field_resolutions", ["scene", "lines", "field [MB]", "field [s]", "direct light", "relMSE of one run", "bias",
                                        "reference's noise", "mean R, G, B against the reference [%]"])
    frames = 32 if context.options.quick else 128
    errors, times = {}, {}
    for name in EDITS:
        scene = shipped(name)
        if scene not in context.scenes:
            continue
        size = scene.size(context.options.width)
        reference = context.references.get(scene, size)
        halves = pictures.mean(reference.batches[0::2]), pictures.mean(reference.batches[1::2])
        for directions, distances in GRIDS:
            grid = _grid(directions, distances)
            made = context.programs.intersection_field(scene.file, *METHOD, *grid, *ROOM)
            times.setdefault(name, []).append((directions, made["field_seconds"]))
            for direct in ("vpls", "field"):
                job = Job(scene, size, (*METHOD, *grid, *ROOM, "--filter", "none", "--field-direct", direct))
                files = [path(context, f"{name}_{directions}_{direct}", seed) for seed in (1, 2)]
                for seed, file in enumerate(files, 1):
                    context.programs.render(job, seed, ("--frames", frames), file)
                against = context.programs.compare(files[0], reference.picture)
                entry = {"scene": name, "directions": directions, "distances": distances, "bytes": made["field_bytes"],
                         "seconds": made["field_seconds"], "direct": direct, "relmse": against["relmse"],
                         "noise": reference.noise["relmse"],
                         "bias": common_error(*[pictures.read(file) for file in files], *halves)}
                table.data.append(entry)
                table.rows.append([name, f"{directions} x {distances}", figure(entry["bytes"] / 1e6), figure(entry["seconds"]), direct] +
                                  [figure(entry[key]) for key in ("relmse", "bias", "noise")] + [signed_percents(against["bias"])])
                errors.setdefault(f"{name}, direct light by {direct}", []).append((directions, entry["bias"]))
    section.tables.append(table)
    if not errors:
        return
    plots.lines(os.path.join(context.folder, "resolutions.png"), errors, "directions, N_dir", "relMSE of the mean")
    plots.lines(os.path.join(context.folder, "resolution_times.png"), times, "directions, N_dir", "time of the field [s]")
    section.pictures.extend([
        Picture("resolutions.png", "relMSE that stays when frames are averaged, over N_dir (their Figure 9)", plot=True),
        Picture("resolution_times.png", "time of the field over N_dir", plot=True)])


def _grid(directions, distances):
    return "--field-directions", str(directions), "--field-distances", str(distances)
