// modules/diffraction/shaders/kernel.glsl in TSL, for three colours of light.
import {
    abs, clamp, dot, exp, exp2, float, If, length, log2, max, min, select, sin, sqrt, vec2, vec3,
} from "three/tsl";
import type { Grooves } from "./grooves.js";
import type { Bool, Float, Program, Vec2, Vec3, Vec4 } from "./program.js";

export interface KernelScale {
    scale_bias: Vec4;
    rows: Vec2;
}

export interface ClampedMoments {
    weighted_mean: Float;
    weighted_variance: Float;
}

export type Kernel = ReturnType<typeof kernel>;

/** d k(d u), the colour kernel smoothed by a normal distribution of u: bake/kernel_cells.h. */
export function kernel(program: Program, { cover_transmittance }: Pick<Grooves, "cover_transmittance">) {
    // Scale and offset from u to s; deviation of u in row 0; scale of the values.
    const kernel_scale_bias = program.vec4("kernel_scale_bias");
    const kernel_reach = program.vec2("kernel_reach"); // centre and half-width of the |u| where k is not 0
    const zero_order = program.has("ZERO_ORDER");
    const gaussian = program.has("LOBE_GAUSSIAN");
    const pits = program.has("LOBE_PITS");

    /** Whether k is other than 0 somewhere within `reach` of u. */
    const kernel_reached = (u: Float, reach: Float): Bool => abs(abs(u).sub(kernel_reach.x)).lessThan(kernel_reach.y.add(reach));

    const biased_log2 = (x: Float) => log2(max(x, 1e-30));

    /** kernel_scale_bias, and kernel_rows for the argument of kernel_row(): 12 variances of u are the squared width of a box. */
    function kernel_scale(): KernelScale {
        const BIAS = Math.log2(12);
        const kernel_rows = program.vec2("kernel_rows"); // scale and offset from log2(deviation of u) to t
        const rows = vec2(kernel_rows.x.mul(0.5), kernel_rows.y.sub(kernel_rows.x.mul(0.5 * BIAS))).toVar();
        return { scale_bias: kernel_scale_bias, rows };
    }

    /** The coordinate t for a box of this squared width. It may lie outside the table, which clamps it. */
    const kernel_row = ({ rows }: KernelScale, square_width: Float): Float => biased_log2(square_width).mul(rows.x).add(rows.y);

    function kernel_texel({ scale_bias }: KernelScale, u: Float, v_g: Float, t: Float, layer: number): Vec3 {
        const s = u.mul(scale_bias.x).add(scale_bias.y);
        if (!program.has("KERNEL_VIEWS")) return program.textureLayer("kernel_table", vec2(s, t), layer).xyz;
        // (1 + view_coordinate()) / 2, between horizons that lie a little farther apart: no quotient 0 / 0.
        // Factors of the layer and of a view between 0 and 1, and offset, to r.
        const kernel_views = program.vec3("kernel_views");
        const view = clamp(v_g.sub(u.mul(0.5)).div(float(2.0001).sub(abs(u))).add(0.5), 0, 1);
        const r = kernel_views.x.mul(layer).add(view.mul(kernel_views.y)).add(kernel_views.z);
        return program.textureLod("kernel_table", vec3(s, t, r)).xyz;
    }

    function zero_order_value(u: Float, deviation: Float, rgb: Vec3): Vec3 {
        const wide = max(deviation, kernel_scale_bias.z).toVar();
        const z = u.div(wide).toVar();
        return program.mat3("zero_order").mul(rgb).mul(exp(z.mul(z).mul(-0.5)).mul(0.39894228040143).div(wide)) as Vec3;
    }

    function kernel_value(u: Float, v_g: Float, deviation: Float, rgb: Vec3): Vec3 {
        const scale = kernel_scale();
        const t = kernel_row(scale, deviation.mul(deviation).mul(12)).toVar();
        const value = vec3(0).toVar();
        // Most lights miss the orders: no look-up is needed for them.
        If(kernel_reached(u, max(deviation, scale.scale_bias.z).mul(5)), () => {
            [rgb.x, rgb.y, rgb.z].forEach((light, c) => value.addAssign(kernel_texel(scale, u, v_g, t, c).mul(light)));
            value.mulAssign(kernel_scale_bias.w);
        });
        return zero_order ? value.add(zero_order_value(u, deviation, rgb)) : value;
    }

    // 2 D_h(s_h + v_h) for X, Y and Z, widened by the light's extent along the grooves: representations/direct/direct.h,
    // groove_factor().
    const lobe_gaussian = program.vec2("lobe_gaussian"); // deviation; peak of D_h

    /**
     * Sum of both parts of pits over nodes at `sum_h`; the weights sum to 2, the factor of 2 D_h. `peak`: of the coherent
     * part.
     */
    function pits_factor(sum_h: Vec3, weights: Vec3, peak: Float): Vec3 {
        const pit_length_over_wavelength = program.vec3("pit_length_over_wavelength"); // for X, Y and Z
        const incoherent = program.float("incoherent"); // fraction of the power
        const z = sum_h.div(lobe_gaussian.x).toVar();
        const coherent = peak.mul(dot(weights, exp(z.mul(z).mul(-0.5)))).toVar();
        const factor = (over: Float) => {
            // Nearer to 0 the quotient is 1, to 2e-5; a GPU's sine may have an error of 1e-6.
            const x = max(abs(sum_h.mul(over.mul(Math.PI))), 0.01).toVar();
            const amplitude = sin(x).div(x).toVar();
            return coherent.add(incoherent.mul(over).mul(dot(weights, amplitude.mul(amplitude))));
        };
        const { x, y, z: last } = pit_length_over_wavelength;
        return vec3(factor(x), factor(y), factor(last)).toVar();
    }

    /** Without `deviation_h`: of a light without extent. */
    function groove_factor(sum_h: Float, deviation_h?: Float): Vec3 {
        if (gaussian) {
            const wide = length(vec2(lobe_gaussian.x, deviation_h ?? float(0))).toVar();
            const z = sum_h.div(wide).toVar();
            return vec3(lobe_gaussian.y.mul(2).mul(lobe_gaussian.x).div(wide).mul(exp(z.mul(z).mul(-0.5))));
        }
        if (!pits) return vec3(1);
        if (!deviation_h) return pits_factor(vec3(sum_h), vec3(2, 0, 0), lobe_gaussian.y);
        // Three-node Gauss-Hermite over the light's extent.
        const step = deviation_h.mul(Math.sqrt(3)).toVar();
        return pits_factor(vec3(0, step.negate(), step).add(sum_h).toVar(), vec3(4 / 3, 1 / 3, 1 / 3), lobe_gaussian.y);
    }

    /** The kernel's values are in the working space; with pits, which have a factor each for X, Y and Z, in XYZ. */
    const kernel_to_working = (value: Vec3): Vec3 => (pits ? (program.mat3("xyz_to_working").mul(value) as Vec3) : value);

    /** d k(d u) for a pixel whose pitch d is `pitch_factor` times the material's. */
    const pitch_kernel_value = (u: Float, v_g: Float, deviation: Float, rgb: Vec3, pitch_factor: Float): Vec3 =>
        kernel_value(pitch_factor.mul(u).toVar(), v_g, pitch_factor.mul(deviation).toVar(), rgb).mul(pitch_factor);

    /** Cumulative normal distribution [Press et al., Numerical Recipes, erfcc: 1.2e-7 relative]. */
    function normal_cdf(x: Float): Float {
        const z = abs(x).mul(Math.SQRT1_2).toVar();
        const t = float(1).div(z.mul(0.5).add(1)).toVar();
        const p = [
            0.17087277, -0.82215223, 1.48851587, -1.13520398, 0.27886807, -0.18628806, 0.09678418, 0.37409196, 1.00002368, -1.26551223,
        ].reduce<Float>((sum, c) => sum.mul(t).add(c), float(0));
        const beyond = t.mul(0.5).mul(exp(p.sub(z.mul(z)))).toVar();
        return select(x.lessThan(0), beyond, float(1).sub(beyond)) as Float;
    }

    const normal_density = (x: Float): Float => exp(x.mul(x).mul(-0.5)).mul(0.39894228040143);

    /**
     * Mean of max(0, x) for x of this mean and deviation: engine/lighting/key_lights.h, clamp_normal(). What exceeds
     * max(0, mean) is the deviation times a function of |z|, fitted as 2 to the power of a polynomial: 7e-7 of the deviation.
     */
    function clamped_mean(mean: Float, deviation: Float): Float {
        const z = min(abs(mean).div(max(deviation, 1e-12)), 8).toVar();
        const power = z.mul(0.0031916).sub(0.0426687).mul(z).sub(0.411951).mul(z).sub(1.8080855).mul(z).sub(1.3257504);
        return max(mean, 0).add(deviation.mul(exp2(power)));
    }

    /**
     * Mean and variance of x above 0, values weighted by x, for x of this mean and variance; 0 where nothing is above:
     * engine/lighting/key_lights.h, clamp_normal().
     */
    function clamped_moments(mean: Float, variance: Float): ClampedMoments {
        const deviation = sqrt(variance).toVar();
        const above = normal_cdf(mean.div(deviation).toVar()).toVar(); // P(x > 0)
        const density = deviation.mul(normal_density(mean.div(deviation))).toVar();
        const first = mean.mul(above).add(density).toVar();
        const moments = { weighted_mean: float(0).toVar(), weighted_variance: float(0).toVar() };
        If(first.greaterThan(deviation.mul(1e-6)), () => {
            const square = mean.mul(mean).toVar();
            const weighted = square.add(variance).mul(above).add(mean.mul(density)).div(first).toVar();
            const third = mean.mul(square.add(variance.mul(3))).mul(above).add(square.add(variance.mul(2)).mul(density));
            moments.weighted_mean.assign(weighted);
            moments.weighted_variance.assign(max(third.div(first).sub(weighted.mul(weighted)), 0));
        });
        return moments;
    }

    /** Mean of a cover's transmittance over a lobe: direct.h, transmittance(). `mean_n`: mean of s_n; `moments`: of KeyLobe. */
    function lobe_transmittance(mean_n: Float, moments: Vec4): Float {
        if (!program.has("COVER")) return float(1);
        const above = clamped_moments(mean_n, max(moments.y.mul(mean_n).mul(mean_n).add(moments.z), 0).toVar());
        const deviation = sqrt(above.weighted_variance).toVar();
        return cover_transmittance(above.weighted_mean.sub(deviation))
            .add(cover_transmittance(min(above.weighted_mean.add(deviation), 1))).mul(0.5);
    }

    /**
     * Mean and deviation of s_h, directions weighted by s_n above the horizon: direct.cpp, clamp_at_horizon(). `mean`: of
     * the lobe's directions, in (g, h, n); `moments`: of KeyLobe.
     */
    function spread_along_grooves(mean: Vec3, moments: Vec4): Vec2 {
        if (!gaussian && !pits) return vec2(0);
        const elongation = moments.y;
        const variance_n = max(elongation.mul(mean.z).mul(mean.z).add(moments.z), 0).toVar();
        const variance_h = elongation.mul(mean.y).mul(mean.y).add(moments.z).toVar();
        const above = clamped_moments(mean.z, variance_n);
        const spread = vec2(mean.y, sqrt(max(variance_h, 0))).toVar();
        If(above.weighted_mean.notEqual(0), () => {
            const slope = elongation.mul(mean.y).mul(mean.z).div(variance_n).toVar();
            const uncorrelated = max(variance_h.sub(slope.mul(slope).mul(variance_n)), 0);
            spread.assign(vec2(mean.y.add(slope.mul(above.weighted_mean.sub(mean.z))),
                sqrt(uncorrelated.add(slope.mul(slope).mul(above.weighted_variance)))));
        });
        return spread;
    }

    return {
        zero_order, kernel_scale_bias, kernel_reached, kernel_scale, kernel_row, kernel_texel, zero_order_value, groove_factor,
        kernel_to_working, pitch_kernel_value, clamped_mean, lobe_transmittance, spread_along_grooves,
    };
}
