"""The cards Day & Night and The Scarab."""
import math

import cairo
import numpy as np

from sheet import HEIGHT, TAU, TITLES, WIDTH, disc, foil, frame, ink, line, polar, rosette, save, sheet, stroke, text

SUN = 34.4, 35.0  # in the hollow of the moon, since a texel of a kinegram seen from afar is of one picture only


def sun(c, on, off):
    x, y = SUN
    on(c)
    for k in range(16):
        a = k * TAU / 16 - TAU / 4
        reach = (7.6, 6.6)[k % 2]
        sides = [[polar(x, y, 8.0 + reach * t, a + side * 0.155 * (1 - t) + 0.1 * (k % 2) * math.sin(t * 7.0))
                  for t in np.linspace(0, 1, 30)] for side in (-1, 1)]
        line(c, sides[0] + sides[1][::-1], True)
        c.fill()
    disc(c, x, y, 7.5)
    c.fill()
    off(c)
    c.save()
    c.translate(x, y)
    c.scale(0.86, 0.86)
    disc(c, 0, 0, 7.8)
    stroke(c, 0.35)
    for side in (-1, 1):  # a face: brows that run into the nose, eyes, cheeks, lips
        c.move_to(side * 5.3, -2.6)
        c.curve_to(side * 4.2, -4.6, side * 1.2, -4.2, side * 0.95, -1.6)
        c.line_to(side * 0.95, 0.7)
        c.curve_to(side * 1.5, 1.6, side * 0.6, 1.9, 0, 1.5)
        stroke(c, 0.42)
        c.move_to(side * 1.7, -1.6)
        c.curve_to(side * 2.6, -2.8, side * 4.0, -2.7, side * 4.7, -1.5)
        c.curve_to(side * 3.8, -0.8, side * 2.5, -0.8, side * 1.7, -1.6)
        stroke(c, 0.36)
        disc(c, side * 3.15, -1.75, 0.62)
        c.fill()
        disc(c, side * 4.7, 1.9, 1.3)
        stroke(c, 0.3)
        c.move_to(0, 3.5)
        c.curve_to(side * 0.5, 3.0, side * 1.2, 3.1, side * 2.6, 3.7)
        c.curve_to(side * 1.4, 5.0, side * 0.5, 5.0, 0, 5.0)
        stroke(c, 0.36)
    c.move_to(-2.6, 3.7)
    c.curve_to(-1, 4.1, 1, 4.1, 2.6, 3.7)
    stroke(c, 0.36)
    c.restore()


def moon(c, on, off):
    x, y = 31.5, 36.5
    on(c)
    c.save()
    disc(c, x, y, 20.3)
    c.clip()
    c.rectangle(0, 0, WIDTH, HEIGHT)
    disc(c, *SUN, 17.0)
    c.set_fill_rule(cairo.FILL_RULE_EVEN_ODD)
    c.fill()
    c.restore()
    off(c)
    for i in range(8):  # engraved along the crescent
        t = (i + 1) / 9
        c.new_sub_path()
        c.arc(x + (SUN[0] - x) * t, y + (SUN[1] - y) * t, 20.3 - 3.3 * t,
              TAU * (0.23 + 0.025 * i), TAU * (0.62 - 0.02 * i))
        stroke(c, 0.2 + 0.02 * i)
    on(c)
    for k in range(16):  # stars between the sun's rays
        a = (k + 0.5) * TAU / 16 - TAU / 4
        size = (1.25, 0.5)[k % 2]
        sx, sy = polar(*SUN, 14.2, a + 0.02)
        line(c, [polar(sx, sy, size if j % 2 == 0 else 0.3 * size, j * TAU / 8) for j in range(8)], True)
        c.fill()


def pictures(folder):
    for draw, name in ((sun, "day.png"), (moon, "night.png")):
        c = sheet("#000000")
        draw(c, lambda c: ink(c, "#ffffff"), lambda c: ink(c, "#000000"))
        save(c, folder / name)


def day_and_night(folder):
    cream, teal, wine, ochre = "#f6ecd6", "#17605f", "#5a1830", "#c08a2e"
    c = sheet(cream)
    x, y = 31.5, 36.5
    xs = np.linspace(0, WIDTH, 260)
    ink(c, "#d9a94f")
    for i in range(-8, 92):  # a ground of waves that lean on the medallion
        base = 1.0 * i
        bump = 2.6 * np.exp(-((xs - x) / 17) ** 2) * np.sin(TAU * (base - y) / 40)
        line(c, zip(xs, base + bump + 0.9 * np.sin(xs * TAU / 15.75 + 0.24 * i)))
        stroke(c, 0.13)
    for radius, colour in ((27.4, cream), (27.0, wine)):
        ink(c, colour)
        disc(c, x, y, radius)
        c.fill() if colour == cream else stroke(c, 0.3)
    ink(c, teal)
    rosette(c, x, y, 24.4, 1.7, 24, 12, 12, 0.13)
    ink(c, wine)
    rosette(c, x, y, 24.4, 1.1, 48, 12, 4, 0.13)
    for radius, width in ((22.0, 0.55), (26.5, 0.2)):
        disc(c, x, y, radius)
        stroke(c, width)
    for cx, cy, part in ((10.6, 11.0, 1), (52.4, 11.0, 0), (10.6, 67.2, 2), (52.4, 67.2, 3)):  # phases
        ink(c, cream)
        disc(c, cx, cy, 5.2)
        c.fill()
        ink(c, wine)
        rosette(c, cx, cy, 4.3, 0.6, 16, 8, 6, 0.1)
        disc(c, cx, cy, 3.1)
        c.fill()
        ink(c, "#e7bd5c")
        if part < 2:
            for k in range(12):
                a = k * TAU / 12
                line(c, [polar(cx, cy, 1.35, a - 0.2), polar(cx, cy, 2.7, a), polar(cx, cy, 1.35, a + 0.2)], True)
            disc(c, cx, cy, 1.25)
            c.fill()
        else:
            disc(c, cx, cy, 2.2)
            c.fill()
            ink(c, wine)
            disc(c, cx + (1.1 if part == 2 else -1.1), cy - 0.3, 1.85)
            c.fill()
    ink(c, cream)
    c.rectangle(18.4, 65.4, 26.2, 4.4)
    c.fill()
    ink(c, wine)
    text(c, "SOL  ET  LUNA", x, 68.5, 2.3, TITLES, 0.55)
    night = lambda c: ink(c, "#14233f")
    night(c)
    disc(c, x, y, 21.7)
    c.fill()
    moon(c, foil, night)
    sun(c, foil, night)
    frame(c, "IV", "DAY & NIGHT", "KINEGRAM  ·  TILT: TWO PICTURES IN ONE FOIL", wine, cream,
          lambda c: ink(c, "#e7bd5c"))
    save(c, folder / "day_and_night.png")


def feather(c, x, y, inner, outer, angle, half_angle, colours):
    """A sector with a round tip, and stripes of colour along it."""
    for k, colour in enumerate(colours):
        inset = 0.0 if k == 0 else 0.28 * k
        start = inner + 0.45 * (outer - inner) * k / len(colours)
        tip = (outer - inset) * math.sin(half_angle)
        spread = half_angle * (1 - 0.3 * k)
        c.new_sub_path()
        c.line_to(*polar(x, y, start, angle - spread))
        c.line_to(*polar(x, y, outer - tip - inset, angle - spread))
        c.arc(*polar(x, y, outer - tip - inset, angle), (outer - tip) * math.sin(spread),
              angle - TAU / 4, angle + TAU / 4)
        c.line_to(*polar(x, y, start, angle + spread))
        c.close_path()
        ink(c, colour)
        c.fill()


def scarab(folder):
    ground, lapis, turquoise, carnelian, cream = "#0c1638", "#21489c", "#24a79f", "#cf4a2c", "#f7e8c4"
    c = sheet(ground)
    x, y = 31.5, 22.5
    foil(c)
    for k in range(48):  # the sun's rays
        a, half = k * TAU / 48, (0.030, 0.014)[k % 2]
        line(c, [polar(x, y, 9.5, a - 0.3 * half), polar(x, y, 80, a - half), polar(x, y, 80, a + half),
                 polar(x, y, 9.5, a + 0.3 * half)], True)
        c.fill()
    for radius, paint_colour in ((8.7, ground), (8.0, None), (6.9, carnelian), (5.1, None), (4.8, carnelian)):
        ink(c, paint_colour) if paint_colour else foil(c)
        disc(c, x, y, radius)
        c.fill()
    c.translate(x, 0)
    px, py = 3.2, 46.5
    for side in (1, -1):
        c.save()
        c.scale(side, 1)
        tiers = ((19.0, 25.0, 15, (lapis, turquoise)), (12.5, 19.0, 12, (turquoise, cream)),
                 (6.0, 12.5, 8, (carnelian, cream)))
        for inner, outer, count, colours in tiers:
            step = 1.62 / count
            for i in range(count):
                angle = 0.22 - step * (i + 0.5)
                reach = outer + (2.2 * math.sin((i + 0.5) / count * math.pi) - 1.6 if outer == 25 else 0)
                for paint_with, wider in ((lambda c: ink(c, ground), 0.8), (foil, 0.1)):
                    tip = (reach + 0.3) * math.sin(step * 0.5)
                    half = step * 0.5 + (wider - 0.1) / outer
                    line(c, [polar(px, py, 5.0, angle - half), polar(px, py, reach - tip, angle - half)])
                    c.arc(*polar(px, py, reach - tip, angle), tip + wider, angle - TAU / 4, angle + TAU / 4)
                    c.line_to(*polar(px, py, 5.0, angle + half))
                    paint_with(c)
                    c.fill()
                feather(c, px, py, inner - 6.0 if inner > 6 else 5.2, reach - 0.05, angle,
                        step * 0.5 - 0.24 / reach, colours)
        for colour, width in ((ground, 2.3), (None, 1.7), (lapis, 1.0)):  # legs
            ink(c, colour) if colour else foil(c)
            for leg in (((2.6, 39), (6.0, 36.5), (7.6, 31), (5.2, 27.2)),
                        ((3.2, 54), (7.4, 56), (7.0, 61), (3.4, 63.5))):
                c.move_to(*leg[0])
                c.curve_to(*leg[1], *leg[2], *leg[3])
                stroke(c, width)
        c.restore()
    for grown, body, shell in ((0.95, ground, ground), (0.5, None, None), (0.0, lapis, turquoise)):
        ink(c, body) if body else foil(c)
        for cx, cy, rx, ry, colour in ((0, 51.0, 6.4, 8.6, body), (0, 41.6, 5.4, 4.2, shell),
                                       (0, 36.6, 3.3, 2.4, body)):
            c.save()
            c.translate(cx, cy)
            c.scale(rx + grown, ry + grown)
            disc(c, 0, 0, 1)
            c.restore()
            ink(c, colour) if colour else foil(c)
            c.fill()
    foil(c)
    line(c, [(0, 45.0), (0, 59.4)])
    for side in (-1, 1):
        for k in range(1, 5):
            c.move_to(side * 0.15, 45.2)
            c.curve_to(side * (1.0 + 1.3 * k), 46.2, side * (0.6 + 1.5 * k), 55, side * 0.3 * k, 59.2 - 0.25 * k)
        c.move_to(side * 5.6, 44.6)
        c.curve_to(side * 3, 46.4, side, 45.4, 0, 45.2)
        for k in range(3):
            line(c, [(side * (0.7 + 0.8 * k), 35.2 + 0.3 * k), (side * (0.9 + 0.9 * k), 33.4 + 0.5 * k)])
    stroke(c, 0.26)
    # The ring that it holds.
    for radius, colour in ((3.9, ground), (3.5, None), (2.9, carnelian), (1.9, None), (1.5, ground)):
        ink(c, colour) if colour else foil(c)
        disc(c, 0, 65.4, radius)
        c.fill()
    c.translate(-x, 0)
    for i in range(-1, 10):  # lotus
        fx, fy, tall = 31.5 + (i - 4) * 7.0, 75.9, i % 2 == 0
        for k, angle in enumerate(np.linspace(-0.95, 0.95, 5)):
            petal = (turquoise, cream, carnelian, cream, turquoise)[k]
            for colour, size in ((ground, 1.0), (None, 0.93), (petal, 0.78)):
                ink(c, colour) if colour else foil(c)
                c.save()
                c.translate(fx, fy)
                c.rotate(angle)
                c.scale(size, size)
                c.move_to(0, 0)
                length = (6.6 if tall else 4.6) * (1 - 0.25 * abs(angle))
                c.curve_to(1.6, -0.45 * length, 1.1, -0.8 * length, 0, -length)
                c.curve_to(-1.1, -0.8 * length, -1.6, -0.45 * length, 0, 0)
                c.restore()
                c.fill()
    frame(c, "VI", "THE SCARAB", "RADIANT FOIL  ·  UNDER A GOLDEN LACQUER", ground, cream)
    save(c, folder / "scarab.png")
