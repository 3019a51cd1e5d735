"""Section: bidirectional instant radiosity beside its paper: which virtual lights it keeps (Table 1), the U-shaped office
(Figures 4 and 5), frames a second (Table 2), rooms that light enters with difficulty (Figure 6a), and how its
references agree with the path tracer's."""
import os

import numpy

from report_lib import blocks, pictures, plots
from report_lib.measure import measure, net, path
from report_lib.programs import Job
from report_lib.references import TRACER
from report_lib.scenes import DARK, ROUND_CORNERS, shipped
from report_lib.section import Picture, Section
from report_lib.tables import Table, figure, percent, signed_percents

OURS, PUBLISHED = ("--method", "bidirectional"), ("--preset", "segovia")
FORMS = {"bidirectional": OURS, "as published": PUBLISHED}
FAMILIES = ("lamp", "standard", "reverse")
# Shares of standard and reverse VPLs among those kept, from the paper's Table 1 (of the candidates 8.7, 1.3 and 0, 10 %).
THEIRS = {"conference": "87 / 13 %", "u_office": "0 / 100 %"}
KEPT_FRAMES = 16
METHODS = {"instant radiosity": (), "instant radiosity, 1x1": ("--interleave", "1x1"), "bidirectional": OURS,
           "bidirectional, 1x1": (*OURS, "--interleave", "1x1"), "as published": PUBLISHED, "path tracer": TRACER}
ONE_SET = ("--interleave", "1x1", "--filter", "none", "--vpl-roulette", "0")
FIGURE_SIZE = (320, 240)
# 200 VPLs, without and with candidates of the camera; then 250 of 1250 and 1200. Those that no light reaches are left out.
FIGURE_4 = {"lamps": (*ONE_SET, "--direct-vpls", "8", "--indirect-vpls", "192"),
            "both": (*OURS, *ONE_SET, "--direct-vpls", "8", "--indirect-vpls", "192", "--resampling", "1")}
FIGURE_5 = {"published": (*PUBLISHED, *ONE_SET, "--direct-vpls", "10", "--indirect-vpls", "240")}
SPEED_SCENES, SPEED_SIZE, SPEED_FRAMES = ("u_office", "office", "conference"), (1024, 1024), 16
TEXT = [
    "After Segovia, Iehl, Mitanchey and Péroche, \"Bidirectional Instant Radiosity\", 2006. 'Bidirectional' is --method "
    "bidirectional as it is by default; 'as published' is --preset segovia: half of the light from each family, 30 virtual "
    "lights a frame.",
    "Kept: what share of the virtual lights that are kept stands on lamps, was found by light paths, and was found from the "
    "camera, mean of several frames; beside it the paper's Table 1 (standard, lamps included, and reverse). Their scenes of "
    "these names are others than ours.",
    "Frames a second: as in the paper's Table 2, 1024x1024 pixels and 30 virtual lights a frame (--preset segovia), no filter "
    "but the film. Rays a second are of whole frames on all clients; 'making': of the virtual lights alone in one thread, "
    "which is what the paper's rays a second are of. Theirs, on an Athlon 2400+ and a GeForce 6800 GT: office of 35,000 "
    "triangles 15 frames and 1.0 Mrays a second, conference of 200,000 4.5 frames and 0.8 Mrays.",
    "Rooms: light comes into them through a hole of 16 cm (keyhole), or after three bounces or more (three_turns). Runs of "
    "equal time; relMSE has the reference's noise taken off ('-': too little is left).",
    "References of these rooms and of u_office are made by the bidirectional method. Here they are held against pictures that "
    "the path tracer made in as much time: bias of each channel's mean with its standard error, and blocks of 16x16 pixels "
    "beyond two and three standard errors of the difference, beside the share that chance puts there. Noise: relMSE of each."]


def run(context):
    section = Section("bidirectional", "Light round corners", list(TEXT))
    dark = [scene for scene in context.scenes if scene.name in DARK] + [shipped(name) for name in ROUND_CORNERS]
    section.tables += [_kept(context, dark), _speed(context)]
    section.pictures += _figures(context, shipped("u_office"))
    table = Table("round_corners", ["scene", "method", "budget [s]", "frames", "relMSE", "trimmed", "RMSE %"])
    for scene in dark:
        section.pictures += _rooms(context, scene, table)
    section.tables += [table, _reconciled(context, dark)]
    return section


def _kept(context, dark):
    table = Table("kept", ["scene", "form", "virtual lights a set", "lamps", "standard", "reverse", "the paper's: standard / reverse"])
    for scene in context.scenes + [scene for scene in dark if scene not in context.scenes]:
        for form, flags in FORMS.items():
            made = context.programs.lights(Job(scene, scene.size(context.options.width), flags), KEPT_FRAMES)
            count = len(made["lights"])
            shares = [sum(light["family"] == family for light in made["lights"]) / count for family in FAMILIES]
            entry = {"scene": scene.name, "form": form, "lights_per_set": count / made["sets"], **dict(zip(FAMILIES, shares))}
            table.data.append(entry)
            table.rows.append([scene.name, form, figure(entry["lights_per_set"]), *map(percent, shares),
                               THEIRS.get(scene.name, "")])
    return table


def _speed(context):
    table = Table("frames_a_second", ["scene", "frames/s", "ms a frame", "Mrays/s", "making [ms]", "making [Mrays/s]", "relMSE of one frame"])
    for name in SPEED_SCENES:
        scene = shipped(name)
        stats = context.programs.render(Job(scene, SPEED_SIZE, PUBLISHED), 1, ("--frames", SPEED_FRAMES),
                                        path(context, name + "_speed", 1))
        made = context.programs.lights(Job(scene, SPEED_SIZE, PUBLISHED), SPEED_FRAMES)
        frame = measure(context, Job(scene, scene.size(context.options.width), PUBLISHED), 1, ("--frames", 1),
                        context.references.get(scene, scene.size(context.options.width)), path(context, name + "_frame", 1))
        entry = {"scene": name, "fps": stats["fps"], "frame_ms": stats["frame_ms"]["p50"], "rays_per_second": stats["rays_per_second"],
                 "making_ms": 1000 * made["seconds"] / made["sets"], "making_rays_per_second": made["rays"] / made["seconds"],
                 "relmse": frame["relmse"]}
        table.data.append(entry)
        table.rows.append([name, figure(entry["fps"]), figure(entry["frame_ms"]), figure(entry["rays_per_second"] / 1e6),
                           figure(entry["making_ms"]), figure(entry["making_rays_per_second"] / 1e6), figure(entry["relmse"])])
    return table


def _figures(context, scene):
    """Plans of the virtual lights, and pictures of one set of them, one frame."""
    plans, made = {}, []
    for name, flags in {**FIGURE_4, **FIGURE_5}.items():
        job = Job(scene, FIGURE_SIZE, flags)
        plans[name] = context.programs.lights(job, 1)["lights"]
        file = path(context, "figure_" + name, 1)
        stats = context.programs.render(job, 1, ("--frames", 1), file)
        made.append(pictures.read(file))
    camera = stats["settings"]["camera"]
    titles = {"lamps": "200 of light paths", "both": "200 of both", "published": "250 of 2450, as published"}
    plots.plans(os.path.join(context.folder, "figure_plan.png"), {titles[name]: lights for name, lights in plans.items()}, camera)
    exposure = pictures.good_exposure(pictures.read(context.references.get(scene, scene.size(context.options.width)).picture))
    pictures.write(os.path.join(context.folder, "figure.png"), pictures.sheet([[pictures.shown(p, exposure) for p in made]]))
    return [Picture("figure_plan.png", "u_office from above, virtual lights on lamps (yellow), of light paths (blue) and from the "
                    "camera (red), as the paper's Figures 4a, 4b and 5a; the camera looks along the line", plot=True),
            Picture("figure.png", "One frame of one set, as the paper's Figures 4c, 4d and 5b: 200 virtual lights of instant "
                    "radiosity; 200 of both families; 250, as published")]


def _rooms(context, scene, table):
    size = scene.size(context.options.width)
    reference = context.references.get(scene, size)
    truth, shown = pictures.read(reference.picture), []
    for budget in context.options.short_budgets:
        made = []
        for number, (method, flags) in enumerate(METHODS.items()):
            file = path(context, f"{scene.name}_{number}_{budget:g}s", 1)
            e = {"scene": scene.name, "method": method, "budget": budget,
                 **measure(context, Job(scene, size, flags), 1, ("--seconds", budget), reference, file)}
            table.data.append(e)
            table.rows.append([scene.name, method, figure(budget), str(e["frames"]), figure(net(e, "relmse")),
                               figure(net(e, "relmse_trimmed")), figure(net(e, "rmse_percent"))])
            made.append(pictures.read(file))
        name = f"{scene.name}_{budget:g}s.png"
        pictures.write(os.path.join(context.folder, name), pictures.beside_reference(truth, made))
        shown.append(Picture(name, f"{scene.name} after {budget:g} s: reference, {', '.join(METHODS)}; below them the signed "
                                   "error (full colour at 50 %)"))
    return shown


def _reconciled(context, dark):
    table = Table("references", ["scene", "frames", "its error of the image", "noise", "path tracer's frames", "its error", "its noise",
                                 "bias R G B [%]", "error of that [%]", "blocks beyond 2 (chance)", "beyond 3 (chance)"])
    for scene in dark:
        size = scene.size(context.options.width)
        ours, theirs = context.references.get(scene, size), context.references.get(scene, size, TRACER)
        x, r = blocks.of_pictures(ours.batches), blocks.of_pictures(theirs.batches)
        apart = blocks.difference(x, r)
        bias = (x.channel_mean - r.channel_mean) / r.channel_mean
        error = numpy.sqrt(x.channel_error ** 2 + r.channel_error ** 2) / r.channel_mean
        entry = {"scene": scene.name, "frames": ours.frames, "error": ours.error, "noise": ours.noise["relmse"],
                 "tracer_frames": theirs.frames, "tracer_error": theirs.error, "tracer_noise": theirs.noise["relmse"]}
        entry.update({f"bias_{c}": float(b) for c, b in zip("rgb", bias)})
        entry.update({f"bias_error_{c}": float(e) for c, e in zip("rgb", error)})
        for limit in (2, 3):
            entry[f"beyond_{limit}"], entry[f"chance_{limit}"] = apart.beyond(limit)
        table.data.append(entry)
        table.rows.append([scene.name, str(ours.frames), percent(ours.error), figure(entry["noise"]), str(theirs.frames),
                           percent(theirs.error), figure(entry["tracer_noise"]), signed_percents(bias),
                           " ".join(f"{100 * e:.2f}" for e in error),
                           *(f"{percent(entry[f'beyond_{n}'])} ({percent(entry[f'chance_{n}'])})" for n in (2, 3))])
    return table
