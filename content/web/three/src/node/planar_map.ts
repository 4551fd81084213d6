// modules/diffraction/representations/planar/planar_map.glsl in TSL: a flat object's map.
import { abs, dot, float, If, log, max, min, select, vec2, vec3 } from "three/tsl";
import type { Float, Program, Vec2, Vec3 } from "./program.js";

/** atan(y, x) / 2π within 2e-6. Minimax polynomial; the GPU's own function takes twice as long. */
function turns(y: Float, x: Float): Float {
    const longer = max(abs(x), abs(y));
    const t = min(abs(x), abs(y)).div(max(longer, 1e-30)).toVar();
    const s = t.mul(t).toVar();
    const eighth = s.mul(0.0033174).sub(0.0135527).mul(s).add(0.028673).mul(s).sub(0.0525696).mul(s).add(0.1591337).mul(t).toVar();
    const quarter = select(abs(y).greaterThan(abs(x)), float(0.25).sub(eighth), eighth).toVar() as Float;
    const half_turn = select(x.lessThan(0), float(0.5).sub(quarter), quarter).toVar() as Float;
    return select(y.lessThan(0), half_turn.negate(), half_turn) as Float;
}

export function planar_map(program: Program) {
    const map_scale = program.float("map_scale"); // of the stored values
    const azimuth_of = (g: Vec3) => turns(dot(g, program.vec3("planar_e2")).toVar(), dot(g, program.vec3("planar_e1")).toVar());

    /** Over v_g, v_h and the azimuth: lobe_map.h. */
    function lobe_map_radiance(along: Vec2, g: Vec3): Vec3 {
        const lobe_map_axes = program.vec4("lobe_map_axes"); // scales of v_g, v_h and the azimuth, offset of the azimuth
        const azimuth = azimuth_of(g).toVar();
        const v = along.toVar();
        if (program.has("HALF_TURN"))
            If(azimuth.lessThan(0), () => {
                azimuth.addAssign(0.5);
                v.assign(v.negate());
            });
        const uvw = vec3(v.mul(lobe_map_axes.xy).add(0.5), azimuth.mul(lobe_map_axes.z).add(lobe_map_axes.w));
        return map_scale.mul(program.textureLod("lobe_map", uvw).xyz);
    }

    function planar_map_uv(v_g: Float, g: Vec3): Vec2 {
        const half_texel = program.vec2("planar_map_half_texel");
        return vec2(azimuth_of(g).add(half_texel.x), v_g.mul(float(0.5).sub(half_texel.y)).add(0.5));
    }

    function map_radiance_of_pitch(v_g: Float, g: Vec3, pitch: Float): Vec3 {
        // From the logarithm of the pitch factor to the map's third coordinate.
        const pitch_scale_bias = program.vec2("pitch_scale_bias");
        const slice = log(pitch).mul(pitch_scale_bias.x).add(pitch_scale_bias.y);
        return map_scale.mul(program.textureLod("planar_map", vec3(planar_map_uv(v_g, g), slice)).xyz);
    }

    /** Over the azimuth of g in the object's plane and v_g: planar_map.h. In the colour space of the stored values. */
    function map_radiance({ x, y }: Vec3, g: Vec3, pitch: Float): Vec3 {
        if (program.has("LOBE_MAP")) return lobe_map_radiance(vec2(x, y), g);
        if (program.has("PITCH_AXIS")) return map_radiance_of_pitch(x, g, pitch);
        return map_scale.mul(program.textureLod("planar_map", planar_map_uv(x, g)).xyz);
    }

    return { map_radiance };
}
