"""Drawing for print: a card as a sheet of ink over foil. Lengths are millimetres, y points down, colours "#rrggbb"."""
import math, struct, zlib

import cairo
import numpy as np

WIDTH, HEIGHT = 63.0, 88.0  # mm, the unit of all lengths here; y points down
TEXELS_PER_MM = 20
TAU = 2 * math.pi
TITLES, CAPTIONS = "P052", "URW Gothic"


def sheet(colour=None):
    """A card without ink, or covered with it."""
    surface = cairo.ImageSurface(cairo.FORMAT_ARGB32, round(WIDTH * TEXELS_PER_MM), round(HEIGHT * TEXELS_PER_MM))
    c = cairo.Context(surface)
    c.scale(TEXELS_PER_MM, TEXELS_PER_MM)
    c.set_line_cap(cairo.LINE_CAP_ROUND)
    c.set_line_join(cairo.LINE_JOIN_ROUND)
    if colour:
        ink(c, colour)
        c.paint()
    return c


def ink(c, colour):
    c.set_operator(cairo.OPERATOR_OVER)
    c.set_source_rgb(*(int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)))


def glaze(c, colour, opacity):
    """Later drawing tints the foil. The opacity is less than a half: more of it hides the grooves."""
    c.set_operator(cairo.OPERATOR_SOURCE)
    c.set_source_rgba(*(int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)), opacity)


def foil(c):
    """Later drawing cuts holes into the ink, through which the foil shows."""
    c.set_operator(cairo.OPERATOR_CLEAR)


def between(colours, t):
    """A colour of a ramp, t from 0 to 1."""
    i = min(int(t * (len(colours) - 1)), len(colours) - 2)
    f = t * (len(colours) - 1) - i
    a, b = (np.array([int(colour[k:k + 2], 16) for k in (1, 3, 5)]) for colour in colours[i:i + 2])
    return "#%02x%02x%02x" % tuple(np.rint(a + (b - a) * f).astype(int))


def save(c, file, palette_size=256):
    """As PNG with a palette: the most frequent colours, and for the others the nearest of these."""
    surface = c.get_target()
    surface.flush()
    bgra = np.frombuffer(surface.get_data(), np.uint8).reshape(surface.get_height(), -1, 4).astype(np.int32)
    opacity = np.maximum(bgra[..., 3:], 1)
    rgba = np.concatenate([np.minimum((255 * bgra[..., 2::-1] + opacity // 2) // opacity, 255), bgra[..., 3:]], axis=2)
    texels, counts = np.unique(rgba.reshape(-1, 4) @ [1 << 24, 1 << 16, 1 << 8, 1], return_counts=True)
    colours = np.stack([texels >> shift & 255 for shift in (24, 16, 8, 0)], axis=1)
    palette = colours[np.argsort(-counts, kind="stable")[:palette_size]]
    index = np.array([np.argmin(((palette - colour) ** 2).sum(axis=1)) for colour in colours], np.uint8)
    rows = index[np.searchsorted(texels, rgba @ [1 << 24, 1 << 16, 1 << 8, 1])]
    data = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 3, 0, 0, 0)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head)
                     + chunk(b"PLTE", palette[:, :3].astype(np.uint8).tobytes())
                     + chunk(b"tRNS", palette[:, 3].astype(np.uint8).tobytes())
                     + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def disc(c, x, y, radius):
    c.new_sub_path()
    c.arc(x, y, radius, 0, TAU)


def line(c, points, closed=False):
    c.new_sub_path()
    for x, y in points:
        c.line_to(x, y)
    if closed:
        c.close_path()


def stroke(c, width):
    c.set_line_width(width)
    c.stroke()


def polar(x, y, radius, angle):
    return x + radius * math.cos(angle), y + radius * math.sin(angle)


def text(c, words, x, y, size, family, tracking):
    """Centred, letter by letter, with this much space between them. Small letters are bold: thin ones break on tilt."""
    weight = cairo.FONT_WEIGHT_BOLD if size < 2 else cairo.FONT_WEIGHT_NORMAL
    c.select_font_face(family, cairo.FONT_SLANT_NORMAL, weight)
    c.set_font_size(size)
    widths = [c.text_extents(letter).x_advance for letter in words]
    x -= (sum(widths) + tracking * (len(words) - 1)) / 2
    for letter, width in zip(words, widths):
        c.move_to(x, y)
        c.text_path(letter)
        x += width + tracking
    c.fill()


def panel(c, inset=0.0):
    """The picture's outline: notched corners, and a tab for the number at the top."""
    notch, tab = 2.6 + inset, 4.0 + inset
    c.new_sub_path()
    c.arc_negative(3.2, 3.2, notch, math.acos(inset / notch), math.asin(inset / notch))
    reach = math.sqrt(tab**2 - inset**2)
    c.arc_negative(31.5, 3.2, tab, math.atan2(inset, -reach), math.atan2(inset, reach))
    for x, y, turn in ((59.8, 3.2, 1), (59.8, 75.6, 2), (3.2, 75.6, 3)):
        a = math.acos(inset / notch)
        c.arc_negative(x, y, notch, turn * TAU / 4 + a, turn * TAU / 4 + TAU / 4 - a)
    c.close_path()


def frame(c, number, title, caption, ground, letters, rule=foil):
    """Ink around the picture; the number and the title on it."""
    ink(c, ground)
    c.set_fill_rule(cairo.FILL_RULE_EVEN_ODD)
    c.rectangle(0, 0, WIDTH, HEIGHT)
    panel(c)
    c.fill()
    c.set_fill_rule(cairo.FILL_RULE_WINDING)
    panel(c, -0.75)
    rule(c)
    stroke(c, 0.22)
    for x, y in ((3.2, 3.2), (59.8, 3.2), (59.8, 75.6), (3.2, 75.6)):
        disc(c, x, y, 0.42)
    c.fill()
    ink(c, letters)
    text(c, number, 31.5, 5.0, 2.7, TITLES, 0.25)
    text(c, title, 31.5, 81.3, 4.3, TITLES, 1.0)
    text(c, caption, 31.5, 84.7, 1.5, CAPTIONS, 0.42)


def star(c, x, y, radius, edge, heart):
    """Of four points."""
    for colour, size in ((edge, radius), (heart, 0.62 * radius)):
        ink(c, colour)
        line(c, [polar(x, y, size if k % 2 == 0 else 0.28 * size, k * TAU / 8) for k in range(8)], True)
        c.fill()


def noise(shape, cells, seed):
    """Value noise of a lattice of (rows, columns) cells, smooth, from 0 to 1."""
    lattice = np.random.RandomState(seed).rand(cells[0] + 2, cells[1] + 2)
    y, x = (np.linspace(0, n, count, endpoint=False) for n, count in zip(cells, shape))
    i, j = y.astype(int), x.astype(int)
    s, t = ((3 - 2 * f) * f * f for f in ((y - i)[:, None], (x - j)[None, :]))
    at = lambda di, dj: lattice[np.ix_(i + di, j + dj)]
    return (1 - s) * ((1 - t) * at(0, 0) + t * at(0, 1)) + s * ((1 - t) * at(1, 0) + t * at(1, 1))


def bezier(points, count):
    """Points of a chain of cubic curves: a start, then three points for each."""
    t = np.linspace(0, 1, count, endpoint=False)[:, None]
    p = np.array(points, float)
    parts = [(1 - t) ** 3 * p[i] + 3 * (1 - t) ** 2 * t * p[i + 1] + 3 * (1 - t) * t**2 * p[i + 2] + t**3 * p[i + 3]
             for i in range(0, len(p) - 1, 3)]
    return np.concatenate([*parts, p[-1:]])


def rosette(c, x, y, radius, depth, petals, turns, lines, width):
    """Guilloche: a closed wave around a circle, repeated with a shifting phase."""
    angles = np.linspace(0, TAU, 720)
    for i in range(lines):
        phase = TAU * i / lines
        radii = radius + depth * np.cos(petals * angles + phase) * (1 + 0.25 * np.cos(turns * angles - phase))
        line(c, zip(x + radii * np.cos(angles), y + radii * np.sin(angles)), True)
        stroke(c, width)
