"""png.py: reads a PNG file of 8-bit R, G, B; Python's standard library only."""
import struct
import zlib


def read(path):
    """(width, height, rows of [(r, g, b), ...]) as codes."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert (depth, colour, interlaced) == (8, 2, 0), "not 8-bit R, G, B"
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, stride, above, rows = zlib.decompress(packed), 3 * width, bytes(3 * width), []
    for y in range(height):
        begin = y * (stride + 1)
        above = _unfiltered(raw[begin], bytearray(raw[begin + 1:begin + 1 + stride]), above)
        rows.append([tuple(above[3 * x:3 * x + 3]) for x in range(width)])
    return width, height, rows


def _unfiltered(kind, row, above):
    for i in range(len(row)):
        left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + up) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        elif kind == 4:
            nearest = min((abs(left + up - corner - p), order, p) for order, p in enumerate((left, up, corner)))
            row[i] = (row[i] + nearest[2]) & 255
    return bytes(row)
