"""What is on the screen against the truth of the same moment. Pure: arrays and times go in, figures come out.

relMSE, as ninefold-compare has it (common/image/metrics.h), x the picture and r the truth, both over the truth's mean luminance:

    relMSE = mean of (x - r)^2/(r^2 + 0.01)          trimmed: without the 0.1 % of pixels where it is largest

The truth is the mean r of two halves a and b of other seeds. Its own noise adds to each error: a - r = (a - b)/2 has the variance of
r, so that it is relMSE(a, r), and likewise trimmed.

Delay of a change, of pictures that are a times as bright as the truth and b beside it, whatever a and b:

    p(t) = (m(t) - m_0)/(m_1 - m_0)          m: mean luminance; m_0, m_1: at rest before and after
    delay = integral of p_truth - p_picture  [s]

A picture that is only late by d has the delay d.

Flicker, of the pixels that rest, and those are known by the truth alone; all over the truth's mean luminance:

    flicker = mean of (y(i) - y(i-1))^2/2 / (Y^2 + 0.01)          y: luminance of shots i and i-1, Y: of the truth

Noise that is new in each shot has as much flicker as relMSE; what stands still has none.
"""
import numpy

from report_lib import pictures

ERRORS = {"relmse": "relMSE", "trimmed": "relMSE, trimmed"}
TRIMMED = 0.001  # of the pixels
RESTS = 0.05  # of a pixel, and of a tenth of the mean: what it may change by if it rests
LEAST_SHARE = 0.1  # of the pixels must rest, or flicker is not told


def errors(picture, truth):
    """In the order of ERRORS."""
    x, r = picture.astype(numpy.float64), truth.astype(numpy.float64)
    scale = 1 / pictures.luminance(truth).mean()
    terms = numpy.sort((scale ** 2 * (x - r) ** 2 / ((scale * r) ** 2 + 0.01)).mean(axis=2), axis=None)
    return [float(terms.mean()), float(terms[:terms.size - int(TRIMMED * terms.size)].mean())]


def noise(half, other):
    """Of their mean, in the order of ERRORS."""
    return errors(half, (half + other) / 2)


def on_screen(pixels, height, width):
    """As large as the window: between the centres of the pixels evenly, as OpenGL does it (GL_LINEAR)."""
    for axis, wanted in ((0, height), (1, width)):
        there = pixels.shape[axis]
        if there == wanted:
            continue
        place = numpy.clip((numpy.arange(wanted) + 0.5) * there / wanted - 0.5, 0, there - 1)
        first = numpy.minimum(place.astype(int), there - 2) if there > 1 else numpy.zeros(wanted, int)
        shape = [-1 if a == axis else 1 for a in range(3)]
        part = (place - first).reshape(shape).astype(numpy.float32)
        last = numpy.minimum(first + 1, there - 1)
        pixels = pixels.take(first, axis) * (1 - part) + pixels.take(last, axis) * part
    return pixels


def of_phase(points, phase):
    """points: [(time, value)]. The mean of those that have a value; None if there are none."""
    values = [value for time, value in points if phase.has(time) and value is not None]
    return float(numpy.mean(values)) if values else None


def delay(seen, true, change, end, rest):
    """seen, true: [(time, mean luminance)] of the same times, evenly apart; change: a phase; end: of what is looked at [s];
    rest: how long before the change and before the end pictures are at rest [s]."""
    parts = [_part(points, change.begin, end, rest) for points in (seen, true)]
    step = true[1][0] - true[0][0]
    return step * sum(t - s for s, t in zip(*parts))


def _part(points, begin, end, rest):
    """What is there of the change, at all times from `begin` to `end`."""
    before = numpy.mean([m for t, m in points if begin - rest <= t < begin])
    after = numpy.mean([m for t, m in points if end - rest <= t < end])
    return [(m - before) / (after - before) for t, m in points if begin <= t < end]


def flicker(before, picture, truth_before, truth):
    """None if hardly a pixel rests."""
    old, new = pictures.luminance(truth_before), pictures.luminance(truth)
    rests = numpy.abs(new - old) <= RESTS * (new + 0.1 * new.mean())
    if rests.mean() < LEAST_SHARE:
        return None
    scale = 1 / new.mean()
    steps = scale * (pictures.luminance(picture) - pictures.luminance(before))[rests]
    return float((0.5 * steps ** 2 / ((scale * new[rests]) ** 2 + 0.01)).mean())
