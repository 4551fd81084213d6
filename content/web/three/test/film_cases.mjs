// Films and views that an engine's pixels are compared at, and what `rowland-trade evaluate` gives there. ROWLAND_TRADE names
// the program.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

export const trade = process.env.ROWLAND_TRADE;

const SOAP = { film: { ior: 1.33, thickness_nm: 400 }, base: { ior: 1 } };
const ANODISED = { film: { ior: 2.4, thickness_nm: 110 }, metal: "Al", roughness: 0.3 };
const COATED = { film: [{ ior: 1.38, thickness_nm: 100 }, { ior: 2.1, thickness_nm: 130 }], base: { ior: 1.52 } };
const OIL = { film: { ior: 1.47, thickness_nm: 800 }, base: { ior: 1.33 } };
const THINNEST_NM = 150;
const TEXELS = [0, 85, 170, 255]; // of OIL's thickness texture

const RGB = [[3.2409699, -1.5373832, -0.4986108], [-0.9692436, 1.8759675, 0.0415551], [0.0556301, -0.203977, 1.0569715]];

/** Views of a surface that faces +z, from the normal to 84°. */
const views = (count, texels) => Array.from({ length: count }, (_, i) => {
    const cosine = 0.1 + (0.9 * (i + 0.5)) / count;
    return { view: [Math.sqrt(1 - cosine * cosine), 0, cosine], texel: texels?.[i % texels.length] };
});
// The ground truth, of each thickness. Nodes with nine bits, as those of a cooked table, would be 6.4e-3 off.
const SMOOTH = { reference: 2e-3 };
// Beside the engine's split sum, with the nine bits of its table: three's differs by 5.1e-3, and both by 9.1e-3.
const ROUGH = { drawn: 1.2e-2 };
// three's mirror has the light that microfacets reflect twice as well: 9.9e-4 measured.
const LAMP = { reference: 2e-3 };
export const CASES = [
    { name: "soap film", film: SOAP, views: views(100), tolerances: SMOOTH },
    { name: "two layers on glass", film: COATED, views: views(100), tolerances: SMOOTH },
    { name: "oil of varying thickness", film: OIL, views: views(100, TEXELS), thicknesses: [THINNEST_NM, 800], tolerances: SMOOTH },
    { name: "soap film, a lamp", film: SOAP, views: views(25), lamp: true, tolerances: LAMP },
    { name: "anodised aluminium, rough", film: ANODISED, views: views(100), tolerances: ROUGH },
];

/** What it reflects of equal white light from everywhere. */
function evaluate(folder, film, views, method) {
    writeFileSync(join(folder, "film.json"), JSON.stringify(film));
    const header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n";
    const texels = Array.from({ length: 16 * 32 }, () => [128, 128, 128, 129]); // 1, 1, 1
    writeFileSync(join(folder, "white.hdr"), Buffer.concat([Buffer.from(header), Buffer.from(texels.flat())]));
    writeFileSync(join(folder, "frames.csv"), "vx,vy,vz,nx,ny,nz,gx,gy,gz\n" +
        views.map(({ view }) => [...view, 0, 0, 1, 1, 0, 0].join(",")).join("\n") + "\n");
    const rows = execFileSync(trade, ["evaluate", "--material", "film.json", "--probe", "white.hdr", "--method", method,
        "--frames", "frames.csv"],
        { cwd: folder, encoding: "utf8" });
    return rows.trim().split("\n").slice(1).map((row) => {
        const xyz = row.split(",").map(Number);
        return RGB.map((weights) => weights.reduce((sum, w, i) => sum + w * xyz[i], 0));
    });
}

/** With the thickness at each view's texel. */
export function expected(folder, { film, views, thicknesses }, method) {
    if (!thicknesses) return evaluate(folder, film, views, method);
    const shown = [];
    for (const texel of TEXELS) {
        const thickness_nm = thicknesses[0] + ((thicknesses[1] - thicknesses[0]) * texel) / 255;
        const those = views.map((_, i) => i).filter((i) => views[i].texel === texel);
        const light = evaluate(folder, { ...film, film: { ...film.film, thickness_nm } }, those.map((i) => views[i]), method);
        those.forEach((i, j) => (shown[i] = light[j]));
    }
    return shown;
}

/** The largest difference, of which view, over the largest component of `expected`. */
export function worstOf(shown, expected) {
    const largest = Math.max(...expected.flat());
    const off = expected.map((rgb, view) => Math.max(...rgb.map((x, c) => Math.abs(x - shown[view][c]))) / largest);
    const worst = Math.max(...off);
    return { worst, at: off.indexOf(worst) };
}
