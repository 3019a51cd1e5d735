"""Pictures as arrays (height, width, 3): reading, averaging, showing. Linear radiance, float32."""
import io
import math

import matplotlib
import numpy
import OpenImageIO as oiio

GAP = 4  # white pixels between the pictures of a sheet


def read(path):
    buffer = oiio.ImageBuf(path)
    if buffer.has_error:
        raise OSError(f"{path}: {buffer.geterror()}")
    channels = [buffer.spec().channelindex(name) for name in "RGB"]
    return numpy.asarray(buffer.get_pixels(oiio.FLOAT))[:, :, channels]


def write(path, pixels):
    """An .exr of floats, or a .png of bytes."""
    kind = oiio.UINT8 if pixels.dtype == numpy.uint8 else oiio.FLOAT
    height, width, channels = pixels.shape
    buffer = oiio.ImageBuf(oiio.ImageSpec(width, height, channels, kind))
    buffer.set_pixels(oiio.ROI(), numpy.ascontiguousarray(pixels))
    if not buffer.write(path):
        raise OSError(f"{path}: {buffer.geterror()}")


def write_small(path, source):
    """A picture of bytes again, as .jpg."""
    buffer = oiio.ImageBuf(source)
    buffer.specmod().attribute("Compression", "jpeg:90")
    if not buffer.write(path):
        raise OSError(f"{path}: {buffer.geterror()}")


def mean(paths):
    return (sum(read(path).astype(numpy.float64) for path in paths) / len(paths)).astype(numpy.float32)


def luminance(pixels):
    return pixels.astype(numpy.float64) @ (0.2126, 0.7152, 0.0722)


def shown(pixels, exposure=0.0):
    """Bytes for the screen, by the curve of common/image/tone_map.h."""
    x = numpy.maximum(pixels.astype(numpy.float64), 0) * 2 ** exposure
    knee = 0.8
    y = numpy.where(x <= knee, x, knee + (1 - knee) * (1 - numpy.exp(-(numpy.maximum(x, knee) - knee) / (1 - knee))))
    code = numpy.where(y <= 0.0031308, 12.92 * y, 1.055 * y ** (1 / 2.4) - 0.055)
    return numpy.round(255 * code).astype(numpy.uint8)


def good_exposure(reference):
    """The least whole EV that brings the 90th percentile of luminance to 0.25; 0 for the shipped scenes, more or less."""
    bright = numpy.percentile(luminance(reference), 90)
    return 0.0 if bright <= 0 else max(0.0, float(math.ceil(math.log2(0.25 / bright))))


def signed_error(picture, reference, scale):
    """Blue: too dark, red: too bright, full colour at `scale` (x - r)/(r + 0.1 mean r) of luminance."""
    r = luminance(reference)
    return diverging((luminance(picture) - r) / (r + 0.1 * r.mean()), scale)


def diverging(values, scale):
    """White at 0, blue at -scale, red at +scale; bytes."""
    colours = matplotlib.colormaps["bwr"](0.5 + 0.5 * numpy.clip(values / scale, -1, 1))
    return numpy.round(255 * colours[:, :, :3]).astype(numpy.uint8)


def beside_reference(reference, made):
    """One picture: the reference and those made, below these their signed errors."""
    exposure = good_exposure(reference)
    return sheet([[shown(picture, exposure) for picture in [reference, *made]],
                  [None] + [signed_error(picture, reference, 0.5) for picture in made]])


def sheet(rows):
    """One picture of rows of byte pictures of one size, None for a gap; a thin white line between them."""
    size = next(cell for row in rows for cell in row if cell is not None).shape
    lines = []
    for row in rows:
        cells = [numpy.full(size, 255, numpy.uint8) if cell is None else cell for cell in row]
        lines.append(_joined(cells, axis=1))
    return _joined(lines, axis=0)


def enlarged(pixels, least_width):
    """Each pixel as a square of so many that the picture is at least that wide."""
    times = -(-least_width // pixels.shape[1])
    return pixels.repeat(times, axis=0).repeat(times, axis=1)


def _joined(cells, axis):
    shape = list(cells[0].shape)
    shape[axis] = GAP
    line = numpy.full(shape, 255, numpy.uint8)
    parts = [part for cell in cells for part in (line, cell)][1:]
    return numpy.concatenate(parts, axis=axis)


def png_of_plot(figure):
    """The bytes of a matplotlib figure."""
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=80)
    return memory.getvalue()
