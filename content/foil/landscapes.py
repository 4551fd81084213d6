"""The cards The Mountain, The Heavens, The Crystal and The Wave."""
import math, random

import cairo
import numpy as np

from sheet import (TAU, WIDTH, between, bezier, disc, foil, frame, glaze, ink, line, noise, polar, save, sheet, star,
                   stroke)


def conifer(c, x, y, height, chance):
    points = [(x, y - height)]
    for side in (1, -1):
        tiers = [(x + side * height * 0.21 * (k / 8) ** 0.85 * chance.uniform(0.75, 1.15), y - height * (1 - k / 8.4))
                 for k in range(1, 9)]
        edge = [point for tx, ty in tiers for point in ((tx, ty), (x + (tx - x) * 0.55, ty - 0.03 * height))]
        points = points + edge if side == 1 else points + edge[::-1]
    line(c, points, True)
    c.fill()


def mountain(folder):
    dusk = ["#f3b79a", "#dd8f93", "#a5709a", "#675a97", "#3b4179", "#232a56", "#171c3f"]
    c = sheet()
    x0, y0 = 31.5, 25.5
    halo = [12.4 + 0.9 * i + 0.035 * i * i for i in range(22)]
    for i, radius in reversed(list(enumerate(halo))):  # the evening around the moon, ring by ring
        glaze(c, between(["#f7c9a0", "#d98aa0", "#6a58a8", "#2f3578"], i / 21), 0.16 + 0.012 * i)
        disc(c, x0, y0, radius if i < 21 else 80)
        c.fill()
    ink(c, "#232a56")
    for i, radius in enumerate(halo[:16]):
        disc(c, x0, y0, radius)
        stroke(c, 0.34 * (1 - i / 17))
    ink(c, "#fbeed2")
    disc(c, x0, y0, 10)
    c.fill()
    foil(c)
    for i in range(16):  # its seas: engraved lines
        y = y0 - 1.5 + 0.7 * i
        half = math.sqrt(max(10.0**2 - (y - y0) ** 2, 0))
        line(c, [(x0 - half, y), (x0 - half + 2 * half * min(0.25 + 0.05 * i, 0.9), y)])
        stroke(c, 0.05 + 0.022 * i)
    rows, columns = 30, 420
    ridged = 0
    for octave in range(6):
        wave = noise((rows, columns), (2 + 2 * octave, 3 * 2**octave), 40 + octave)
        ridged = ridged + (1 - np.abs(2 * wave - 1)) ** 1.5 * 0.5**octave
    xs = np.linspace(0, WIDTH, columns)
    for row in range(rows):
        depth = row / (rows - 1)
        massif = np.exp(-((xs - 33 + 26 * (depth - 0.25)) / (15 + 12 * depth)) ** 2)
        heights = ridged[row] * (3.0 + 13.5 * massif * (1 - depth) ** 0.8 + 2 * depth * (1 - massif)) * (1 - depth**6)
        ys = 50 + 16.5 * depth**1.1 - heights
        ink(c, between(dusk, depth))
        line(c, [(0, 66.5), *zip(xs, ys), (WIDTH, 66.5)], True)
        c.fill()
        foil(c)
        line(c, zip(xs, ys))
        stroke(c, 0.13 + 0.07 * depth)
    chance = random.Random(5)
    for i in range(19):  # the lake, and the moon in it
        y = 66.9 + 0.62 * i
        x = -chance.uniform(0, 8)
        while x < WIDTH:
            length = chance.uniform(3, 13)
            near = abs(x + length / 2 - x0) < 2.2 + 0.42 * i
            ink(c, "#fbeed2" if near and i % 3 else dusk[4 + i // 7])
            line(c, [(x, y), (x + length * (0.6 if near else 1), y)])
            stroke(c, 0.16 + 0.011 * i)
            x += length + chance.uniform(0.7, 2.4)
    ink(c, dusk[-1])
    for _ in range(72):
        x = chance.uniform(2, 61)
        aside = abs(x - 31.5) / 28
        conifer(c, x, 77 + chance.uniform(-1, 1), 3 + chance.uniform(0.5, 1) * 15 * aside**2.4, chance)
    frame(c, "I", "THE MOUNTAIN", "PILLARS OF LIGHT  ·  GROOVES 1 TO 1.5 µm", dusk[-1], "#fbeed2")
    save(c, folder / "mountain.png")


def crater(c, x, y, radius, squash, dark, light):
    for colour, scale, shift in ((light, 1.0, 0.0), (dark, 0.86, -0.07)):
        c.save()
        c.translate(x + shift * radius, y + shift * radius * squash)
        c.scale(1, squash)
        disc(c, 0, 0, radius * scale)
        c.restore()
        ink(c, colour)
        c.fill()


def ring_half(c, x, y, turn, front):
    """Half of a planet's rings; what is left out between them is foil."""
    for radius, width, colour in ((19.6, 0.5, "#f6c79a"), (21.4, 2.2, "#f2a07a"), (24.1, 2.2, "#fdebd0"),
                                  (26.75, 2.1, "#e4716a"), (29.6, 0.7, "#f6c79a"), (31.0, 0.3, "#fdebd0")):
        c.save()
        c.translate(x, y)
        c.rotate(turn)
        c.scale(1, 0.27)
        c.new_sub_path()
        c.arc(0, 0, radius, 0 if front else math.pi, math.pi if front else TAU)
        ink(c, colour)
        c.set_line_width(width)
        c.set_line_cap(cairo.LINE_CAP_BUTT)
        c.stroke()
        c.restore()


def heavens(folder):
    night, violet, cream = "#1d1a45", "#4a3685", "#fdebd0"
    c = sheet()
    x, y, radius, turn = 31.5, 42.0, 15.5, -0.36
    glaze(c, "#35248a", 0.44)
    c.paint()
    for i, orbit in enumerate((50.0, 43.0, 37.0)):
        c.save()
        c.translate(x, y)
        c.rotate(turn)
        c.scale(1, 0.6 - 0.09 * i)
        disc(c, 0, 0, orbit)
        c.restore()
        glaze(c, ("#5a3aa8", "#8a55b8", "#c07ac0")[i], 0.36 - 0.1 * i)
        c.fill_preserve()
        ink(c, night)
        stroke(c, 0.2)
    dipper = [(9.5, 15.2), (16.0, 12.6), (20.3, 15.6), (25.6, 18.2), (27.3, 22.6), (36.4, 21.4), (38.6, 15.4)]
    line(c, [*dipper, dipper[3]])
    stroke(c, 0.24)
    for i, (sx, sy) in enumerate(dipper):
        star(c, sx, sy, 1.5 if i % 3 else 1.9, night, cream)
    ring_half(c, x, y, turn, False)
    c.save()
    disc(c, x, y, radius)
    c.clip()
    c.translate(x, y)
    c.rotate(turn)
    bands = ["#f7d3a8", "#ef9a75", "#fdebd0", "#e4716a", "#f6c79a", "#fdebd0", "#d1556a", "#f2a07a", "#f7d3a8",
             "#b04a72", "#e4716a", "#8a3f7c"]
    xs = np.linspace(-radius, radius, 160)
    edge = -radius
    for i, colour in enumerate(bands):
        ink(c, colour)
        wave = 0.35 * np.sin(xs * (0.5 + 0.13 * (i % 4)) + 1.7 * i) + 0.16 * np.sin(1.9 * xs + i) if i else 0 * xs
        line(c, [*zip(xs, edge + wave), (radius, radius), (-radius, radius)], True)
        c.fill()
        edge += (3.4, 1.7, 2.1, 3.2, 1.2, 2.6, 2.2, 3.0, 1.6, 3.4, 2.7, 3.0)[i]
    for k, colour in enumerate((cream, "#d1556a", "#ef9a75")):  # a storm
        c.save()
        c.translate(-4.5, 3.6)
        c.scale(1, 0.55)
        disc(c, 0, 0, 3.2 - 0.8 * k)
        c.restore()
        ink(c, colour)
        c.fill()
    c.rotate(-turn)
    ink(c, night)  # the shadow: lines that grow toward the dark limb
    for i in range(44):
        yy = -radius + (i + 0.5) * 2 * radius / 44
        half = math.sqrt(radius**2 - yy**2)
        begin = half - 0.85 * half * (1 + 0.5 * yy / radius) + 1.0
        line(c, [(begin, yy), (half + 1, yy - 0.09), (half + 1, yy + 0.62)], True)
        c.fill()
    c.restore()
    ring_half(c, x, y, turn, True)
    for mx, my, size in ((49.3, 15.2, 3.6), (12.2, 62.0, 1.7)):
        ink(c, cream)
        disc(c, mx, my, size)
        c.fill()
        c.save()
        disc(c, mx, my, size)
        c.clip()
        ink(c, "#a88fc0")
        disc(c, mx + 0.45 * size, my + 0.3 * size, size)
        disc(c, mx - 0.05 * size, my - 0.05 * size, size)
        c.set_fill_rule(cairo.FILL_RULE_EVEN_ODD)
        c.fill()
        c.restore()
    xs = np.linspace(0, WIDTH, 200)  # the ground of a moon
    for base, colour, seed in ((66.5, violet, 3), (70.0, "#33266a", 4)):
        ink(c, colour)
        hills = noise((2, 200), (1, 9), seed)[0] * 3 + noise((2, 200), (1, 40), seed)[0] * 0.5
        line(c, [(0, 80), *zip(xs, base - hills + 0.006 * (xs - 31.5) ** 2), (WIDTH, 80)], True)
        c.fill()
    for cx, cy, size in ((14, 72.6, 4.4), (44.5, 73.4, 5.6), (30, 74.6, 2.6),
                         (53.5, 70.6, 2.0), (25, 71.3, 1.6), (35.4, 70.8, 1.0)):
        crater(c, cx, cy, size, 0.3, night, "#7a62b8")
    frame(c, "II", "THE HEAVENS", "COSMOS  ·  CIRCLES OF GROOVES 1 µm APART", night, cream)
    save(c, folder / "heavens.png")


def crystal(folder):
    navy, blue, ice = "#0d2748", "#2f74a8", "#bfe4f4"
    c = sheet()
    x, y = 31.5, 39.0
    for size, opacity in ((90, 0.4), (27, 0.3), (21, 0.2), (15, 0.1)):
        glaze(c, blue, opacity)
        line(c, [polar(x, y, size, k * TAU / 6 + TAU / 4) for k in range(6)], True)
        c.fill()
    ink(c, navy)  # a screen of dots that closes toward the edge, as in print
    pitch = 1.15
    for row in range(-45, 46):
        for column in range(-34, 35):
            dx, dy = (column + 0.5 * (row % 2)) * pitch, row * pitch * math.sqrt(0.75)
            edge = max(abs(dx) / 29.5, (abs(dx) * 0.5 + abs(dy) * math.sqrt(0.75)) / 33.5)
            size = 0.8 * (edge - 0.72) / 0.3
            if size > 0.08:
                disc(c, x + dx, y + dy, min(size, 0.8))
                c.fill()
    segments = []

    def branch(bx, by, angle, length, width, level):
        ex, ey = polar(bx, by, length, angle)
        segments.append((bx, by, ex, ey, width))
        count = (5, 3, 0)[level]
        for i in range(1, count + 1):
            t = (i + 0.4) / (count + 1)
            reach = length * (0.02 + 0.62 * math.sin(math.pi * t**0.75) * (1 - 0.5 * t)) * (1.0, 0.72)[i % 2]
            if reach > 0.8:
                for side in (-1, 1):
                    branch(*polar(bx, by, length * t, angle), angle + side * TAU / 6, reach, 0.62 * width, level + 1)

    for arm in range(6):
        branch(x, y, arm * TAU / 6 + TAU / 4, 26.5, 0.95, 0)
    for colour, wider in ((navy, 0.7), ("#ffffff", 0.0)):
        ink(c, colour)
        for bx, by, ex, ey, width in segments:
            line(c, [(bx, by), (ex, ey)])
            stroke(c, width + wider * min(1, 0.45 + width))
    for size, colour in ((6.2, navy), (5.6, "#ffffff"), (4.7, blue), (4.2, ice), (3.3, "#ffffff"), (2.6, blue),
                         (2.1, None)):
        line(c, [polar(x, y, size, k * TAU / 6 + TAU / 4) for k in range(6)], True)
        ink(c, colour) if colour else foil(c)
        c.fill()
    ink(c, "#ffffff")
    for k in range(6):
        line(c, [(x, y), polar(x, y, 4.2, k * TAU / 6 + TAU / 4)])
        stroke(c, 0.3)
    chance = random.Random(11)
    flakes = []
    for _ in range(70):  # snow
        sx, sy = chance.uniform(6, 57), chance.uniform(5.5, 73)
        if math.hypot(sx - x, (sy - y) * 0.8) < 25 or any(math.hypot(sx - a, sy - b) < 3.2 for a, b in flakes):
            continue
        flakes.append((sx, sy))
        size = chance.choice((0.25, 0.35, 0.5, 1.1, 1.5))
        ink(c, chance.choice((ice, "#ffffff")))
        if size < 1:
            disc(c, sx, sy, size)
            c.fill()
        for k in range(3 if size > 1 else 0):
            line(c, [polar(sx, sy, size, k * TAU / 6), polar(sx, sy, -size, k * TAU / 6)])
            stroke(c, 0.22)
    frame(c, "III", "THE CRYSTAL", "CRACKED ICE  ·  SHARDS OF GROOVES 1 µm APART", navy, "#ffffff")
    save(c, folder / "crystal.png")


CREST = bezier([(-3, 63), (9, 61), (9, 17), (33, 16.5), (46, 16.2), (53, 30), (46, 39.5)], 60)
HOLLOW = bezier([(34, 84), (13, 66), (17, 32), (33, 28.4), (40, 27), (45, 31.5), (46, 39.5)], 60)
SMALL = (34, 36.5), 0.46  # the farther wave: where, and how large
SCALE_MM = 5.25


def swell(x, row):
    return 64.0 + row * SCALE_MM * 0.5 + 1.6 * math.sin(TAU * x / 63 + 0.5 * row + 2.2)


def scales():
    """The sea's scales, the far ones first: seigaiha."""
    for row in range(8):
        for column in range(-1, 8):
            x = (column + 0.5 * (row % 2)) * 2 * SCALE_MM - 0.3
            yield x, swell(x, row) + 2.5


def breaker(c, paints, shift, size):
    """A wave: lines between crest and hollow, which meet at its tip."""
    crest, hollow = (np.array(shift) + size * curve for curve in (CREST, HOLLOW))
    count = len(paints)
    for i, paint in enumerate(paints):
        a, b = (crest + (hollow - crest) * s for s in (i / count, (i + 1) / count))
        paint(c)
        line(c, [*a, *b[::-1]], True)
        c.fill()
    return crest, hollow


def foam(c, crest, hollow, size, seed, edge):
    chance = random.Random(seed)
    pearls = []
    for curve, begin, away in ((crest, 30, -1), (hollow, 100, 1)):
        for i in range(begin, len(curve), 2):
            grow = 0.3 + (i - begin) / (len(curve) - begin) * (1.25 if away < 0 else 0.9)
            grow *= size * chance.uniform(0.8, 1.2)
            dx, dy = (curve[i] - curve[i - 2]) / max(math.hypot(*(curve[i] - curve[i - 2])), 1e-3)
            pearls.append((curve[i][0] - away * dy * 0.3, curve[i][1] + away * dx * 0.3, grow))
            if chance.random() < 0.45:
                reach = away * (grow + chance.uniform(0.8, 3.0) * size)
                pearls.append((curve[i][0] - reach * dy, curve[i][1] + reach * dx, size * chance.uniform(0.18, 0.42)))
    for colour, wider in ((edge, 0.3), ("#ffffff", 0.0)):
        ink(c, colour)
        for x, y, radius in pearls:
            disc(c, x, y, radius + wider)
            c.fill()


def wave(folder):
    indigo, blue, teal, cream, red = "#122a5c", "#2b5fa3", "#7fc0c4", "#f6e9cf", "#d8402f"
    c = sheet(cream)
    for i in range(30):  # evening: lines that gather toward the sea
        y = 62.0 - 44 * (i / 29) ** 1.25
        ink(c, "#eec391" if i > 6 else "#e79a6f")
        line(c, [(3, y), (60, y)])
        stroke(c, 0.34 * (1 - i / 31))
    ink(c, red)
    disc(c, 41, 27.5, 15.5)
    c.fill()
    ink(c, cream)
    for left, right, y in ((47, 70, 21.0), (51, 70, 25.0), (3, 17, 17.0), (3, 12, 21.0)):  # clouds
        line(c, [(left, y), (right, y)])
        stroke(c, 1.5)
    paint = lambda colour: lambda c: ink(c, colour)
    water = lambda c: glaze(c, "#3f9fd0", 0.28)
    crest, hollow = breaker(c, [paint(teal), water, paint(blue), water] * 3, SMALL[0], SMALL[1])
    foam(c, crest, hollow, 0.62, 5, indigo)
    stripes = [paint(indigo), water, paint(blue), water, paint(indigo), water, paint(teal), water]
    crest, hollow = breaker(c, stripes * 2, (0, 0), 1)
    foam(c, crest, hollow, 1.15, 4, indigo)
    for i, (x, y) in enumerate(scales()):
        for radius, paint_with in ((1.0, paint(cream)), (0.95, paint(indigo)), (0.87, water), (0.66, paint(blue)),
                                   (0.6, water), (0.4, paint(indigo)), (0.34, water), (0.16, paint(teal))):
            paint_with(c)
            disc(c, x, y, radius * SCALE_MM)
            c.fill()
    frame(c, "V", "THE WAVE", "DRAWN FOIL  ·  GROOVES ALONG EVERY STROKE", indigo, cream)
    save(c, folder / "wave.png")

    c = sheet("#ffffff")  # the strokes that grooves follow
    for shift, size in (SMALL, ((0, 0), 1.0)):
        black_and_white = [paint("#000000"), paint("#ffffff")] * 16
        breaker(c, black_and_white, shift, size)
    for x, y in scales():
        for i in range(12):
            ink(c, "#ffffff" if i % 2 else "#000000")
            disc(c, x, y, SCALE_MM * (1 - i / 12))
            c.fill()
    save(c, folder / "wave_strokes.png")
