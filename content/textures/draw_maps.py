#!/usr/bin/env python3
"""draw_maps.py FOLDER: draws again the maps of the wing cases, the glitter card and the oil that the scenes hold. Always
the same bytes."""
import math, pathlib, random, struct, sys, zlib

FOLDER = pathlib.Path(sys.argv[1])
STEP = 4  # of normals and roughness: small files


def write_png(name, rows):
    """rows: of texels, each a tuple of one or three bytes."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    data = b"".join(b"\0" + bytes(value for texel in row for value in texel) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2 if len(rows[0][0]) == 3 else 0, 0, 0, 0)
    (FOLDER / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(data, 9))
                                + chunk(b"IEND", b""))


def byte(x):
    return min(max(round(255 * x), 0), 255)


def map_of(height, width, texel):
    return [[texel(column / width, row / height) for column in range(width)] for row in range(height)]


def write_normals(name, heights, strength):
    """heights: rows of texels, which repeat in both directions. Green points up, as glTF's."""
    rows, columns = len(heights), len(heights[0])

    def texel(x, y):
        slope_x = strength * (heights[y][(x + 1) % columns] - heights[y][x - 1])
        slope_y = strength * (heights[(y + 1) % rows][x] - heights[y - 1][x])
        length = math.sqrt(slope_x**2 + slope_y**2 + 1.0)
        return tuple(min(128 + STEP * round(128 / STEP * n / length), 255) for n in (-slope_x, slope_y, 1.0))

    write_png(name, [[texel(x, y) for x in range(columns)] for y in range(rows)])


def dent(heights, x, y, half_x, half_y, depth):
    """A round dent of these half axes in texels, with a low rim."""
    rows, columns = len(heights), len(heights[0])
    for row in range(math.floor(y - 2 * half_y), math.ceil(y + 2 * half_y) + 1):
        for column in range(math.floor(x - 2 * half_x), math.ceil(x + 2 * half_x) + 1):
            r = math.hypot((column - x) / half_x, (row - y) / half_y)
            heights[row % rows][column % columns] -= depth * (math.exp(-2 * r * r) - 0.25 * math.exp(-2 * (r - 1.3) ** 2))


def beetle():
    """Two of the eight intervals between striae, 64 texels wide; a stria has 46 punctures along the body."""
    random.seed(9)
    case = [[0.0] * 128 for _ in range(1024)]
    for stria in range(2):
        for i in range(46):
            dent(case, 64 * stria + random.gauss(0, 1.5), (i + random.uniform(-0.2, 0.2)) * 1024 / 46,
                 random.uniform(5.0, 6.5), random.uniform(5.5, 7.5), random.uniform(2.0, 3.4))
    for _ in range(130):
        dent(case, random.uniform(0, 128), random.uniform(0, 1024), 2.2, 2.2, random.uniform(0.3, 0.8))
    write_normals("beetle_wing_case.png", case, 0.5)


def glitter():
    """A facet a texel: 32 directions of its grooves; 15 % are bare."""
    random.seed(21)
    write_png("glitter_grooves.png", [[(8 * random.randrange(32), 128 if random.random() < 0.85 else 0, 0)
                                       for _ in range(256)] for _ in range(256)])


def waves(seed, count, highest_x, highest_y):
    """A smooth random function that repeats from 0 to 1 in both directions, of about ±1."""
    random.seed(seed)
    terms = [(random.randint(-highest_x, highest_x), random.randint(1, highest_y), random.uniform(0, 2 * math.pi))
             for _ in range(count)]
    return lambda x, y: sum(math.sin(2 * math.pi * (a * x + b * y) + c) for a, b, c in terms) / math.sqrt(count / 2)


def oil():
    """Thickness of oil that spreads on water, in its green channel: stirred, thin at its edge, none beyond."""
    stir_x, stir_y, depth, edge = waves(11, 6, 2, 2), waves(12, 6, 2, 2), waves(13, 6, 3, 3), waves(14, 8, 3, 3)

    def thickness(x, y):
        r = 2 * math.hypot(x - 0.5, y - 0.5)
        inside = min(max((0.82 + 0.07 * edge(x, y) - r) / 0.02, 0), 1)
        for _ in range(5):
            x, y = x + 0.018 * stir_x(x, y), y + 0.018 * stir_y(x, y)
        r = 2 * math.hypot(x - 0.47, y - 0.54)
        return (0, byte(inside * max(0.68 - 0.62 * r + 0.07 * depth(x, y), 0.12)), 0)

    write_png("oil_thickness.png", map_of(512, 512, thickness))


for draw in (beetle, glitter, oil):
    draw()
