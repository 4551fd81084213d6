// src/glsl/surface.vert.glsl and src/glsl/surface.frag.glsl in TSL: the diffraction term for MeshPhysicalNodeMaterial.
import {
    abs, attribute, cameraWorldMatrix, cross, determinant, dot, float, Fn, If, mat3, max, mix, modelNormalMatrix,
    modelWorldMatrix, normalGeometry, normalize, normalLocal, positionView, select, uv, varying, vec3, vec4,
} from "three/tsl";
import type { BufferGeometry, Camera, OrthographicCamera } from "three";
import { arc } from "./arc.js";
import { deviation_of, grooves, type GrooveInputs, type GrooveView, type PixelU } from "./grooves.js";
import { kernel } from "./kernel.js";
import { key_light_windows } from "./key_light_windows.js";
import { planar_map } from "./planar_map.js";
import type { PosedVertex } from "./pose.js";
import { loop, type Float, type Int, type Program, type Vec2, type Vec3, type Vec4 } from "./program.js";

/** In the probe, of a direction in the world. */
export const in_probe = (program: Program, direction: Vec3) => program.mat3("probe_from_world").mul(direction) as Vec3;

/** Toward the eye, in the view: from the position, or along the axis of an orthographic camera. */
const to_eye = Fn(({ camera }: { camera: Camera }) =>
    (camera as OrthographicCamera).isOrthographicCamera ? vec3(0, 0, 1) : positionView.negate()) as unknown as () => Vec3;

/**
 * g in the object's space before bones and instances: along the tangent, or away from the object's origin.
 */
function grooves_across(program: Program, geometry: BufferGeometry, { position, normal }: PosedVertex, tangent: Vec3): Vec3 {
    const n = normalize(normal) as Vec3;
    const radial = position.sub(n.mul(dot(position, n)));
    const given = normalGeometry;
    // The least rotation from the given normal to the morphed one.
    const sum = given.add(n);
    const turned = geometry.morphAttributes.normal
        ? tangent.sub(sum.mul(dot(sum, tangent).div(max(dot(given, n).add(1), 1e-6)))).add(n.mul(dot(given, tangent).mul(2))) : tangent;
    return select(program.float("radial_grooves").greaterThan(0.5), radial, turned) as Vec3;
}

/**
 * What grooves.ts reads, in the probe; positions count from the eye. The grating vector points along the mesh's tangent or
 * away from the object's origin.
 */
function pass_grooves(program: Program, geometry: BufferGeometry, vertex: PosedVertex): GrooveInputs {
    const tangent: Vec4 = geometry.hasAttribute("tangent") ? attribute("tangent", "vec4") : vec4(0, 0, 0, 1);
    const world_normal = normalize(modelNormalMatrix.mul(normalLocal)) as Vec3;
    // A mirroring transform inverts the cross product.
    const hand = select(determinant(mat3(modelWorldMatrix)).mul(vertex.determinant).lessThan(0), tangent.w.negate(), tangent.w) as Float;
    const g = modelWorldMatrix.mul(vec4(vertex.moved(grooves_across(program, geometry, vertex, tangent.xyz)), 0)).xyz as Vec3;
    const h = cross(world_normal, g).mul(hand);
    const groove_turn = program.vec2("groove_turn"); // cosine and sine
    const world_grating = in_probe(program, g.mul(groove_turn.x).add(h.mul(groove_turn.y)) as Vec3);
    const passed = varying(vec4(world_grating, hand)) as Vec4;
    const channel = program.text("ROWLAND_GROOVE_UV");
    return {
        eye: vec3(0),
        world_position: in_probe(program, cameraWorldMatrix.mul(vec4(to_eye(), 0)).xyz as Vec3).negate() as Vec3,
        world_normal: varying(in_probe(program, world_normal)) as Vec3,
        world_grating: passed.xyz,
        groove_uv: channel ? (uv(channel === "uv" ? 0 : 1) as Vec2) : undefined,
        groove_hand: passed.w,
    };
}

export type Surface = ReturnType<typeof surface>;

/** Call it, as its functions, where statements are added to a fragment's graph. */
export function surface(program: Program, geometry: BufferGeometry, vertex: PosedVertex) {
    const groove = grooves(program, pass_grooves(program, geometry, vertex));
    const colours = kernel(program, groove);
    const { cover_transmittance } = groove;
    const { groove_factor, kernel_to_working, pitch_kernel_value } = colours;
    const key_lights = key_light_windows(program, groove, colours);
    const planar = program.has("ROWLAND_PLANAR") ? planar_map(program) : undefined;
    const table = program.has("ROWLAND_ARC") ? arc(program, vertex) : undefined;

    // prepare_grooves()
    const lit_view = groove.groove_view();
    const lit_sum = vec3(0).toVar(); // diffracted radiance of three's lights
    const lit_parts = lit_view.map && (groove.groove_parts(lit_view.map).toVar() as Int); // parts of a pixel whose grooves vary

    function lit_part(part: Int): GrooveView {
        const view = groove.groove_part(lit_view, lit_parts!, part);
        If(view.pitch.lessThanEqual(0), () => {
            view.direction.z.assign(0); // no grating: as if seen from below
        });
        return view;
    }

    const coverage_of = ({ map }: GrooveView): Float => map!.coverage.div(float(lit_parts!));

    /** Calls `shade` for each part. */
    function for_parts(shade: (view: GrooveView) => void): void {
        loop("groove_part", 0, lit_parts!, (part) => shade(lit_part(part)));
    }

    /** `factor` times the radiance is added to `sum`. */
    function add_lamp_radiance(sum: Vec3, view: GrooveView, u: PixelU, s: Vec3, irradiance: Vec3, factor?: Float): void {
        If(view.direction.z.greaterThan(0), () => {
            const above = max(dot(s, view.axes[2]), 0).toVar();
            const sum_h = dot(s, view.axes[1]).add(view.direction.y).toVar();
            const factor_h = groove_factor(sum_h).mul(above.mul(0.5).mul(cover_transmittance(above)));
            const deviation = deviation_of(u).toVar();
            const value = kernel_to_working(factor_h.mul(pitch_kernel_value(u.mean, view.direction.x, deviation, irradiance, view.pitch)));
            sum.addAssign(factor ? value.mul(factor) : value);
        });
    }

    /** Adds one of three's lights. `s`: toward it, in the probe; `irradiance`: on a surface that faces it. */
    function add_lamp(s: Vec3, irradiance: Vec3): void {
        if (!lit_view.map) return add_lamp_radiance(lit_sum, lit_view, groove.pixel_u_of(lit_view, s), s, irradiance);
        const mesh = groove.mesh_u_of(lit_view.map, s);
        for_parts((view) =>
            add_lamp_radiance(lit_sum, view, groove.turned_pixel_u(view.map!, mesh), s, irradiance, coverage_of(view)));
    }

    function add_probe_radiance(total: Vec3, view: GrooveView, factor?: Float): void {
        If(view.direction.z.greaterThan(0), () => {
            const sum = vec3(0).toVar();
            if (planar) sum.addAssign(planar.map_radiance(view.direction, view.axes[0], view.pitch));
            if (table) sum.addAssign(table.arc_radiance(view));
            sum.addAssign(key_lights.key_lights_at_pixel(view));
            const light_scale = program.float("light_scale"); // of the probe
            total.addAssign(sum.mul(factor ? light_scale.mul(factor) : light_scale));
        });
    }

    /** `base`: what the layer under the grooves reflects; `mirrored`: the environment in the mirror direction. */
    function grating_surface(base: Vec3, mirrored: Vec3): Vec3 {
        const diffracted = lit_sum;
        if (lit_view.map) for_parts((view) => add_probe_radiance(diffracted, view, coverage_of(view)));
        else add_probe_radiance(diffracted, lit_view);
        const passed = cover_transmittance(abs(lit_view.direction.z)).toVar();
        if (program.has("ROWLAND_DIFFRACTION_ONLY")) return passed.mul(diffracted);
        const coverage = lit_view.map ? lit_view.map.coverage : float(1); // the layer has the rest of the pixel for itself
        const mirror_weight = program.vec3("mirror_weight").mul(coverage);
        const base_weight = mix(vec3(1), program.vec3("base_weight"), coverage);
        const mirror = program.has("COVER")
            ? vec3(float(1).sub(passed)).add(mirror_weight.mul(passed.mul(passed))) : mirror_weight;
        return passed.mul(base.mul(base_weight).add(diffracted)).add(mirror.mul(mirrored));
    }

    return { add_lamp, grating_surface };
}
