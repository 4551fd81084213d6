#!/usr/bin/env python3
"""draw_artwork.py [FOLDER]: draws again the pictures of the six foil cards, beside this script or in FOLDER. Needs
Debian's python3-cairo, python3-numpy and fonts-urw-base35; the same versions of these give the same bytes."""
import pathlib, sys

from emblems import day_and_night, pictures, scarab
from landscapes import crystal, heavens, mountain, wave
from sheet import HEIGHT, WIDTH, ink, rosette, save, sheet, star, stroke


def back(folder):
    gold, pale = "#c9a86a", "#8d9fd6"
    c = sheet("#141a3d")
    x, y = WIDTH / 2, HEIGHT / 2
    for colour, radius, depth, petals, turns, lines in ((gold, 22.5, 2.6, 36, 12, 6), (pale, 16.2, 3.8, 18, 6, 8),
                                                        ("#ece2c6", 8.4, 4.4, 12, 6, 8), (gold, 2.6, 1.0, 8, 8, 4)):
        ink(c, colour)
        rosette(c, x, y, radius, depth, petals, turns, lines, 0.13)
    for cx, cy in ((10.4, 10.4), (WIDTH - 10.4, 10.4), (10.4, HEIGHT - 10.4), (WIDTH - 10.4, HEIGHT - 10.4)):
        ink(c, pale)
        rosette(c, cx, cy, 4.6, 1.3, 12, 6, 6, 0.13)
        star(c, cx, cy, 2.2, gold, gold)
    ink(c, gold)
    for inset, width in ((2.4, 0.34), (3.1, 0.14)):
        c.rectangle(inset, inset, WIDTH - 2 * inset, HEIGHT - 2 * inset)
        stroke(c, width)
    save(c, folder / "back.png", 24)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    for draw in (mountain, heavens, crystal, day_and_night, pictures, wave, scarab, back):
        draw(folder)


if __name__ == "__main__":
    main()
