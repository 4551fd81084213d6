// modules/diffraction/shaders/sparkle.glsl in TSL.
import {
    abs, atan, ceil, clamp, cos, exp2, float, floor, fract, If, int, length, log2, max, min, select, sin, smoothstep, sqrt, uint, uvec4, vec2, vec4,
} from "three/tsl";
import type { Node } from "three/webgpu";
import type { MeshView } from "./grooves.js";
import { loop, type Float, type Int, type Program, type Uint, type Vec2, type Vec4 } from "./program.js";

const SPARKLE_PARTS = 16;
const FEW_FACETS = 4;
const MOST_ALONG = 8; // texels along a side; a pixel covers six, of which it cuts two

/**
 * A pixel with few facets is shaded at points. One with more is shaded in equal ranges of directions, each as bright as
 * the facets in it are many, of those whose texels the pixel covers in a level with few: they belong to the surface.
 */
export interface Sparkle {
    parts: Int;
    /** The deviation of the mean over the pixel's facets, over that of the mean over those that were read. */
    noise: Float;
    /** Eight bits for each range: the weight of the facets in it. */
    counts: Node<"uvec4">;
    total: Float;
    /** Where in its range a direction is shaded: the same in all ranges. */
    within: Float;
    moments: Vec4; // of one facet, with the pixel's coverage
}

/** The sums over facets that a pixel's moments are made of. */
interface FacetSums {
    seen: Vec4; // of one of them
    coverage: Float; // times its weight
    weight: Float; // of all texels, with a facet or not
    squares: Float; // of the facets' weights
}

/** The counts of a range and of three beside it, and where its own begins in them. */
const four_counts = ({ counts }: Sparkle, range: Int) =>
    (counts as unknown as { element(i: unknown): Uint }).element(range.shiftRight(int(2)));
const shift_in_four = (range: Int) => uint(range.bitAnd(int(3)).mul(int(8)) as Int);

export function sparkle_of(program: Program) {
    /** Of the moments' angle, over that of the direction. */
    const ALL_DIRECTIONS = program.has("GROOVES_EVEN") ? 2 * Math.PI : Math.PI;

    const facet_at = (uv: Vec2, level: Float = float(0)): Vec4 =>
        program.textureLod("groove_map", uv, level).add(program.textureLod("groove_map_rest", uv, level)).toVar();

    /** The facet at a point of a golden-ratio lattice, which tells areas in the pixel. */
    function facet_moments({ map_uv, map_uv_change: [across, down] }: MeshView, part: Int): Vec4 {
        const at = vec2(float(part).add(0.5).div(SPARKLE_PARTS), fract(float(part).mul(0.61803399))).sub(0.5).toVar();
        return facet_at(map_uv.add(across.mul(at.x)).add(down.mul(at.y)));
    }

    /** The texels of a level that the pixel covers. */
    function texels_in({ map_uv_change: [across, down] }: MeshView, level?: Int): Float {
        const texels = program.size("groove_map", level).toVar();
        return abs(across.x.mul(down.y).sub(across.y.mul(down.x))).mul(texels.x).mul(texels.y);
    }

    /**
     * The weight of a texel that the pixel covers whole: 200 for all texels of a level, so that a range's eight bits
     * hold them, whatever the pixel's shape.
     */
    const texel_weight = (mesh: MeshView, level: Int): Float => float(200).div(min(texels_in(mesh, level), MOST_ALONG * MOST_ALONG));

    /**
     * Adds the facets of a level. `unit`: the weight of a texel that the pixel covers whole; `below`: that of one of the
     * level below, whose facets these are as well.
     */
    function count_facets({ map_uv, map_uv_change }: MeshView, level: Int, unit: Float, below: Float, sparkle: Sparkle, sums: FacetSums): void {
        const texels = program.size("groove_map", level).toVar();
        const across = map_uv_change[0].mul(texels).toVar();
        const down = map_uv_change[1].mul(texels).toVar();
        const determinant = across.x.mul(down.y).sub(across.y.mul(down.x)).toVar();
        const to_pixel = [vec2(down.y, across.y.negate()).div(determinant).toVar(), vec2(down.x.negate(), across.x).div(determinant).toVar()] as const;
        const half_pixel = abs(across).add(abs(down)).mul(0.5).toVar();
        const half_texel = abs(to_pixel[0]).add(abs(to_pixel[1])).mul(0.5).toVar();
        const middle = map_uv.mul(texels).toVar();
        const first = floor(middle.sub(half_pixel)).toVar();
        const count = min(floor(middle.add(half_pixel)).sub(first).add(1), MOST_ALONG).toVar();
        const columns = int(count.x).toVar() as Int;
        loop("texel_of_facet", 0, int(count.x.mul(count.y)).toVar() as Int, (i) => {
            const row = i.div(columns).toVar() as Int;
            const texel = first.add(vec2(float(i.sub(row.mul(columns)) as Int), float(row))).add(0.5).toVar();
            const offset = texel.sub(middle).toVar();
            const at = to_pixel[0].mul(offset.x).add(to_pixel[1].mul(offset.y)).toVar();
            const covered = max(min(at.add(half_texel), 0.5).sub(max(at.sub(half_texel), -0.5)), 0).div(half_texel.mul(2)).toVar();
            const weight = floor(unit.mul(covered.x).mul(covered.y).add(0.5)).toVar();
            If(weight.greaterThan(0), () => {
                sums.weight.addAssign(weight);
                const moments = facet_at(texel.div(texels), float(level));
                If(moments.z.notEqual(0), () => {
                    sums.seen.assign(moments);
                    sums.coverage.addAssign(weight.mul(moments.w));
                    sums.squares.addAssign(weight.mul(weight).mul(below.mul(2).div(unit).add(1)));
                    sparkle.total.addAssign(weight);
                    const mean = moments.xy.sub(0.5).toVar();
                    const direction = fract(atan(mean.y, mean.x).div(ALL_DIRECTIONS)).mul(SPARKLE_PARTS).toVar();
                    sparkle.within.assign(fract(direction));
                    const range = int(min(direction, SPARKLE_PARTS - 0.5)).toVar() as Int;
                    four_counts(sparkle, range).addAssign(uint(weight).shiftLeft(shift_in_four(range)));
                });
            });
        });
    }

    /** Call it first: `moments` are those of one of the pixel's facets, with the pixel's coverage. */
    function find_sparkle(mesh: MeshView): Sparkle {
        const size = program.size("groove_map").toVar();
        const [across, down] = mesh.map_uv_change;
        const width = abs(across).add(abs(down)).mul(size).toVar();
        const facets = texels_in(mesh).div(program.float("facet_texels")).toVar();
        const sparkle: Sparkle = {
            parts: select(facets.lessThan(0.02), int(1), int(SPARKLE_PARTS)).toVar() as Int,
            noise: float(1).toVar(),
            counts: uvec4(0).toVar(),
            total: float(0).toVar(),
            within: float(0.5).toVar(),
            moments: vec4(0).toVar(),
        };
        const sums: FacetSums = { seen: sparkle.moments, coverage: float(0).toVar(), weight: float(0).toVar(), squares: float(0).toVar() };
        If(facets.lessThan(FEW_FACETS), () => {
            loop("facet", 0, sparkle.parts, (part) => {
                const moments = facet_moments(mesh, part);
                sums.weight.addAssign(1);
                If(moments.z.notEqual(0), () => {
                    sums.seen.assign(moments);
                    sums.coverage.addAssign(moments.w);
                });
            });
        }).Else(() => {
            // At most six texels along the longer side. Their weights go over to the next level's before these are three.
            const longer = max(width.x, width.y).toVar();
            const last = int(log2(max(size.x, size.y)).add(0.01));
            const level = int(clamp(ceil(log2(longer.div(6))), 0, float(last))).toVar() as Int;
            const next = select(level.equal(last), float(0), smoothstep(3, 6, longer.div(exp2(float(level))))).toVar() as Float;
            const unit = float(1).sub(next).mul(texel_weight(mesh, level)).toVar();
            count_facets(mesh, level, unit, float(0), sparkle, sums);
            If(next.greaterThan(0), () => {
                const coarser = level.add(1).toVar() as Int;
                count_facets(mesh, coarser, next.mul(texel_weight(mesh, coarser)).toVar(), unit, sparkle, sums);
            });
            // The pixel's edges cut facets: a mean over a square of the side a > 1 has the variance (1/a - 1/(3 a^2))^2.
            const side = sqrt(facets).toVar();
            const read = sparkle.total.mul(sparkle.total).div(max(sums.squares, 1)).toVar();
            sparkle.noise.assign(min(sqrt(read).mul(float(1).div(side).sub(float(1).div(side.mul(side).mul(3)))), 1));
        });
        if (program.has("GROOVE_GAPS"))
            If(sums.seen.z.greaterThan(0), () => {
                const coverage = sums.coverage.div(sums.weight).toVar();
                const ratio = coverage.div(sums.seen.w).toVar();
                sums.seen.assign(vec4(sums.seen.xy.sub(0.5).mul(ratio).add(0.5), sums.seen.z.mul(ratio), coverage));
            });
        return sparkle;
    }

    /** The moments of a facet, or of the facets whose directions are in a range, and their weight. */
    function sparkle_part(mesh: MeshView, sparkle: Sparkle, part: Int): { moments: Vec4; weight: Float } {
        const moments = sparkle.moments.toVar();
        const weight = float(1).toVar();
        If(sparkle.total.equal(0), () => {
            moments.assign(facet_moments(mesh, part));
        }).Else(() => {
            const angle = float(part).add(sparkle.within).mul(ALL_DIRECTIONS / SPARKLE_PARTS).toVar();
            const count = float(four_counts(sparkle, part).shiftRight(shift_in_four(part)).bitAnd(uint(255)) as Uint);
            moments.xy.assign(vec2(cos(angle), sin(angle)).mul(length(moments.xy.sub(0.5))).add(0.5));
            weight.addAssign(sparkle.noise.mul(count.mul(SPARKLE_PARTS).div(sparkle.total).sub(1)));
        });
        return { moments, weight };
    }

    return { find_sparkle, sparkle_part };
}
