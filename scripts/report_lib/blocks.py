"""Statistics of independent pictures of one scene: means of blocks of 16 x 16 pixels, their standard errors, and
what Student's t says of their differences.

Pixels of one picture share light sets, so that their errors are not independent; pictures of different seeds are.
With N pictures, block means m_i and s^2 = sum (m_i - mean)^2/(N-1):

    standard error of a block   e_b = s_b/sqrt(N)
    relative error, as film.h   sqrt(sum_b n_b e_b^2 / sum_b n_b) / mean luminance      b: blocks of n_b pixels
    difference of two means     t = (x - r)/sqrt(e_x^2 + e_r^2), degrees of freedom by Welch and Satterthwaite
"""
import dataclasses
import math

import numpy

from report_lib import pictures

BLOCK = 16


@dataclasses.dataclass
class Blocks:
    """Of N pictures: mean and standard error of the blocks (arrays) and of the image's channels (3 values)."""
    mean: numpy.ndarray
    error: numpy.ndarray
    pixels: numpy.ndarray  # n_b
    channel_mean: numpy.ndarray
    channel_error: numpy.ndarray
    count: int

    def image_error(self):
        """Relative standard error of the image's mean, of the channel where it is largest."""
        lit = self.channel_mean > 0
        return float((self.channel_error[lit] / self.channel_mean[lit]).max()) if lit.any() else 0.0

    def relative_error(self):
        """As --stats gives it: root mean square over blocks."""
        whole = self.pixels.sum()
        return math.sqrt((self.pixels * self.error ** 2).sum() / whole) / ((self.pixels * self.mean).sum() / whole)


def block_sums(plane):
    """Sums over blocks, less at the right and lower edge."""
    rows = numpy.arange(0, plane.shape[0], BLOCK)
    columns = numpy.arange(0, plane.shape[1], BLOCK)
    return numpy.add.reduceat(numpy.add.reduceat(plane, rows, axis=0), columns, axis=1)


def of_pictures(paths):
    """Needs at least two pictures."""
    pixels, means, channels = None, [], []
    for path in paths:
        picture = pictures.read(path)
        if pixels is None:
            pixels = block_sums(numpy.ones(picture.shape[:2]))
        means.append(block_sums(pictures.luminance(picture)) / pixels)
        channels.append(picture.astype(numpy.float64).mean(axis=(0, 1)))
    return Blocks(numpy.mean(means, axis=0), _error(means), pixels, numpy.mean(channels, axis=0), _error(channels),
                  len(paths))


def _error(values):
    return numpy.std(values, axis=0, ddof=1) / math.sqrt(len(values))


@dataclasses.dataclass
class Difference:
    """Of two sets of pictures of one scene, block by block."""
    t: numpy.ndarray
    freedom: numpy.ndarray  # 0 where both sides are the same without any noise: nothing to test
    relative: numpy.ndarray  # (x - r)/mean r of the image
    expected: float  # root mean square of `relative` if there is nothing but the stated errors

    def beyond(self, limit):
        """The fraction of blocks with |t| > limit, and the fraction that chance alone would put there."""
        tested = self.freedom > 0
        chance = [two_sided(limit, freedom) for freedom in self.freedom[tested]]
        return float((numpy.abs(self.t[tested]) > limit).mean()), float(numpy.mean(chance))

    def worst(self):
        """(column, row) of the block with the largest |t|."""
        row, column = numpy.unravel_index(numpy.abs(self.t).argmax(), self.t.shape)
        return int(column), int(row)


def difference(x, r):
    variance = x.error ** 2 + r.error ** 2
    mean = (r.pixels * r.mean).sum() / r.pixels.sum()
    least = (1e-9 * mean) ** 2  # of rounding
    same = (variance < least) & (numpy.abs(x.mean - r.mean) < 1e-6 * mean)
    e = numpy.sqrt(numpy.maximum(variance, least))
    freedom = e ** 4 / numpy.maximum(x.error ** 4 / (x.count - 1) + r.error ** 4 / (r.count - 1),
                                     e ** 4 / (x.count + r.count - 2))
    t = numpy.where(same, 0, (x.mean - r.mean) / e)
    return Difference(t, numpy.where(same, 0, freedom), (x.mean - r.mean) / mean,
                      math.sqrt(float(variance.mean())) / mean)


def two_sided(t, freedom, steps=400):
    """P(|T| > t) of Student's t, by Simpson's rule on its density."""
    logarithm = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - 0.5 * math.log(freedom * math.pi)
    x = numpy.linspace(0, t, 2 * steps + 1)
    density = numpy.exp(logarithm - (freedom + 1) / 2 * numpy.log1p(x * x / freedom))
    inside = t / (6 * steps) * (density[0] + density[-1] + 4 * density[1::2].sum() + 2 * density[2:-1:2].sum())
    return max(0.0, 1 - 2 * float(inside))
