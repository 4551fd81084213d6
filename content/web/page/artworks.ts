/** The page's own artworks, drawn for a card of 63 x 88 mm. Where they are transparent, the foil shows. */

type Drawing = OffscreenCanvasRenderingContext2D;

const [WIDTH, HEIGHT] = [1008, 1408];
const MIDDLE = WIDTH / 2;
const TURN = 2 * Math.PI;

/** Numbers in [0, 1) that are the same on each call (mulberry32). */
function randoms(seed: number): () => number {
    return () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let x = Math.imul(seed ^ (seed >>> 15), seed | 1);
        x ^= x + Math.imul(x ^ (x >>> 7), x | 61);
        return ((x ^ (x >>> 14)) >>> 0) / 2 ** 32;
    };
}

function gradient(c: Drawing, ...colours: string[]): CanvasGradient {
    const fill = c.createLinearGradient(0, 0, 0, HEIGHT);
    colours.forEach((colour, i) => fill.addColorStop(i / (colours.length - 1), colour));
    return fill;
}

/** Draws with the ink taken away: foil. */
function carve(c: Drawing, draw: () => void): void {
    c.save();
    c.globalCompositeOperation = "destination-out";
    c.fillStyle = c.strokeStyle = "#000";
    draw();
    c.restore();
}

function disc(c: Drawing, x: number, y: number, radius: number): void {
    c.beginPath();
    c.arc(x, y, radius, 0, TURN);
    c.fill();
}

function ring(c: Drawing, x: number, y: number, radius: number, width: number): void {
    c.lineWidth = width;
    c.beginPath();
    c.arc(x, y, radius, 0, TURN);
    c.stroke();
}

/** A star of four or more long points. */
function star(c: Drawing, x: number, y: number, radius: number, points = 4, waist = 0.16): void {
    c.beginPath();
    for (let i = 0; i < 2 * points; ++i) {
        const length = i % 2 === 0 ? radius : waist * radius;
        c.lineTo(x + length * Math.sin((i * Math.PI) / points), y - length * Math.cos((i * Math.PI) / points));
    }
    c.fill();
}

/** Rays that narrow toward their ends, every other one shorter. */
function rays(c: Drawing, x: number, y: number, from: number, to: number, count: number, width: number): void {
    for (let i = 0; i < count; ++i) {
        const angle = (i * TURN) / count;
        const end = i % 2 === 0 ? to : from + 0.6 * (to - from);
        const at = (radius: number, across: number): [number, number] =>
            [x + radius * Math.sin(angle) + across * Math.cos(angle), y - radius * Math.cos(angle) + across * Math.sin(angle)];
        c.beginPath();
        c.moveTo(...at(from, -width));
        c.lineTo(...at(end, 0));
        c.lineTo(...at(from, width));
        c.fill();
    }
}

/** A disc with another cut out of it. */
function crescent(c: Drawing, x: number, y: number, radius: number): void {
    c.beginPath();
    c.arc(x, y, radius, 0.14 * TURN, 0.86 * TURN);
    c.arc(x + 0.36 * radius, y, 0.82 * radius, 0.81 * TURN, 0.19 * TURN, true);
    c.fill();
}

function frame(c: Drawing, inset: number, radius: number, width: number): void {
    c.lineWidth = width;
    c.beginPath();
    c.roundRect(inset, inset, WIDTH - 2 * inset, HEIGHT - 2 * inset, radius);
    c.stroke();
}

/** Land below a line of two sines. */
function ridge(c: Drawing, level: number, height: number, length: number, phase: number): void {
    c.beginPath();
    c.moveTo(0, HEIGHT);
    for (let x = 0; x <= WIDTH; x += 6)
        c.lineTo(x, level - height * (Math.sin(x / length + phase) + 0.45 * Math.sin((2.3 * x) / length + 2 * phase)));
    c.lineTo(WIDTH, HEIGHT);
    c.closePath();
}

function moon(c: Drawing): void {
    const random = randoms(5);
    const y = 520;
    c.fillStyle = gradient(c, "#0d1030", "#241a52", "#4a2560");
    c.fillRect(0, 0, WIDTH, HEIGHT);
    carve(c, () => {
        rays(c, MIDDLE, y, 300, 640, 48, 7);
        ring(c, MIDDLE, y, 274, 5);
        ring(c, MIDDLE, y, 250, 16);
        for (let i = 0; i < 70; ++i) {
            const [x, at] = [90 + 828 * random(), 90 + 780 * random()];
            if (Math.hypot(x - MIDDLE, at - y) > 330) star(c, x, at, 6 + 20 * random() ** 3);
        }
        for (let i = -2; i <= 2; ++i) star(c, MIDDLE + 150 * i, 150 + 16 * i * i, i === 0 ? 46 : 30, 4, 0.13);
    });
    c.fillStyle = "#171240";
    disc(c, MIDDLE, y, 232);
    carve(c, () => {
        crescent(c, MIDDLE - 16, y, 196);
        star(c, MIDDLE + 92, y - 26, 58, 4, 0.14);
        star(c, MIDDLE + 40, y + 78, 24);
        star(c, MIDDLE + 140, y + 62, 17);
    });
    ["#3a2059", "#2a1a4c", "#1c133c", "#110d2b"].forEach((colour, i) => {
        c.fillStyle = colour;
        ridge(c, 985 + 98 * i, 50 - 6 * i, 150 - 14 * i, 1.3 * i + 0.6);
        c.fill();
        carve(c, () => {
            c.lineWidth = 5 - 0.6 * i;
            c.stroke();
        });
    });
    c.strokeStyle = "#0d1030";
    frame(c, 20, 34, 62);
    carve(c, () => {
        frame(c, 34, 40, 7);
        frame(c, 52, 26, 2.5);
    });
}

function waves(c: Drawing): void {
    c.fillStyle = gradient(c, "#f2d9b8", "#eeb58f", "#d96f5d");
    c.fillRect(0, 0, WIDTH, HEIGHT);
    carve(c, () => {
        disc(c, MIDDLE, 470, 250);
        for (let i = 0; i < 5; ++i) ring(c, MIDDLE, 470, 282 + 30 * i, 9 - 1.6 * i);
    });
    const radius = WIDTH / 9;
    const mix = (part: number) => `hsl(${200 + 18 * part} ${52 + 14 * part}% ${44 - 26 * part}%)`;
    for (let row = 0, y = 620; y < HEIGHT + radius; ++row, y += 0.5 * radius)
        for (let i = -1; i < 6; ++i) {
            const x = (2 * i + (row % 2)) * radius;
            c.fillStyle = mix(Math.min((y - 620) / 760, 1));
            disc(c, x, y, radius);
            carve(c, () => {
                ring(c, x, y, 0.95 * radius, 4);
                ring(c, x, y, 0.74 * radius, 0.12 * radius);
                ring(c, x, y, 0.46 * radius, 0.09 * radius);
                disc(c, x, y, 0.22 * radius);
            });
        }
}

/** A leaf from (0, 0) along -y, with its veins carved. */
function leaf(c: Drawing, length: number, colour: string | null): void {
    const width = 0.3 * length;
    const outline = () => {
        c.beginPath();
        c.moveTo(0, 0);
        c.bezierCurveTo(width, -0.25 * length, 0.9 * width, -0.7 * length, 0, -length);
        c.bezierCurveTo(-0.9 * width, -0.7 * length, -width, -0.25 * length, 0, 0);
    };
    c.globalCompositeOperation = colour === null ? "destination-out" : "source-over";
    c.fillStyle = colour ?? "#000";
    outline();
    c.fill();
    if (colour === null) return;
    carve(c, () => {
        c.lineWidth = 0.016 * length + 1;
        c.beginPath();
        c.moveTo(0, 0);
        c.lineTo(0, -0.92 * length);
        for (let at = 0.2; at < 0.85; at += 0.13)
            for (const side of [-1, 1]) {
                c.moveTo(0, -at * length);
                c.quadraticCurveTo(side * 0.4 * width, -(at + 0.05) * length, side * 0.72 * width * (1 - Math.abs(at - 0.4)), -(at + 0.15) * length);
            }
        c.stroke();
    });
}

/** A stem that bends, with leaves on both sides. */
function sprig(c: Drawing, x: number, y: number, angle: number, length: number, bend: number, colours: (string | null)[]): void {
    const pairs = 7;
    const step = length / pairs;
    let leaves = 0;
    for (let i = 0, turn = angle; i <= pairs; ++i, turn += bend / pairs) {
        c.save();
        c.translate(x, y);
        c.rotate(turn);
        carve(c, () => c.fillRect(-2.5, -step, 5, step + 2));
        for (const side of i === pairs ? [0] : [-1, 1]) {
            c.save();
            c.rotate(side * (0.95 - 0.05 * i));
            leaf(c, length * (0.34 - 0.026 * i), colours[leaves++ % colours.length]);
            c.restore();
        }
        c.restore();
        x += step * Math.sin(turn);
        y -= step * Math.cos(turn);
    }
}

function garden(c: Drawing): void {
    c.fillStyle = gradient(c, "#0e2f2b", "#0a211f");
    c.fillRect(0, 0, WIDTH, HEIGHT);
    const greens = ["#2f7d5b", "#69a06b", null, "#1f5d4e", "#b9c98a"];
    const blush = ["#d98c7a", "#e8b79c", null, "#b8605c"];
    for (const side of [-1, 1]) {
        sprig(c, MIDDLE + 300 * side, HEIGHT + 20, 0.1 * side, 900, -0.75 * side, greens);
        sprig(c, MIDDLE + 470 * side, 900, 0.15 * side, 640, -0.9 * side, blush);
        sprig(c, MIDDLE + 150 * side, HEIGHT + 30, 0.45 * side, 560, 0.3 * side, blush);
        sprig(c, MIDDLE + 60 * side, HEIGHT - 40, 0.16 * side, 420, -0.2 * side, greens);
    }
    carve(c, () => {
        rays(c, MIDDLE, 300, 120, 220, 32, 6);
        ring(c, MIDDLE, 300, 104, 5);
        disc(c, MIDDLE, 300, 84);
    });
    c.fillStyle = "#e8b79c";
    star(c, MIDDLE, 300, 64, 8, 0.45);
    carve(c, () => frame(c, 30, 36, 6));
}

/** Without transparent parts: the foil is a film over it. */
function dunes(c: Drawing): void {
    c.fillStyle = gradient(c, "#223a6b", "#7d5f9b", "#f08a72", "#ffd08a");
    c.fillRect(0, 0, WIDTH, HEIGHT);
    c.fillStyle = "#fff1cf";
    disc(c, 640, 560, 150);
    ["#f2a07b", "#d9706e", "#a9527a", "#6d3b78", "#3c2963"].forEach((colour, i) => {
        c.fillStyle = colour;
        ridge(c, 760 + 135 * i, 60, 210 + 30 * i, 2.1 * i + 0.4);
        c.fill();
    });
}

function sunSeen(c: Drawing): void {
    c.fillStyle = "#000";
    c.fillRect(0, 0, WIDTH, HEIGHT);
    c.fillStyle = c.strokeStyle = "#fff";
    disc(c, MIDDLE, HEIGHT / 2, 210);
    ring(c, MIDDLE, HEIGHT / 2, 250, 14);
    rays(c, MIDDLE, HEIGHT / 2, 290, 460, 24, 30);
}

function moonSeen(c: Drawing): void {
    c.fillStyle = "#000";
    c.fillRect(0, 0, WIDTH, HEIGHT);
    c.fillStyle = "#fff";
    crescent(c, MIDDLE - 40, HEIGHT / 2, 330);
    for (const [x, y, size] of [[120, -70, 90], [60, 110, 44], [200, 90, 30]]) star(c, MIDDLE + x, HEIGHT / 2 + y, size, 4, 0.14);
    const random = randoms(3);
    for (let i = 0; i < 26; ++i) {
        const [x, y] = [80 + 850 * random(), 80 + 1250 * random()];
        if (Math.hypot(x - MIDDLE, y - HEIGHT / 2) > 400) star(c, x, y, 20 + 24 * random());
    }
}

const DRAWINGS: Record<string, (c: Drawing) => void> = { Moon: moon, Waves: waves, Garden: garden, Dunes: dunes, "Sun, bright": sunSeen, "Moon, bright": moonSeen };
export const ARTWORK_NAMES = ["Moon", "Waves", "Garden", "Dunes"];
/** Pictures for two_pictures. */
export const PAIR = ["Sun, bright", "Moon, bright"] as const;

export const isBuiltIn = (name: string) => name in DRAWINGS;

export function builtInArtwork(name: string): OffscreenCanvas {
    const canvas = new OffscreenCanvas(WIDTH, HEIGHT);
    DRAWINGS[name](canvas.getContext("2d", { willReadFrequently: true })!);
    return canvas;
}
