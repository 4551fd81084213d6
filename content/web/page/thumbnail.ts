/** A picture of grooves under a few lamps, for a button: the grating equation, without the package's maps. */

export interface Facts {
    width: number;
    height: number;
    pitch_nm: number;
    spread_deg: number;
    varies: boolean; // the grooves' distance
}

/** Lamps and eye: the sum of their directions along the card. */
const PATHS = [[-0.5, 0.24], [0.08, 0.58], [0.42, 0.44], [-0.2, -0.5]];
const SILVER = 0.16;

/** Linear Rec.709 of 380 to 780 nm in steps of 2 nm, by the fits of Wyman, Sloan & Shirley 2013. */
const SPECTRUM = Array.from({ length: 201 }, (_, i) => {
    const wavelength_nm = 380 + 2 * i;
    const bell = (x: number, middle: number, width: number) => Math.exp(-0.5 * ((x - middle) / width) ** 2);
    const log = Math.log(wavelength_nm);
    const x = 1.065 * bell(wavelength_nm, 595.8, 33.33) + 0.366 * bell(wavelength_nm, 446.8, 19.44);
    const y = 1.014 * bell(log, Math.log(556.3), 0.075);
    const z = 1.839 * bell(log, Math.log(449.8), 0.051);
    const rgb = [3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z, 0.0557 * x - 0.204 * y + 1.057 * z];
    const beyond = Math.min(0, ...rgb); // of the screen's gamut
    return rgb.map((value) => value - beyond);
});

function add(colour: number[], angle: number, pitch_nm: number, facts: Facts): void {
    const [gx, gy] = [Math.cos(angle), Math.sin(angle)];
    const sigma = 1.6 * Math.sin((facts.spread_deg * Math.PI) / 180);
    for (const [x, y] of PATHS) {
        const along = gx * y - gy * x;
        const lobe = facts.varies ? 0.8 : Math.exp(-0.5 * (along / sigma) ** 2);
        const path_nm = pitch_nm * Math.abs(gx * x + gy * y);
        for (const order of [1, 2, 3]) {
            const rgb = SPECTRUM[Math.round((path_nm / order - 380) / 2)];
            for (let c = 0; rgb && c < 3; ++c) colour[c] += (0.5 * lobe * rgb[c]) / order;
        }
    }
}

const encoded = (x: number) => 255 * Math.min(Math.max(1 - Math.exp(-1.6 * x), 0), 1) ** (1 / 2.2);

/** RGBA of the square in the middle of a card's grooves, as broad as the card. */
export function shaded(grooves: Uint16Array, facts: Facts, side: number): Uint8ClampedArray<ArrayBuffer> {
    const { width, height, pitch_nm } = facts;
    const rgba = new Uint8ClampedArray(4 * side * side).fill(255);
    const top = (height - width) / 2;
    const edge = (i: number) => Math.floor((i * width) / side);
    for (let row = 0; row < side; ++row)
        for (let column = 0; column < side; ++column) {
            const colour = [0, 0, 0];
            let count = 0;
            for (let y = Math.floor(top) + edge(row); y < Math.floor(top) + edge(row + 1); ++y)
                for (let x = edge(column); x < edge(column + 1); ++x, ++count) {
                    const at = 3 * (y * width + x);
                    // One direction of grooves has no texture.
                    if (grooves.length === 0) add(colour, Math.PI / 2, pitch_nm * (0.75 + (0.5 * y) / height), facts);
                    else if (grooves[at + 1] > 0) add(colour, (Math.PI * grooves[at]) / 65535, (pitch_nm * grooves[at + 1]) / 32767.5, facts);
                }
            for (let c = 0; c < 3; ++c) rgba[4 * (row * side + column) + c] = encoded(SILVER + colour[c] / count);
        }
    return rgba;
}
