// modules/diffraction/shaders/grooves.glsl in TSL, for materials that reflect.
import {
    abs, cross, dFdx, dFdy, dot, float, floor, If, int, inverseSqrt, length, max, min, normalize, select, sqrt, vec2, vec3,
} from "three/tsl";
import type { Float, Int, Mat3, Program, Vec2, Vec3, Vec4 } from "./program.js";
import { sparkle_of, type Sparkle } from "./sparkle.js";

/** u = s_g + v_g over a pixel: PHYSICS (11.1). */
export interface PixelU {
    mean: Float;
    /** Of a box of u's variance. */
    square_width: Float;
}

const BOX_VARIANCE = 1 / 12; // of a box, over its width squared

/** Differences to the pixels beside and below. */
type Change<Of> = readonly [Of, Of];

/** The pixel before the map's rotation. */
export interface MeshView {
    axes: Mat3;
    direction: Vec3;
    h_change: Change<Vec3>;
    v_h_change: Vec2;
    map_uv: Vec2;
    map_uv_change: Change<Vec2>;
}

export interface GrooveView {
    axes: Mat3; // g, h, n in the world, of the lit side
    direction: Vec3; // toward the eye, in (g, h, n)
    pitch: Float; // over the material's; 0: no grating here
    // Differences of g and v_g, before a map's rotation.
    g_change: Change<Vec3>;
    v_g_change: Vec2;
    map?: GrooveMapView;
}

/** What a groove texture adds to a pixel. */
export interface GrooveMapView {
    mesh: MeshView;
    turn: Vec2; // cosine and sine of the map's mean rotation
    fade: Float; // mean cosine of the grooves' angles to it
    spread: Vec2; // factors of u_h^2 and u_g^2 in the variance of u
    coverage: Float; // fraction of the area that has a grating
    moments: Vec4;
    sparkle?: Sparkle;
}

/** s + v along g and h of the mesh, and its differences to the pixels beside and below. */
export interface MeshU {
    u: Vec2;
    change: Change<Vec2>;
}

/** What the vertices pass. */
export interface GrooveInputs {
    eye: Vec3;
    world_position: Vec3;
    world_normal: Vec3;
    world_grating: Vec3;
    groove_uv?: Vec2;
    groove_hand?: Float;
}

/** s * M: a vector in the world, along the columns. */
const along = (s: Vec3, [g, h, n]: Mat3) => vec3(dot(s, g), dot(s, h), dot(s, n));
const changeOf = <Of extends Vec2 | Vec3>(x: Of) => [dFdx(x as Vec3).toVar(), dFdy(x as Vec3).toVar()] as unknown as Change<Of>;
const change_along = (s: Vec3, [across, down]: Change<Vec3>) => vec2(dot(s, across), dot(s, down));

export const deviation_of = (u: PixelU) => sqrt(u.square_width.mul(BOX_VARIANCE));
export { BOX_VARIANCE };

export type Grooves = ReturnType<typeof grooves>;

export function grooves(program: Program, inputs: GrooveInputs) {
    /** The view, toward the eye in the world, in the lit side's frame. */
    const lit_view_direction = (to_eye: Vec3, axes: Mat3) => along(to_eye, axes);

    /** Fraction of light that enters or leaves at this cosine in air; 0 below the horizon. */
    function cover_transmittance(cosine: Float): Float {
        if (!program.has("COVER")) return float(1);
        const cover_square = program.float("cover_square");
        const above = max(cosine, 0).toVar();
        const inside = sqrt(cover_square.sub(1).add(above.mul(above))).toVar();
        const across = above.add(inside).toVar();
        const along = cover_square.mul(above).add(inside).toVar();
        return above.mul(2).mul(inside).mul(float(1).div(across.mul(across)).add(cover_square.div(along.mul(along))));
    }

    const mesh_sum = (mesh: MeshView, s: Vec3) => vec2(dot(s, mesh.axes[0]), dot(s, mesh.axes[1])).add(mesh.direction.xy);

    /** From the mesh's g and h to those of the pixel's grooves. */
    const turned = ({ turn }: GrooveMapView, along: Vec2) =>
        vec2(dot(turn, along), turn.x.mul(along.y).sub(turn.y.mul(along.x)));

    /** A direction in the world, in (g, h, n). */
    function to_tangent(view: GrooveView, s: Vec3): Vec3 {
        if (!view.map) return along(s, view.axes);
        const in_mesh = along(s, view.map.mesh.axes).toVar();
        return vec3(turned(view.map, in_mesh.xy), in_mesh.z);
    }

    function turned_pixel_u(map: GrooveMapView, mesh: MeshU): PixelU {
        const u = turned(map, mesh.u).toVar();
        // The mesh's own change, as the map may be discontinuous: its moments tell how it varies.
        const across = vec2(dot(map.turn, mesh.change[0]), dot(map.turn, mesh.change[1])).toVar();
        const spread_square = dot(map.spread, vec2(u.y.mul(u.y), u.x.mul(u.x)));
        return {
            mean: map.fade.mul(u.x).toVar(),
            square_width: dot(across, across).add(spread_square.div(BOX_VARIANCE)).toVar(),
        };
    }

    function pixel_u(view: GrooveView, s: Vec3): PixelU {
        const change_g = change_along(s, view.g_change).add(view.v_g_change).toVar();
        if (!view.map)
            return {
                mean: dot(s, view.axes[0]).add(view.direction.x).toVar(),
                square_width: dot(change_g, change_g).toVar(),
            };
        const { mesh } = view.map;
        const change_h = change_along(s, mesh.h_change).add(mesh.v_h_change).toVar();
        const change = [vec2(change_g.x, change_h.x), vec2(change_g.y, change_h.y)] as const;
        return turned_pixel_u(view.map, { u: mesh_sum(mesh, s), change });
    }

    /** For any `s` that varies from pixel to pixel. Uses derivatives: call it in uniform control flow. */
    function mesh_u_of({ mesh }: GrooveMapView, s: Vec3): MeshU {
        const u = mesh_sum(mesh, s).toVar();
        return { u, change: changeOf<Vec2>(u) };
    }

    /** The same without a groove texture. */
    function pixel_u_of(view: GrooveView, s: Vec3): PixelU {
        const u = dot(s, view.axes[0]).add(view.direction.x).toVar();
        const change = vec2(dFdx(u), dFdy(u)).toVar();
        return { mean: u, square_width: dot(change, change).toVar() };
    }

    /**
     * The interpolated grating vector, made orthonormal to the normal; shorter where the vertices' vectors cancel, as at
     * a disc's hub.
     */
    function groove_axes(): Mat3 {
        const n = normalize(inputs.world_normal).toVar();
        const g = inputs.world_grating.sub(n.mul(dot(n, inputs.world_grating))).toVar();
        g.mulAssign(inverseSqrt(max(dot(g, g), 1e-12)));
        return [g, cross(n, g).toVar(), n];
    }

    const sparkling = program.has("GROOVE_SPARKLE") ? sparkle_of(program) : undefined;

    // Halves are filtered, and a second texture has what they round off: runtime/groove_map.h.
    function mean_moments(uv: Vec2, width?: Change<Vec2>): Vec4 {
        const read = (name: string) => program.textureGrad(name, uv, width ?? changeOf(uv));
        return read("groove_map").add(read("groove_map_rest"));
    }

    /** Relative error of the moments' rounding: a value this little below 1 counts as 1. */
    const MOMENT_ROUNDING = 1e-4;

    /** The cosine and the sine, which is not negative, of half the angle of a vector. */
    function half_angle(whole: Vec2): Vec2 {
        const longer = sqrt(abs(whole.x).mul(0.5).add(0.5)).toVar();
        const shorter = whole.y.mul(0.5).div(longer).toVar();
        return select(whole.x.greaterThan(0),
            vec2(select(shorter.lessThan(0), longer.negate(), longer), abs(shorter)), vec2(shorter, longer)) as Vec2;
    }

    /** The grooves that the moments describe. */
    function grooves_of(mesh: MeshView, g_change: Change<Vec3>, v_g_change: Vec2, moments: Vec4): GrooveView {
        const gaps = program.has("GROOVE_GAPS");
        const coverage: Float = gaps ? moments.w : float(1);
        const inverse_variance = gaps ? float(0)
            : max(moments.w.div(max(moments.z.mul(moments.z), 1e-12)).sub(1 + MOMENT_ROUNDING), 0).toVar();
        const mean = moments.xy.mul(2).sub(1).toVar();
        const order = max(length(mean), 1e-6).toVar();
        let turn = mean.div(order).toVar();
        let fade = min(order.mul(1 + MOMENT_ROUNDING).div(max(coverage, 1e-6)), 1);
        if (program.has("GROOVES_EVEN")) {
            turn = half_angle(turn).toVar();
            fade = sqrt(sqrt(fade));
        }
        turn.y.mulAssign(inputs.groove_hand!);
        fade = fade.toVar();
        const square = fade.mul(fade).toVar();
        const lost = float(1).sub(square).toVar();
        const spread = vec2(float(0.5).sub(square.mul(square).mul(0.5)),
            lost.mul(lost).mul(0.5).add(square.mul(inverse_variance))).toVar();
        const [g, h, n] = mesh.axes;
        const v = mesh.direction;
        const axes: Mat3 = [g.mul(turn.x).add(h.mul(turn.y)).toVar(), h.mul(turn.x).sub(g.mul(turn.y)).toVar(), n];
        const direction = vec3(dot(turn, v.xy), turn.x.mul(v.y).sub(turn.y.mul(v.x)), v.z).toVar();
        const groove_pitch = program.float("groove_pitch"); // the smallest, over the material's
        const pitch = select(moments.z.greaterThan(0), groove_pitch.mul(coverage).div(moments.z), float(0)).toVar() as Float;
        return { axes, direction, pitch, g_change, v_g_change, map: { mesh, turn, fade, spread, coverage, moments } };
    }

    // A pixel whose grooves vary is divided into parts, since two distinct directions in it are no normal distribution;
    // into fewer parts where they vary little, as with a texture that rotates the grooves steadily.
    const VARYING = 1e-3;
    const VARYING_MUCH = 1e-2;

    function groove_parts({ spread, sparkle }: GrooveMapView): Int {
        if (sparkle) return sparkle.parts;
        const variation = spread.x.add(spread.y).toVar();
        const few = select(variation.greaterThan(VARYING), int(4), int(1));
        return select(variation.greaterThan(VARYING_MUCH), int(16), few) as Int;
    }

    /**
     * The moments of one of `parts` of the pixel. Asks for half the part's width: a trilinear look-up averages over about
     * twice the width that it is asked for. At level 0 its point moves to the centre of a texel, as grooves interpolated
     * between two texels would be those of neither.
     */
    function part_moments(mesh: MeshView, parts: Int, part: Int): Vec4 {
        const bits = select(parts.equal(4), int(1), int(2)).toVar() as Int; // of the part's column and of its row
        const side = select(parts.equal(4), float(0.5), float(0.25)).toVar() as Float;
        const column = part.bitAnd(int(1).shiftLeft(bits).sub(1)) as Int;
        const at = vec2(float(column), float(part.shiftRight(bits) as Int)).add(0.5).mul(side).sub(0.5).toVar();
        const [across, down] = mesh.map_uv_change;
        const half = side.mul(0.5).toVar();
        const uv = mesh.map_uv.add(across.mul(at.x)).add(down.mul(at.y)).toVar();
        const width = [across.mul(half).toVar(), down.mul(half).toVar()] as const;
        const texels = program.size("groove_map");
        If(max(length(width[0].mul(texels)), length(width[1].mul(texels))).lessThanEqual(1), () => {
            uv.assign(floor(uv.mul(texels)).add(0.5).div(texels));
        });
        return mean_moments(uv, width);
    }

    /** One of `parts`; `view`: the whole pixel. */
    function groove_part(view: GrooveView, parts: Int, part: Int): GrooveView {
        const { mesh, sparkle } = view.map!;
        const moments = view.map!.moments.toVar();
        const weight = float(1).toVar();
        If(parts.greaterThan(1), () => {
            if (!sparkle) return void moments.assign(part_moments(mesh, parts, part));
            const facet = sparkling!.sparkle_part(mesh, sparkle, part);
            moments.assign(facet.moments);
            weight.assign(facet.weight);
        });
        const one = grooves_of(mesh, view.g_change, view.v_g_change, moments);
        return sparkle ? { ...one, map: { ...one.map!, coverage: one.map!.coverage.mul(weight).toVar() } } : one;
    }

    /** Uses derivatives: call it in uniform control flow. */
    function groove_view(): GrooveView {
        const axes = groove_axes();
        const direction = lit_view_direction(normalize(inputs.eye.sub(inputs.world_position)).toVar(), axes).toVar();
        const g_change = changeOf<Vec3>(axes[0]);
        const v_g_change = vec2(dFdx(direction.x), dFdy(direction.x)).toVar();
        if (!inputs.groove_uv) return { axes, direction, pitch: float(1), g_change, v_g_change };
        const linear = program.vec4("groove_uv_linear");
        const { x, y } = inputs.groove_uv;
        const uv = linear.xy.mul(x).add(linear.zw.mul(y)).add(program.vec2("groove_uv_offset")).toVar();
        const mesh: MeshView = {
            axes,
            direction,
            h_change: changeOf<Vec3>(axes[1]),
            v_h_change: vec2(dFdx(direction.y), dFdy(direction.y)).toVar(),
            map_uv: uv,
            map_uv_change: changeOf<Vec2>(uv),
        };
        if (!sparkling) return grooves_of(mesh, g_change, v_g_change, mean_moments(uv, mesh.map_uv_change).toVar());
        const sparkle = sparkling.find_sparkle(mesh);
        const view = grooves_of(mesh, g_change, v_g_change, sparkle.moments);
        return { ...view, map: { ...view.map!, sparkle } };
    }

    return { cover_transmittance, to_tangent, turned_pixel_u, pixel_u, mesh_u_of, pixel_u_of, groove_parts, groove_part, groove_view };
}
