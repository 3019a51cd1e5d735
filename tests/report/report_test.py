#!/usr/bin/python3
"""The report's own arithmetic, on numbers whose answer is known; no renderer. Needs scripts/install_packages report.

Run it from anywhere: tests/report/report_test.py
"""
import itertools
import os
import pathlib
import sys
import tempfile
import unittest

import numpy

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

from report_lib import blocks, crops, keep, measure, motion_errors, motion_run, motion_scripts, motion_tables, motion_text  # noqa: E402
from report_lib import options, photon_bias, photon_stages, photon_vertices, pictures, plots, scenes, section, seconds_to_error  # noqa: E402
from report_lib import speed, tables  # noqa: E402
from report_lib.motion_truth import Truth  # noqa: E402
from report_lib.references import Reference  # noqa: E402


class StudentsT(unittest.TestCase):
    def test_tails_are_those_of_the_tables(self):
        # Two-sided 5 % and 1 % points of any table of Student's t.
        for freedom, t, tail in ((1, 12.706, 0.05), (7, 2.3646, 0.05), (7, 3.4995, 0.01), (30, 2.0423, 0.05),
                                 (1e6, 1.95996, 0.05)):
            self.assertAlmostEqual(blocks.two_sided(t, freedom), tail, delta=2e-4)


class Blocks(unittest.TestCase):
    def test_sums_of_a_size_that_is_no_multiple_of_a_block(self):
        sums = blocks.block_sums(numpy.ones((20, 40)))
        self.assertEqual(sums.tolist(), [[256, 256, 128], [64, 64, 32]])

    def test_equal_truths_differ_as_often_as_chance_says(self):
        random = numpy.random.default_rng(1)
        beyond, chance, ratios = [], [], []
        for _ in range(40):
            apart = blocks.difference(self.noisy(random, 6, 0.3), self.noisy(random, 4, 0.1))
            seen, expected = apart.beyond(2)
            beyond.append(seen)
            chance.append(expected)
            ratios.append((apart.relative ** 2).mean() / apart.expected ** 2)
        # 40 x 48 blocks: the standard deviations are below 0.008 and 0.04.
        self.assertAlmostEqual(numpy.mean(beyond), numpy.mean(chance), delta=0.03)
        self.assertAlmostEqual(numpy.mean(ratios), 1, delta=0.16)

    def test_a_wrong_block_stands_out(self):
        random = numpy.random.default_rng(2)
        x, r = self.noisy(random, 8, 0.1), self.noisy(random, 8, 0.1)
        x.mean[3, 5] += 2
        apart = blocks.difference(x, r)
        self.assertEqual(apart.worst(), (5, 3))
        self.assertGreater(apart.t[3, 5], 20)

    def test_blocks_without_noise_are_not_counted(self):
        random = numpy.random.default_rng(3)
        x, r = self.noisy(random, 4, 0.1), self.noisy(random, 4, 0.1)
        for side in (x, r):
            side.mean[1:], side.error[1:] = 7, 0
        x.mean[0] += 100
        apart = blocks.difference(x, r)
        self.assertEqual(apart.beyond(3)[0], 1)
        self.assertLess(apart.beyond(3)[1], 0.06)  # 3 degrees of freedom or more
        self.assertTrue((apart.t[1:] == 0).all())

    @staticmethod
    def noisy(random, count, deviation):
        """Means and errors of `count` pictures with 6 x 8 blocks of mean 10."""
        values = 10 + deviation * random.standard_normal((count, 6, 8))
        error = values.std(axis=0, ddof=1) / count ** 0.5
        return blocks.Blocks(values.mean(axis=0), error, numpy.full((6, 8), 256), None, None, count)

    def test_pictures_give_the_error_between_them(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for number, value in enumerate((1.0, 2.0, 3.0)):
                paths.append(os.path.join(folder, f"{number}.exr"))
                pictures.write(paths[-1], numpy.full((20, 40, 3), value, numpy.float32))
            found = blocks.of_pictures(paths)
        # Mean 2, deviation 1, error 1/sqrt 3 in each block.
        self.assertAlmostEqual(found.relative_error(), 0.5 / 3 ** 0.5, places=5)
        self.assertAlmostEqual(found.channel_error[1], 1 / 3 ** 0.5, places=5)


def entry(seconds, relmse, noise=0.0):
    return {"scene": "s", "method": "m", "seconds": seconds, "relmse": relmse + noise, "noise_relmse": noise,
            "relmse_trimmed": relmse, "noise_relmse_trimmed": 0.0,
            "rmse_percent": 1000.0, "noise_rmse_percent": 0.0}


class EverySection(unittest.TestCase):
    def test_can_be_loaded(self):
        for name in options.SECTIONS:
            self.assertTrue(callable(section.module_of(name).run), name)


class Speed(unittest.TestCase):
    def test_no_method_of_the_program_is_left_out_or_made_twice(self):
        variants = speed.with_all_methods(["instant-radiosity", "path-trace", "bidirectional", "photon-map", "new"])
        self.assertEqual({name: flags for name, flags in variants.items() if name not in speed.METHODS},
                         {"photon-map": ("--method", "photon-map"), "new": ("--method", "new")})
        self.assertNotIn("photon-map", speed.UNBIASED)


def grey(value, size=(4, 6)):
    return numpy.full((*size, 3), value, numpy.float32)


class MotionErrors(unittest.TestCase):
    def test_relmse_is_that_of_its_formula(self):
        # Truth 2 and 6 in halves, mean 4; over it 0.5 and 1.5; the picture is 1 too bright: 0.25 of the mean.
        truth = numpy.concatenate([grey(2), grey(6)])
        expected = 0.5 * (0.0625 / (0.25 + 0.01) + 0.0625 / (2.25 + 0.01))
        self.assertAlmostEqual(motion_errors.errors(truth + 1, truth)[0], expected, places=6)

    def test_trimmed_leaves_out_one_in_a_thousand(self):
        truth, picture = grey(1, (40, 50)), grey(1, (40, 50))
        picture[3, 7] = picture[9, 9] = 100  # 2 of 2000
        self.assertGreater(motion_errors.errors(picture, truth)[0], 9)
        self.assertEqual(motion_errors.errors(picture, truth)[1], 0)

    def test_the_truths_noise_is_what_it_adds(self):
        random = numpy.random.default_rng(5)
        exact = grey(3, (120, 160))
        a, b, picture = (exact + s * random.standard_normal(exact.shape) for s in (0.3, 0.3, 0.6))
        seen, noise = motion_errors.errors(picture, (a + b) / 2)[0], motion_errors.noise(a, b)[0]
        # (0.6^2 + 0.3^2/2)/9/1.01; the standard deviation of 57,600 squares is below 1 %.
        # r has a variance of its own, 0.005 of its square: 1/r^2 is 1.015 times as much.
        self.assertAlmostEqual(noise, 1.015 * 0.045 / 9 / 1.01, delta=1e-4)
        self.assertAlmostEqual(seen - noise, 1.015 * 0.36 / 9 / 1.01, delta=1e-3)

    def test_a_smaller_picture_is_enlarged_between_its_pixels_centres(self):
        small = numpy.array([[[0.0] * 3, [4.0] * 3]], numpy.float32)
        # Centres of four pixels at -0.25, 0.25, 0.75 and 1.25 of two.
        self.assertEqual(motion_errors.on_screen(small, 3, 4)[:, :, 0].tolist(), [[0, 1, 3, 4]] * 3)
        whole = numpy.arange(24, dtype=numpy.float32).reshape(2, 4, 3)
        self.assertTrue((motion_errors.on_screen(whole, 2, 4) == whole).all())

    def test_what_is_late_by_a_time_has_that_delay_whatever_its_scale(self):
        change = motion_scripts.LAMP
        def bright(time):
            return 8 - 6 * min(max(time - change.begin, 0), 1)
        times = [i / 10 for i in range(91)]
        true = [(t, bright(t)) for t in times]
        for late in (0, 0.05, 0.3):
            seen = [(t, 1.1 * bright(t - late) + 0.2) for t in times]
            self.assertAlmostEqual(1000 * motion_errors.delay(seen, true, change, 9, 0.4), 1000 * late, delta=1e-6)

    def test_new_noise_flickers_as_much_as_it_errs_and_what_moves_is_left_out(self):
        random = numpy.random.default_rng(6)
        truth = grey(2, (120, 160))
        before, picture = (truth + 0.2 * random.standard_normal((120, 160, 1)) for _ in range(2))
        error = motion_errors.errors(picture, truth)[0]
        self.assertAlmostEqual(motion_errors.flicker(before, picture, truth, truth), error, delta=0.04 * error)
        self.assertEqual(motion_errors.flicker(picture, picture, truth, truth), 0)
        moved, jumped = truth.copy(), picture.copy()
        moved[:60], jumped[:60] = 20, 20
        self.assertAlmostEqual(motion_errors.flicker(before, jumped, truth, moved),
                               error * 2.0 ** 2 / 11 ** 2 * (1 + 0.01) / ((2 / 11) ** 2 + 0.01), delta=0.06 * error)
        self.assertIsNone(motion_errors.flicker(before, picture, truth, 3 * truth))


class Motion(unittest.TestCase):
    """A session of four shots, the truth of shot i being i + 1 everywhere."""
    TRUTH = Truth([grey(i + 1.0) for i in range(91)], [[0.01, 0.001]] * 91)

    @staticmethod
    def times(shots, lost=()):
        return {"shots": [{"shot": i, "frame": 7, "opened": i / 10 - 0.03, "shown": i / 10 - 0.01, "frames": 1, "lost": i in lost}
                          for i in shots],
                "frames": [{"moving": True, "width": 160, "took_ms": 20}] * 9, "latency_ms": {"p50": 30, "p95": 50}}

    def test_each_shot_is_held_against_the_truth_of_its_own_moment(self):
        shown = {0: grey(1.0), 1: grey(2.0), 3: grey(2.0, (2, 3))}
        entries = motion_run.measured(self.times(range(4), lost=[2])["shots"], shown, self.TRUTH)
        self.assertEqual([e["shot"] for e in entries], [0, 1, 3])
        self.assertEqual([e["time"] for e in entries], [0, 0.1, 0.3])
        # Shot 3 shows 2 in place of 4: half of the mean is missing.
        for e, error in zip(entries, (0, 0, 0.25 / 1.01)):
            self.assertAlmostEqual(e["relmse"], error, places=6)
            self.assertAlmostEqual(e["net_relmse"], error - 0.01, places=6)
            self.assertAlmostEqual(e["net_trimmed"], error - 0.001, places=6)
            self.assertAlmostEqual(e["age"], 0.03)
        self.assertEqual([e["flicker"] for e in entries], [None] * 3)  # all pixels change, and none before shot 3

    def made(self):
        def run(factor):
            return motion_run.Run(self.times(range(91)), {i: factor * self.TRUTH.pictures[i] for i in range(91)}, self.TRUTH, 2.5)
        return {"room": {"a": [run(1.2), run(1.4)], "b": [run(2)]}}

    def test_tables_tell_means_of_phases_and_medians_of_runs(self):
        table = motion_tables.phases(self.made())
        self.assertEqual(len(table.data), 2 * len(motion_scripts.PHASES))
        a, b = table.data[:2]
        self.assertEqual((a["scene"], a["phase"], a["method"], a["runs"]), ("room", "at rest", "a", 2))
        self.assertAlmostEqual(a["relmse"], (0.04 + 0.16) / 2 / 1.01 - 0.01, places=6)
        self.assertAlmostEqual(a["relmse_least"], 0.04 / 1.01 - 0.01, places=6)
        self.assertAlmostEqual(a["relmse_largest"], 0.16 / 1.01 - 0.01, places=6)
        self.assertAlmostEqual(b["trimmed"], 1 / 1.01 - 0.001, places=6)
        self.assertIsNone(b["flicker"])  # no pixel rests in this session
        self.assertEqual(len(table.rows), len(motion_scripts.PHASES))
        pace = motion_tables.pace(self.made()).data[0]
        self.assertAlmostEqual(pace["frames_a_second"], 9 / 4.5)
        self.assertEqual((pace["width"], pace["latency_p95"], pace["lost"]), (160, 50, 0))
        self.assertAlmostEqual(pace["age"], 30)
        self.assertEqual(pace["load"], 2.5)

    def test_the_file_has_all_moments_and_the_plot_is_one(self):
        made = self.made()
        table = motion_tables.moments(made)
        self.assertEqual(len(table.rows), 2)
        lines = table.csv().splitlines()
        self.assertEqual(lines[0], "scene,method,time,relmse,trimmed")
        self.assertEqual(len(lines), 1 + 2 * 91)
        series = motion_tables.over_time(made, "net_relmse")
        self.assertAlmostEqual(dict(series["room"]["b"])[2], 1 / 1.01 - 0.01, places=6)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "plot.png")
            plots.error_in_motion(path, series, "relMSE", motion_scripts.PHASES, {"room": [(0, 0.01), (9, 0.01)]})
            self.assertEqual(pictures.read(path).shape[2], 3)

    def test_words_are_those_of_the_figures(self):
        phases, pace = motion_tables.phases(self.made()).data, motion_tables.pace(self.made()).data
        room, overall = motion_text.findings(phases, pace)
        self.assertIn("Walk: a has the least error (0.098), b 10 times as much.", room)
        self.assertNotIn("After the walk", room)
        self.assertIn("geometric mean of phases and scenes: a 0.098, b 0.99.", overall)

    def test_phases_are_the_whole_script_and_pictures_are_of_motion(self):
        self.assertEqual(motion_scripts.PHASES[0].begin, 0)
        for before, after in itertools.pairwise(motion_scripts.PHASES):
            self.assertEqual(before.end, after.begin)
        moving = [phase for phase in motion_scripts.PHASES if phase.moves]
        self.assertEqual([sum(phase.has(m) for m in motion_tables.MOMENTS) for phase in moving], [1, 1, 1])
        self.assertEqual(motion_scripts.count(10), 91)
        script = motion_scripts.script(motion_scripts.COURSES["cornell"], shots=10)
        self.assertEqual([(e["from"], e["to"]) for e in script["events"]], [(p.begin, p.end) for p in moving])


class SecondsToError(unittest.TestCase):
    def test_a_series_that_falls_as_one_over_t_meets_its_limit_where_it_must(self):
        points = [(t, 0.3 / t) for t in (1, 2, 4, 8, 16)]
        self.assertAlmostEqual(seconds_to_error.crossing(points, 0.1), 3)
        self.assertEqual(seconds_to_error.crossing(points, 0.5), 1)
        self.assertIsNone(seconds_to_error.crossing(points, 0.001))

    def test_the_table_tells_what_was_not_measured(self):
        data = [entry(t, 0.3 / t, noise=0.02) for t in (1, 2, 4, 8)]
        reference = Reference("", [], 1, 1, 0.001, {"relmse": 0.02, "relmse_trimmed": 0.0, "rmse_percent": 1.0})
        row = seconds_to_error.targets_table(data, {"s": reference}, unbiased=("m",)).rows[0]
        self.assertEqual(row, ["s", "m", "3", "> 8 (~ 30)", "> 8 (~ 300)", "3", "> 8 (~ 30)", "> 8 (~ 300)",
                               "> 8 (~ 8000000)"])

    def test_an_error_below_the_references_noise_cannot_be_told(self):
        data = [entry(t, 0.003 / t, noise=0.02) for t in (1, 2, 4, 8)]
        reference = Reference("", [], 1, 1, 0.001, {"relmse": 0.02, "relmse_trimmed": 0.0, "rmse_percent": 1.0})
        row = seconds_to_error.targets_table(data, {"s": reference}, unbiased=("m",)).rows[0]
        self.assertEqual(row[2:6], ["< 1", "< 1", "reference too noisy", "< 1"])

    def test_the_references_noise_is_taken_off(self):
        self.assertAlmostEqual(measure.net(entry(1, 0.3, noise=0.1), "relmse"), 0.3)
        self.assertIsNone(measure.net(entry(1, 0.02, noise=0.1), "relmse"))


class PhotonMap(unittest.TestCase):
    def test_curves_meet_where_they_must(self):
        x = (25, 50, 100, 200, 400)
        # a x and the constant b meet at b/a.
        self.assertAlmostEqual(photon_stages.meeting(x, [0.01 * v for v in x], [0.7] * 5), 70)
        self.assertAlmostEqual(photon_stages.meeting(x, [0.7] * 5, [0.01 * v for v in x]), 70)
        self.assertAlmostEqual(photon_stages.meeting(x, [0.01 * v for v in x], [4.0] * 5), 400)
        self.assertIsNone(photon_stages.meeting(x, [0.01 * v for v in x], [7.0] * 5))

    def test_a_flag_is_replaced_or_added(self):
        self.assertEqual(photon_stages.replaced(("--a", "1", "--b", "2"), "--a", 3), ("--b", "2", "--a", "3"))
        self.assertEqual(photon_stages.replaced(("--a", "1"), "--c", 3), ("--a", "1", "--c", "3"))

    def test_ways_to_save_estimates_are_curves_over_triangles(self):
        made = {"shoot_ms": 2.0, "vertices": {way: {"count": 30 + i, "ms": 0.5 * i} for i, way in enumerate(photon_vertices.WAYS)}}
        self.assertEqual(photon_vertices.triangles_of(made), 10)
        self.assertEqual(photon_vertices.curves([(made, 1.0)])["shoot, simpler scene"], [1.0])
        self.assertEqual(photon_vertices.curves([(made, None)]), {"shoot": [2.0], "all": [0.0], "front": [0.5], "corners": [1.0],
                                                                  "both": [1.5], "asked": [2.0]})

    def test_the_slope_is_that_of_the_power(self):
        points = [(n, 7 * n ** -0.75) for n in (1e3, 1e4, 1e5)]
        self.assertAlmostEqual(photon_bias.slope(points + [(1e6, -1e-9)]), -0.75)
        self.assertIsNone(photon_bias.slope([(1e3, 1.0), (1e4, 0.0)]))

    def test_noise_has_no_part_in_the_error_that_is_common(self):
        random = numpy.random.default_rng(3)
        noise = [random.standard_normal((200, 200, 3)) for _ in range(4)]
        pictures_ = [2.2 + 0.4 * noise[0], 2.2 + 0.4 * noise[1], 2.0 + 0.02 * noise[2], 2.0 + 0.02 * noise[3]]
        # Over the mean, 2: bias 0.1, noise 0.2. Standard error of the product's mean: 0.2^2/sqrt(120000) and sqrt(2) 0.1 x 0.2/...
        self.assertAlmostEqual(photon_bias.common_error(*pictures_), 0.01 / 1.01, delta=6e-4)
        pictures_[1] = pictures_[0]
        self.assertAlmostEqual(photon_bias.common_error(*pictures_), (0.01 + 0.04) / 1.01, delta=2e-3)


class Pictures(unittest.TestCase):
    def test_the_curve_is_that_of_the_programs(self):
        # common/image/tone_map.h: black, the knee, far above it.
        codes = pictures.shown(numpy.array([[[0.0, 0.18, 0.8], [1.0, 100.0, -1.0]]]))
        self.assertEqual(codes.tolist(), [[[0, 118, 231], [247, 255, 0]]])

    def test_too_bright_is_red_and_too_dark_is_blue(self):
        reference = numpy.ones((1, 3, 3), numpy.float32)
        picture = reference * numpy.array([2.0, 1.0, 0.0], numpy.float32).reshape(1, 3, 1)
        self.assertEqual(pictures.signed_error(picture, reference, 0.5)[0].tolist(), [[255, 0, 0], [255, 254, 254], [0, 0, 255]])


    def test_enlarged_pixels_are_squares_of_at_least_the_width(self):
        large = pictures.enlarged(numpy.array([[[1], [2], [3]], [[4], [5], [6]]]), 7)
        self.assertEqual(large.shape, (6, 9, 1))
        self.assertEqual(large[:, :, 0].tolist(), [[1] * 3 + [2] * 3 + [3] * 3] * 3 + [[4] * 3 + [5] * 3 + [6] * 3] * 3)


class Crops(unittest.TestCase):
    def test_lie_in_the_picture_and_keep_its_shape_whatever_its_size(self):
        self.assertEqual(set(crops.CROPS), set(scenes.SHIPPED))
        for parts in crops.CROPS.values():
            for crop in parts:
                for width in (160, 640):
                    height = width * 3 // 4
                    shape = crop.of(numpy.zeros((height, width, 3))).shape
                    self.assertEqual(shape, (round(crop.side * height), round(crop.side * width), 3), crop.name)

    def test_begin_where_they_say(self):
        pixels = numpy.arange(40 * 30).reshape(30, 40, 1)
        part = crops.Crop("", 0.5, 0.1, 0.2).of(pixels)
        self.assertEqual((part[0, 0, 0], part[-1, -1, 0]), (3 * 40 + 20, 8 * 40 + 27))


class Kept(unittest.TestCase):
    MADE = {"date": "today", "commit": "none", "machine": "none", "options": "none"}

    def keep(self, folder, name, text, table):
        made = section.Section(name, "About " + name, [text], [tables.Table(table, ["a"], [["1"]], [{"a": 1}])], [], self.MADE)
        keep.write(folder, [made], folder)

    def test_a_section_takes_its_own_place_and_leaves_the_others_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text, table in (("x", "first", "t1"), ("y", "second", "t2"), ("x", "third", "t3")):
                self.keep(folder, name, text, table)
            with open(os.path.join(folder, "results.md"), encoding="utf-8") as file:
                text = file.read()
            self.assertEqual([text.count(word) for word in ("first", "second", "third")], [0, 1, 1])
            self.assertLess(text.index("third"), text.index("second"))
            self.assertEqual(sorted(os.listdir(folder)), ["results.md", "t2.csv", "t3.csv"])


class Tables(unittest.TestCase):
    def test_figures(self):
        self.assertEqual([tables.figure(x) for x in (0.0012345, 12.345, 123456.0, None, float("inf"))],
                         ["0.00123", "12.3", "123456", "-", "-"])


if __name__ == "__main__":
    unittest.main()
