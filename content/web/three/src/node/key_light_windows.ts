// modules/diffraction/shaders/key_light_windows.glsl in TSL: the probe's key lights as the CPU shades them.
import {
    abs, clamp, dot, exp, exp2, float, If, int, inverseSqrt, length, log2, max, min, select, sqrt, vec2, vec3, vec4,
} from "three/tsl";
import { BOX_VARIANCE, deviation_of, type Grooves, type GrooveView } from "./grooves.js";
import type { Kernel } from "./kernel.js";
import { loop, type Float, type KeyLobe, type Program, type Vec2, type Vec3, type Vec4 } from "./program.js";

// light_blocks.h
const LOBE_WINDOWS = 6; // on either side of the middle
const LOBE_WINDOW_STEP = 0.505964;

/**
 * The light above the horizon, A(z) = integral of sin t e^(z (cos(t - t0) - 1)) over t in (0, pi), over
 * z = concentration cos psi0 cos psi. log2(A) without its decay below the horizon is approximated by a cubic in
 * log2(1 + z) from value and slope at z = 0 and at another z, and linearly beyond.
 */
interface LightAbove {
    decay: Float; // of log2(A), over z
    at: Float; // log2(1 + z) there
    powers: Vec4; // of log2(1 + z) less that
}

/** A and z/A dA/dz for z < 3; `sine` and `cosine` of t0, the latter not negative. */
function light_above_wide(sine: Float, cosine: Float, z: Float): Vec2 {
    const HEIGHTS = [0.14683948, 0.66311352]; // Gauss-Legendre, five nodes
    const ALONG = [0.98916033, 0.74851884];
    const WEIGHTS = [0.37216388, 0.75182816, 0.89360858];
    const sum = exp(z.mul(sine.sub(1))).mul(WEIGHTS[2]).toVar();
    const change = sine.sub(1).mul(sum).toVar();
    for (let i = 0; i < 2; ++i) {
        const power = vec2(cosine, cosine.negate()).mul(ALONG[i]).add(sine.mul(HEIGHTS[i]).sub(1)).toVar();
        const light = exp(power.mul(z)).mul(WEIGHTS[i] * HEIGHTS[i]).toVar();
        sum.addAssign(light.x.add(light.y));
        change.addAssign(dot(power, light));
    }
    return vec2(sum, z.mul(change).div(sum));
}

/**
 * The same for z >= 3, in the tails also: with tau = t - t0 the part in sin(tau) has a closed integral, the other is
 * normal in 2 sqrt(z) sin(tau/2) from -middle on, to 1/z^2.
 */
function light_above_narrow(sine: Float, cosine: Float, z: Float, clamped_mean: Kernel["clamped_mean"]): Vec2 {
    const half_cosine = sqrt(cosine.mul(0.5).add(0.5)).toVar();
    const root = sqrt(z).toVar();
    const middle = sine.mul(root).div(half_cosine).toVar();
    const end = half_cosine.mul(root).mul(2).toVar();
    const at_begin = exp(middle.mul(middle).mul(-0.5)).toVar();
    const at_end = exp(end.mul(end).mul(-0.5)).toVar();
    const second = float(0.375).div(z).toVar();
    const even = float(1).sub(second).mul(half_cosine).toVar();
    const normal = clamped_mean(middle, float(1)).mul(2.506628274631).sub(at_begin).toVar();
    const tails = second.mul(end.mul(at_end).add(middle.mul(at_begin)))
        .sub(float(1).sub(second).mul(at_end).mul(end).div(end.mul(end).add(1)));
    const sum = cosine.mul(at_begin.sub(at_end)).add(even.mul(normal)).add(root.mul(sine).mul(tails)).toVar();
    const change = even.mul(0.5).add(second.mul(half_cosine)).mul(normal)
        .sub(cosine.sub(even).mul(0.5).mul(middle).mul(middle).mul(at_begin));
    return vec2(sum.div(z), change.div(sum).sub(1));
}

function light_above(sine: Float, cosine: Float, whole_z: Float, clamped_mean: Kernel["clamped_mean"]): LightAbove {
    const decay = select(sine.lessThan(0), sine.mul(sine).div(cosine.add(1)), float(0)).toVar() as Float;
    const z = min(whole_z, float(1.5).div(max(decay, 1e-6))).toVar(); // beyond, little light is left and its slope is uncertain
    const light = vec2(0).toVar();
    If(z.lessThan(3), () => {
        light.assign(light_above_wide(sine, cosine, z));
    }).Else(() => {
        light.assign(light_above_narrow(sine, cosine, z, clamped_mean));
    });
    const at = max(log2(z.add(1)), 1e-3).toVar();
    const value = log2(max(light.x, 1e-30)).add(decay.mul(z).mul(Math.LOG2E)).toVar();
    const slope = light.y.add(decay.mul(z)).mul(z.add(1)).div(z).toVar();
    const first_slope = sine.mul(Math.PI / 4).sub(1).add(decay);
    const rest = float(1).sub(value).div(at).add(slope).toVar(); // A = 2 at z = 0
    const third = first_slope.sub(slope).add(rest.mul(2)).div(at).toVar();
    return { decay: decay.mul(Math.LOG2E).toVar(), at, powers: vec4(value, slope, rest.div(at).add(third), third.div(at)).toVar() };
}

const NO_LIGHT = -1e30;

/**
 * log2 of a lobe's light where cos psi = `cosine`, `z` = concentration cos psi0 cos psi, over the normal distribution of
 * psi, of this variance. `d`: from the middle, in deviations.
 */
function log_light({ decay, at, powers }: LightAbove, cosine: Float, z: Float, variance: Float, d: Float): Float {
    const far = log2(z.add(1)).sub(at).toVar();
    const light = powers.x.add(far.mul(powers.y.add(min(far, 0).mul(powers.z.add(far.mul(powers.w))))));
    // -2 sin^2(d/2) + d^2/2 of the angle, over the variance
    const square = d.mul(d).toVar();
    const beyond_normal = variance.mul(square).mul(square).mul(Math.LOG2E)
        .mul(float(1 / 24).sub(variance.mul(square).mul(1 / 720)));
    return select(cosine.lessThan(1e-4), float(NO_LIGHT),
        log2(max(cosine, 1e-4)).mul(2).add(min(light, 1)).sub(decay.mul(z)).add(beyond_normal)) as Float;
}

export function key_light_windows(program: Program, { to_tangent, pixel_u }: Grooves, kernel: Kernel) {
    const { kernel_reached, kernel_row, kernel_texel, kernel_scale_bias, zero_order_value } = kernel;

    // The normal distribution of psi is a sum of narrower ones at equal steps. The lobe's other factors are normal in each,
    // from their logarithms at its neighbours: slope and curvature. Lengths are in deviations of the lobe, but those of u.
    function add_key_lobe_radiance(lobe: KeyLobe, view: GrooveView, result: Vec3): void {
        const STEP = LOBE_WINDOW_STEP; // 1.6 deviations of a window
        const WITHIN = 0.1; // a window's part of the variance
        const s = lobe.direction.xyz;
        const u = pixel_u(view, s);
        const axis = to_tangent(view, s).toVar();
        const mean = axis.mul(lobe.moments.x).toVar();
        // Five deviations below the horizon, 5e-8 of the lobe's cosine remains.
        const seen = mean.z.greaterThanEqual(lobe.moments.w.negate());
        const reach = view.pitch.mul(lobe.moments.w.add(deviation_of(u).mul(5))).add(kernel_scale_bias.z.mul(5));
        If(kernel.zero_order ? seen : seen.and(kernel_reached(view.pitch.mul(u.mean), reach)), () => {
            axis.x.assign(clamp(axis.x, -1, 1));
            const across = max(length(axis.yz), 1e-6).toVar();
            const z = lobe.direction.w.mul(across).toVar();
            const deviation = inverseSqrt(lobe.direction.w).toVar();
            const variance = deviation.mul(deviation).toVar();
            // Half a deviation from the middle, away from g: where the lobe surrounds g, most of its light is there. For a
            // lobe below the horizon, from the nearest point of the horizon.
            const nearest = vec2(select(axis.z.lessThan(0), max(abs(axis.y), 1e-6), across) as Float, abs(axis.x)).toVar();
            nearest.mulAssign(inverseSqrt(dot(nearest, nearest)));
            const above = light_above(axis.z.div(across).toVar(), abs(axis.y).div(across).toVar(),
                z.mul(0.5).mul(dot(nearest, vec2(lobe.turns.x.add(1), lobe.turns.y))), kernel.clamped_mean);
            // Cosine and sine of psi in a window and in the next one.
            const step = lobe.turns.zw;
            const next = vec2(across, axis.x).mul(lobe.variance.z)
                .add(vec2(axis.x, across.negate()).mul(lobe.variance.w)).toVar();
            const psi = next.mul(step.x).add(vec2(next.y, next.x.negate()).mul(step.y)).toVar();
            const before = float(NO_LIGHT).toVar();
            const here = log_light(above, psi.x, z.mul(psi.x).toVar(), variance, float((LOBE_WINDOWS + 1) * STEP)).toVar();
            const after = log_light(above, next.x, z.mul(next.x).toVar(), variance, float(LOBE_WINDOWS * STEP)).toVar();
            const scale = kernel.kernel_scale();
            const from = u.mean.sub(axis.x).toVar();

            const widest = sqrt(variance.mul(2 * WITHIN).add(u.square_width.mul(BOX_VARIANCE)));
            const beyond = view.pitch.mul(widest).add(scale.scale_bias.z).mul(5).toVar();
            const sums = [vec3(0).toVar(), vec3(0).toVar(), vec3(0).toVar()]; // of red, green and blue light
            const zero = vec3(0).toVar();
            loop("window_index", -LOBE_WINDOWS, LOBE_WINDOWS + 1, (i) => {
                const d = float(i).mul(STEP).toVar();
                psi.assign(next);
                next.assign(psi.mul(step.x).add(vec2(psi.y.negate(), psi.x).mul(step.y)));
                before.assign(here);
                here.assign(after);
                after.assign(log_light(above, next.x, z.mul(next.x).toVar(), variance, d.add(STEP)));
                If(here.notEqual(NO_LIGHT), () => {
                    const rise = after.sub(here).toVar();
                    const fall = here.sub(before).toVar();
                    If(after.equal(NO_LIGHT), () => {
                        rise.assign(fall);
                    });
                    If(before.equal(NO_LIGHT), () => {
                        fall.assign(rise);
                    });
                    const narrowing = clamp(float(1).sub(rise.sub(fall).mul((WITHIN * Math.LN2) / (STEP * STEP))), 0.5, 2);
                    const narrower = inverseSqrt(narrowing).toVar();
                    const within = narrower.mul(narrower).mul(WITHIN).toVar();
                    const slope = rise.add(fall).mul(0.5 / STEP).toVar(); // of log2
                    const farthest = 1.5 * Math.sqrt(WITHIN);
                    const shift = clamp(slope.mul(within).mul(Math.LN2), -farthest, farthest).toVar();
                    const growth = min(slope.mul(slope).mul(within).mul(0.5 * Math.LN2), 1.7);
                    const light = exp2(here.add(growth).sub(d.mul(d).mul(0.5 / (Math.LN2 * (1 - WITHIN))))).mul(narrower).toVar();
                    // Mean and variance of sin psi.
                    shift.mulAssign(deviation);
                    within.mulAssign(variance);
                    const turned = float(1).sub(shift.mul(shift).mul(0.5)).toVar();
                    const sine = psi.y.mul(turned).add(psi.x.mul(shift)).toVar();
                    const cosine = psi.x.mul(turned).sub(psi.y.mul(shift)).toVar();
                    const square = within.mul(cosine.mul(cosine).mul(float(1).sub(within.mul(1.5))).add(within.mul(0.5)));
                    const centre = view.pitch.mul(from.add(sine.mul(float(1).sub(within.mul(0.5))))).toVar();
                    const square_width = view.pitch.mul(view.pitch).mul(square.div(BOX_VARIANCE).add(u.square_width)).toVar();
                    if (kernel.zero_order)
                        zero.addAssign(zero_order_value(centre, sqrt(square_width.mul(BOX_VARIANCE)), lobe.flux.xyz).mul(light));
                    If(kernel_reached(centre, beyond), () => {
                        const row = kernel_row(scale, square_width).toVar();
                        sums.forEach((sum, c) => sum.addAssign(kernel_texel(scale, centre, from, row, c).mul(light)));
                    });
                });
            });
            // The norm of the windows and, for concentrations of 3 and more, of the lobe's density.
            const norm = float(STEP / Math.sqrt(1 - WITHIN) / (2 * Math.PI)).div(deviation);
            const along = kernel.spread_along_grooves(mean, lobe.moments);
            const sum = sums[0].mul(lobe.flux.x).add(sums[1].mul(lobe.flux.y)).add(sums[2].mul(lobe.flux.z));
            result.addAssign(norm.mul(0.5).mul(view.pitch).mul(kernel.lobe_transmittance(mean.z, lobe.moments))
                .mul(kernel.groove_factor(along.x.add(view.direction.y), along.y)).mul(sum.mul(scale.scale_bias.w).add(zero)));
        });
    }

    function key_lights_radiance(view: GrooveView): Vec3 {
        const sum = vec3(0).toVar();
        const count = int(program.vec4("key_lobe_count").x);
        loop("key_light", 0, count, (i) => add_key_lobe_radiance(program.key_lobe(i), view, sum));
        return sum;
    }

    /** Working space. */
    const key_lights_at_pixel = (view: GrooveView): Vec3 => kernel.kernel_to_working(key_lights_radiance(view));

    return { key_lights_at_pixel };
}
