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
/** `facets`: of a pixel; `pixels`: along the picture's sides; `turned`: the texture, in radians; `thin`: the root of a pixel's aspect. */
const DISTANCES = [{ facets: 0.3, pixels: 96 }, { facets: 9, pixels: 64 }, { facets: 30, pixels: 40, turned: 0.4 }, { facets: 100, pixels: 24 }, { facets: 12, pixels: 40, thin: 8 }];
export const redOf = (direction) => Math.round((65535 * (direction + WITHIN)) / DIRECTIONS);

export const CASES = [
    { name: "under a lamp", grating: FOIL, representation: "direct", lamp: { direction: [0.45, 0.3, 0.84], flux: 3 } },
    { name: "with gaps, blazed", grating: BLAZED, representation: "direct", lamp: { direction: [0.5, -0.2, 0.84], flux: 3 }, gaps: true },
    { name: "by a map of the light", grating: { ...FOIL, groove_lobe: undefined }, representation: "planar" },
].map((one) => ({ ...one, distances: DISTANCES.map((distance) => ({ ...distance, change: changeOf(distance, one.gaps) })) }));

/** Two facets that do not sparkle, from near: eight pixels for each of four texels. */
const EDGE_DIRECTIONS = [2, 2, 11, 11];
export const EDGE_CASE = {
    ...CASES[2], texture: { width: 4, height: 1, texels: EDGE_DIRECTIONS.flatMap((direction) => [redOf(direction), PITCH]) }, distance: { change: [[1 / 32, 0], [0, 1 / 32]], pixels: 32 },
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

/** Of the texture's coordinates, to the pixels beside and above. */
function changeOf({ facets, turned = 0, thin = 1 }, gaps) {
    const texels = Math.sqrt(facets * facetTexels(gaps));
    const [cos, sin] = [texels * Math.cos(turned), texels * Math.sin(turned)];
    return [[(cos * thin) / WIDTH, (sin * thin) / HEIGHT], [-sin / thin / WIDTH, cos / thin / HEIGHT]];
}

const areaOf = ([across, down]) => Math.abs(across[0] * down[1] - across[1] * down[0]);

/** Where the picture's corner is in the texture; all of it is at positive coordinates. */
export const CORNER = [1.0103, 0.0207];

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

/** Where a pixel's coordinates, which are 0 in its middle and 1 apart to the next, are in the texture. */
const pointOf = (middle, [across, down], [x, y]) => [0, 1].map((k) => middle[k] + across[k] * x + down[k] * y);

/** Texels from a texel's edge, within which the GPU may look up the texel beside it. */
const EDGE = 2e-3;

/** The facets at a pixel's points, or null near a texel's edge. */
function facetsAt({ width, height, texels }, middle, change, parts) {
    const found = [];
    for (let part = 0; part < parts; ++part) {
        const [u, v] = pointOf(middle, change, [(part + 0.5) / PARTS - 0.5, ((0.61803399 * part) % 1) - 0.5]);
        const [x, y] = [width * u, height * v];
        if ([x, y].some((texel) => Math.abs(texel - Math.round(texel)) < EDGE)) return null;
        found.push(texels[(Math.floor(y) % height) * width + (Math.floor(x) % width)]);
    }
    return found;
}

/** Of a weight, within which the GPU may round it otherwise. */
const TIE = 5e-3;

/**
 * The facets of the texels that a pixel covers in a level, with their weights, or null near a tie. `unit`: the weight of a texel
 * that it covers whole. A texel counts as the box around it along the pixel's sides.
 */
function facetsIn({ width, height, texels }, middle, [across, down], unit) {
    const determinant = across[0] * down[1] - across[1] * down[0];
    const inPixel = ([x, y]) => {
        const [u, v] = [x / width - middle[0], y / height - middle[1]];
        return [(u * down[1] - v * down[0]) / determinant, (v * across[0] - u * across[1]) / determinant];
    };
    const corners = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]].map((at) => pointOf(middle, [across, down], at));
    const [columns, rows] = [width, height].map((size, k) => corners.map((corner) => Math.floor(size * corner[k])));
    const found = [];
    for (let row = Math.min(...rows); row <= Math.max(...rows); ++row)
        for (let column = Math.min(...columns); column <= Math.max(...columns); ++column) {
            const texel = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([x, y]) => inPixel([column + x, row + y]));
            const [coveredX, coveredY] = [0, 1].map((k) => {
                const [from, to] = [Math.min(...texel.map((at) => at[k])), Math.max(...texel.map((at) => at[k]))];
                return Math.max(Math.min(to, 0.5) - Math.max(from, -0.5), 0) / (to - from);
            });
            const exact = unit * coveredX * coveredY;
            if (Math.abs(exact - Math.floor(exact) - 0.5) < TIE) return null;
            found.push({ ...texels[(row % height) * width + (column % width)], weight: Math.round(exact) });
        }
    return found;
}

/** What a pixel of few facets shows, the mean over its points. */
function fewShown(level, middle, change, parts, shown) {
    const found = facetsAt(level, middle, change, parts);
    return found && [0, 1, 2].map((c) => found.reduce((sum, { direction, coverage }) => sum + (coverage > 0 ? coverage * shown[direction][c] : 0), 0) / parts);
}

/** What a pixel of many facets shows: directions, each as bright as the facets that have it are many among those that it covers in a level or two. */
function manyShown(levels, middle, change, facets, shown) {
    const [{ width, height }] = levels;
    const across = Math.max(...[width, height].map((size, k) => size * (Math.abs(change[0][k]) + Math.abs(change[1][k]))));
    let level = 0;
    while (level < levels.length - 1 && across > 6 * 2 ** level) ++level;
    const beyond = Math.min(Math.max((across / 2 ** level - 3) / 3, 0), 1);
    const next = level === levels.length - 1 ? 0 : beyond * beyond * (3 - 2 * beyond);
    // Weights of whole texels: 200 for all of a level.
    const whole = (of) => 200 / Math.min(areaOf(change) * of.width * of.height, 64);
    const [fine, coarse] = [(1 - next) * whole(levels[level]), next > 0 ? next * whole(levels[level + 1]) : 0];
    const inFine = facetsIn(levels[level], middle, change, fine);
    const inCoarse = next > 0 ? facetsIn(levels[level + 1], middle, change, coarse) : [];
    if (!inFine || !inCoarse) return null;
    const sum = (of, list) => list.reduce((before, one) => before + of(one), 0);
    const all = [...inFine, ...inCoarse];
    const covered = all.filter(({ coverage }) => coverage > 0);
    const total = sum(({ weight }) => weight, covered);
    const square = ({ weight, coverage }) => (coverage > 0 ? weight ** 2 : 0);
    // A facet of the coarse level is one of the four below, in whose weights it is counted once more.
    const squares = sum(square, inFine) + (next > 0 ? sum(square, inCoarse) * (1 + (2 * fine) / coarse) : 0);
    const coverage = sum((one) => one.weight * one.coverage, covered) / sum(({ weight }) => weight, all);
    const side = Math.sqrt(facets);
    const noise = Math.min((total / Math.sqrt(squares)) * (1 / side - 1 / (3 * side * side)), 1);
    return [0, 1, 2].map((c) => coverage * shown.reduce((mean, rgb, direction) => {
        const fraction = sum(({ weight }) => weight, covered.filter((one) => one.direction === direction)) / total;
        return mean + rgb[c] * ((1 - noise) / PARTS + noise * fraction);
    }, 0));
}

/**
 * The picture's pixels, RGB each, from the left below, or null where the GPU may read other facets or weights; `shown`: the
 * radiance of foil of one direction, for each.
 */
export function pictureOf({ gaps }, { change, pixels }, shown, levels = levelsOf(gaps)) {
    const [{ width, height }] = levels;
    const facets = (areaOf(change) * width * height) / facetTexels(gaps);
    return Array.from({ length: pixels * pixels }, (_, i) => {
        const middle = pointOf(CORNER, change, [(i % pixels) + 0.5, Math.floor(i / pixels) + 0.5]);
        return facets < 4 ? fewShown(levels[0], middle, change, facets < 0.02 ? 1 : PARTS, shown) : manyShown(levels, middle, change, facets, shown);
    });
}

/** What foil of as many facets as one likes shows, which is smooth. */
export function smoothOf({ gaps }, shown) {
    const of = directionsOf(gaps);
    const count = shown.map((_, direction) => of.filter((one) => one === direction).length);
    return [0, 1, 2].map((c) => shown.reduce((sum, rgb, direction) => sum + (rgb[c] * count[direction]) / of.length, 0));
}
