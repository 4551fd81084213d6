// Foil that sparkles, and a slow equivalent of modules/diffraction/shaders/sparkle.glsl: what a pixel shows of facets whose radiances are known.

/** Facets have directions in the middle of the shader's sixteen ranges, or nearly. */
export const DIRECTIONS = 16;
const WITHIN = 0.3;
const PARTS = 16;
/** Odd sizes of levels as well. */
const [WIDTH, HEIGHT] = [500, 380];
const FACET = 2;
const PITCH = 32768; // green of the material's pitch

const FOIL = { pitch_nm: 1100, profile: { type: "sinusoidal", depth_nm: 180 }, orders: [-1, 1], groove_lobe: { sigma: 0.4 } };
const BLAZED = { pitch_nm: 1300, profile: { type: "blazed", depth_nm: 250 }, orders: [1, 2], groove_lobe: { sigma: 0.3 } };
/** `facets`: of a pixel; `pixels`: along the picture's sides. */
const DISTANCES = [{ facets: 0.3, pixels: 96 }, { facets: 9, pixels: 64 }, { facets: 100, pixels: 24 }];
export const redOf = (direction) => Math.round((65535 * (direction + WITHIN)) / DIRECTIONS);

export const CASES = [
    { name: "under a lamp", grating: FOIL, representation: "direct", lamp: { direction: [0.45, 0.3, 0.84], flux: 3 } },
    { name: "with gaps, blazed", grating: BLAZED, representation: "direct", lamp: { direction: [0.5, -0.2, 0.84], flux: 3 }, gaps: true },
    { name: "by a map of the light", grating: { ...FOIL, groove_lobe: undefined }, representation: "planar" },
].map((one) => ({ ...one, distances: DISTANCES.map((distance) => ({ ...distance, change: changeOf(distance, one.gaps) })) }));

/** Two facets that do not sparkle, from near: eight pixels for each of four texels. */
const EDGE_DIRECTIONS = [2, 2, 11, 11];
export const EDGE_CASE = {
    ...CASES[2], texture: { width: 4, height: 1, texels: EDGE_DIRECTIONS.flatMap((direction) => [redOf(direction), PITCH]) }, distance: { change: [1 / 32, 1 / 32], pixels: 32 },
};
/** What each pixel of its picture shows, of foil of one direction each. */
export const edgePicture = (shown) => Array.from({ length: 32 * 32 }, (_, i) => shown[EDGE_DIRECTIONS[Math.floor((i % 32) / 8)]]);

/** Numbers in [0, 1) that are the same in every run (a linear congruential generator, Numerical Recipes). */
function numbers(seed) {
    let state = seed;
    return () => (state = (1664525 * state + 1013904223) % 4294967296) / 4294967296;
}

/** The direction of each texel's facet; -1: no grating. */
function directionsOf(gaps = false) {
    const next = numbers(3);
    const columns = Math.ceil(WIDTH / FACET);
    const facets = Array.from({ length: columns * Math.ceil(HEIGHT / FACET) }, () =>
        (gaps && next() < 0.2 ? -1 : Math.floor(DIRECTIONS * next())));
    return Array.from({ length: WIDTH * HEIGHT }, (_, i) => facets[Math.floor(Math.floor(i / WIDTH) / FACET) * columns + Math.floor((i % WIDTH) / FACET)]);
}

/** Red and green, 16 bits, of each texel. */
export function textureOf({ gaps }) {
    const texels = directionsOf(gaps).flatMap((direction) => (direction < 0 ? [0, 0] : [redOf(direction), PITCH]));
    return { width: WIDTH, height: HEIGHT, texels };
}

/** Mean area of facets of one direction each, in texels. */
export function facetTexels(gaps) {
    const of = directionsOf(gaps);
    const along = (step, from) => {
        let [pairs, different] = [0, 0];
        for (let row = from[1]; row < HEIGHT; ++row)
            for (let column = from[0]; column < WIDTH; ++column) {
                const [here, before] = [of[row * WIDTH + column], of[row * WIDTH + column - step]];
                if (here < 0 || before < 0) continue;
                ++pairs;
                if (here !== before) ++different;
            }
        return pairs / different;
    };
    return along(1, [1, 0]) * along(WIDTH, [0, 1]);
}

/** Of the texture's coordinates, from one pixel to the next. */
function changeOf({ facets }, gaps) {
    const texels = Math.sqrt(facets * facetTexels(gaps));
    return [texels / WIDTH, texels / HEIGHT];
}

/** Where the picture's corner is in the texture. */
export const CORNER = [0.0103, 0.0207];

/** Levels of { direction, coverage } of each texel: of four texels one, drawn by the generator of C++'s minstd_rand. */
export function levelsOf(gaps) {
    const levels = [{ width: WIDTH, height: HEIGHT, texels: directionsOf(gaps).map((direction) => ({ direction, coverage: direction < 0 ? 0 : 1 })) }];
    for (let above = levels[0]; above.width * above.height > 1; above = levels.at(-1)) {
        let state = 1;
        const random = () => (state = (48271 * state) % 2147483647);
        const [width, height] = [Math.max(1, above.width >> 1), Math.max(1, above.height >> 1)];
        const texels = Array.from({ length: width * height }, (_, i) => {
            const [column, row] = [i % width, Math.floor(i / width)];
            const four = [0, 1, 2, 3].map((k) =>
                above.texels[Math.min(2 * row + (k >> 1), above.height - 1) * above.width + Math.min(2 * column + (k & 1), above.width - 1)]);
            const covered = four.filter(({ coverage }) => coverage > 0);
            if (covered.length === 0) return { direction: -1, coverage: 0 };
            const { direction } = covered[Math.floor(random() / 8) % covered.length];
            return { direction, coverage: four.reduce((sum, one) => sum + one.coverage / 4, 0) };
        });
        levels.push({ width, height, texels });
    }
    return levels;
}

/** Texels from a texel's edge, within which the GPU may look up the texel beside it. */
const EDGE = 2e-3;

/** The facets that a pixel's parts look up, or null near a texel's edge. */
function facetsOf(levels, corner, change, noise, parts) {
    const [{ width, height }] = levels;
    const widest = Math.max(change[0] * width, change[1] * height);
    const found = [];
    for (let part = 0; part < parts; ++part) {
        const fraction = (part + 0.5) / PARTS;
        const at = noise < 1 ? [((part & 3) + 0.5) / 4, ((part >> 2) + 0.5) / 4] : [fraction, (0.61803399 * part) % 1];
        const { width, height, texels } = levels[Math.min(Math.floor(Math.max(Math.log2(Math.max(widest / 8, 0.5)) + fraction, 0)), levels.length - 1)];
        const [x, y] = [width * (corner[0] + change[0] * at[0]), height * (corner[1] + change[1] * at[1])];
        if ([x, y].some((texel) => Math.abs(texel - Math.round(texel)) < EDGE)) return null;
        found.push(texels[(Math.floor(y) % height) * width + (Math.floor(x) % width)]);
    }
    return found;
}

/**
 * The picture's pixels, RGB each, from the left below, or null near a texel's edge; `shown`: the radiance of foil of one direction,
 * for each.
 */
export function pictureOf({ gaps }, { change, pixels }, shown, levels = levelsOf(gaps)) {
    const [{ width, height }] = levels;
    const facets = (change[0] * width * change[1] * height) / facetTexels(gaps);
    const side = Math.sqrt(Math.max(facets, 1));
    const noise = facets < 4 ? 1 : Math.min(Math.sqrt(PARTS) * (1 / side - 1 / (3 * side * side)), 0.95);
    const parts = facets < 0.02 ? 1 : PARTS;
    return Array.from({ length: pixels * pixels }, (_, i) => {
        const corner = [CORNER[0] + change[0] * (i % pixels), CORNER[1] + change[1] * Math.floor(i / pixels)];
        const found = facetsOf(levels, corner, change, noise, parts);
        if (!found) return null;
        const covered = found.filter(({ coverage }) => coverage > 0);
        const sum = [0, 0, 0];
        found.forEach(({ direction, coverage }, part) => {
            if (coverage === 0) return;
            const many = covered.filter((one) => one.direction === part).length; // in the part's range
            const weight = noise < 1 ? 1 + noise * ((Math.min(many, 15) * PARTS) / covered.length - 1) : 1;
            shown[noise < 1 ? part : direction].forEach((x, c) => (sum[c] += (weight * coverage * x) / parts));
        });
        return sum;
    });
}

/** What foil of as many facets as one likes shows, which is smooth. */
export function smoothOf({ gaps }, shown) {
    const of = directionsOf(gaps);
    const count = shown.map((_, direction) => of.filter((one) => one === direction).length);
    return [0, 1, 2].map((c) => shown.reduce((sum, rgb, direction) => sum + (rgb[c] * count[direction]) / of.length, 0));
}
