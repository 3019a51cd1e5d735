"""Section: the photon map beside its paper: times of its stages (Figures 21 to 27), its Table 1 as measured rows, the four
distributions, how late it is, and its bias as the pool grows."""
from report_lib import photon_bias, photon_motion, photon_stages, photon_vertices
from report_lib.section import Section

TEXT = [
    "After Jozwowski, \"Real Time Photon Mapping\", 2002. Stages and motion are measured by ninefold-photon-map in one thread. "
    "The scene 'box' is a room like his, with two boxes in it and a point light on a circle (tools/map_box.h); sizes are ours. "
    "Published settings: 2,000 paths, 100 of them shot anew each frame, 100 nearest, path length 3 (his max_level), direct light "
    "in the photons (--map-direct on), k-d tree.",
    "Times: processor time of the stages of one frame, medians. 'Shoot': one unit. 'Balance': the k-d tree anew, as "
    "published. 'Build': our grid anew; 'update': one unit out of it and one in, which is what he wished for. 'Estimate': at each "
    "pixel, not at vertices; eye paths are traced outside of it. 'Rest': eye paths and what else a picture needs. He has no such "
    "stage: his vertices are drawn by OpenGL. Dotted: where shooting takes as long as balancing, his rule of thumb. A photon "
    "meets surfaces by a hierarchy here, not by trying all of them, so surfaces cost next to nothing.",
    "Table 1: fluctuation, error and lag of too few and too many photons, random distribution, lamp at rest and on its circle of 100 "
    "frames. Variance: of luminance over frames, mean over pixels, over the squared mean. Flicker: mean squared step from frame to "
    "frame of the difference from the truth, halved, over the same: noise that is new in each frame has as much of it as of "
    "variance; what is only late has none. relMSE: mean of all frames on the circle, each against the truth of its moment, a pool "
    "of many more photons (tools/map_motion.h). Lag: frames until 95 % of a jump of the lamp is seen, beside 0.95 total/per-frame.",
    "Bias: relMSE that stays when frames are averaged, against the path tracer at the same path length (none). Of two runs of unlike "
    "seeds and two halves of the reference, (x1 - r1)(x2 - r2): noise cancels in the mean, and what is left of it may be below 0.",
    "Light at vertices (--map-estimate vertices), as published, over the triangles of the mesh: one estimate for each corner of each "
    "triangle; for those whose front is turned to the eye (culling, his Figure 26); for each vertex once (corners, Figure 27); both; "
    "and for those around what a pixel sees, which is what the program does, with the time of carrying it to all pixels. With the "
    "photons in the room of 16 surfaces, whatever the number that is seen (--photon-scene, Figure 25), shooting takes the same time. A "
    "surface of the box is two triangles; office has no simpler form."]


def run(context):
    section = Section("photon-map", "Photon map", list(TEXT))
    for part in (photon_stages, photon_vertices, photon_motion, photon_bias):
        part.add_to(context, section)
    return section
