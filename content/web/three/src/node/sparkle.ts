// modules/diffraction/shaders/sparkle.glsl in TSL.
import { abs, atan, cos, float, floor, fract, If, int, length, log2, max, min, select, sin, sqrt, uint, vec2, vec4 } from "three/tsl";
import type { MeshView } from "./grooves.js";
import { loop, type Float, type Int, type Program, type Uint, type Vec2, type Vec4 } from "./program.js";

const SPARKLE_PARTS = 16;

/** A pixel with more facets than parts is shaded in equal ranges of directions, each as bright as the facets in it are many. */
export interface Sparkle {
    parts: Int;
    /** The deviation of the mean over the pixel's facets, over that of the mean over the parts'. */
    noise: Float;
    /** For each range, four bits: the number of parts whose facet is in it; 16 counts as 15. */
    counts: readonly [Uint, Uint];
    covered: Float; // parts that have a facet
    /** Where in its range a direction is shaded: random, and the same in all ranges. */
    within: Float;
}

export function sparkle_of(program: Program) {
    /** Of the moments' angle, over that of the direction. */
    const ALL_DIRECTIONS = program.has("GROOVES_EVEN") ? 2 * Math.PI : Math.PI;
    const texels = program.size("groove_map");

    function facet_moments({ map_uv, map_uv_change: [across, down] }: MeshView, noise: Float, part: Int): Vec4 {
        const width = abs(across).add(abs(down)).mul(texels).toVar();
        // Of few facets the golden-ratio lattice finds the areas in the pixel, of many the square one meets each once.
        const fraction = float(part).add(0.5).div(SPARKLE_PARTS).toVar();
        const square = vec2(float(part.bitAnd(int(3)) as Int), float(part.shiftRight(int(2)) as Int)).add(0.5).div(4);
        const at = select(noise.lessThan(1), square, vec2(fraction, fract(float(part).mul(0.61803399)))).sub(0.5).toVar() as Vec2;
        const level = floor(max(log2(max(max(width.x, width.y).div(8), 0.5)).add(fraction), 0)).toVar() as Float;
        const uv = map_uv.add(across.mul(at.x)).add(down.mul(at.y)).toVar();
        return program.textureLod("groove_map", uv, level).add(program.textureLod("groove_map_rest", uv, level)).toVar();
    }

    /** The moments of one of the pixel's facets, with the pixel's coverage. */
    function find_sparkle(mesh: MeshView): { sparkle: Sparkle; moments: Vec4 } {
        const [across, down] = mesh.map_uv_change;
        const area = abs(across.x.mul(down.y).sub(across.y.mul(down.x)));
        const facets = area.mul(texels.x).mul(texels.y).div(program.float("facet_texels")).toVar();
        const side = sqrt(max(facets, 1)).toVar();
        const noise = min(float(1).div(side).sub(float(1).div(side.mul(side).mul(3))).mul(Math.sqrt(SPARKLE_PARTS)), 0.95);
        const sparkle = {
            parts: select(facets.lessThan(0.02), int(1), int(SPARKLE_PARTS)).toVar() as Int,
            noise: select(facets.lessThan(4), float(1), noise).toVar() as Float,
            counts: [uint(0).toVar(), uint(0).toVar()] as const,
            covered: float(0).toVar(),
            within: float(0.5).toVar(),
        };
        const seen = vec4(0).toVar();
        const coverage = float(0).toVar();
        loop("facet", 0, sparkle.parts, (part) => {
            const moments = facet_moments(mesh, sparkle.noise, part);
            If(moments.z.notEqual(0), () => {
                seen.assign(moments);
                coverage.addAssign(moments.w);
                sparkle.covered.addAssign(1);
                const mean = moments.xy.sub(0.5).toVar();
                const direction = fract(atan(mean.y, mean.x).div(ALL_DIRECTIONS)).mul(SPARKLE_PARTS).toVar();
                sparkle.within.assign(fract(direction));
                const range = uint(min(direction, SPARKLE_PARTS - 0.5)).toVar() as Uint;
                const shift = range.bitAnd(uint(7)).mul(uint(4)).toVar() as Uint;
                const inFirst = range.lessThan(uint(8));
                sparkle.counts.forEach((counts, i) => {
                    If((i === 0 ? inFirst : inFirst.not()).and(counts.shiftRight(shift).bitAnd(uint(15)).lessThan(uint(15))), () => {
                        counts.addAssign(uint(1).shiftLeft(shift));
                    });
                });
            });
        });
        if (program.has("GROOVE_GAPS"))
            If(seen.z.greaterThan(0), () => {
                coverage.divAssign(float(sparkle.parts));
                const ratio = coverage.div(seen.w).toVar();
                seen.assign(vec4(seen.xy.sub(0.5).mul(ratio).add(0.5), seen.z.mul(ratio), coverage));
            });
        return { sparkle, moments: seen };
    }

    /** The moments of a facet, or of the facets whose directions are in a range, and their weight. */
    function sparkle_part(mesh: MeshView, { noise, counts, covered, within }: Sparkle, part: Int): { moments: Vec4; weight: Float } {
        const moments = facet_moments(mesh, noise, part);
        const weight = float(1).toVar();
        If(noise.lessThan(1), () => {
            const angle = float(part).add(within).mul(ALL_DIRECTIONS / SPARKLE_PARTS).toVar();
            moments.xy.assign(vec2(cos(angle), sin(angle)).mul(length(moments.xy.sub(0.5))).add(0.5));
            const shift = uint(part.bitAnd(int(7)).mul(int(4)) as Int);
            const count = float(select(part.lessThan(int(8)), counts[0], counts[1]).shiftRight(shift).bitAnd(uint(15)) as Uint);
            weight.addAssign(noise.mul(count.mul(SPARKLE_PARTS).div(max(covered, 1)).sub(1)));
        });
        return { moments, weight };
    }

    return { find_sparkle, sparkle_part };
}
