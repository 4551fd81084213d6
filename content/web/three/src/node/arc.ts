// modules/diffraction/representations/arc/arc.glsl and shaders/view_table.glsl in TSL: the pixel's part of arc_table.h, a
// sum over the ranks of the products from the vertices.
import { atan, dot, float, int, length, log, max, min, select, varying, vec2, vec3, vertexIndex } from "three/tsl";
import type { GrooveView } from "./grooves.js";
import type { PosedVertex } from "./pose.js";
import type { Float, Int, Program, Vec2, Vec3, Vec4 } from "./program.js";

const [SPHERICAL, PARABOLIC] = [0, 1];

export function arc(program: Program, { isBatched, instance }: PosedVertex) {
    const layers = program.number("LAYERS");
    const first = !isBatched ? float(instance).mul(program.float("products_stride"))
        : program.knows("products_first") ? program.stored_vec4("products_first", instance).x : float(0);
    const arc_products: Vec4[] = Array.from({ length: 3 * layers }, (_, i) =>
        varying(program.stored_vec4("vertex_products", int(first).add(int(vertexIndex)).mul(3 * layers).add(i) as Int)));

    /**
     * Texture coordinates of a tangent-frame view in a table, as bake/view_mapping.h lays views out. Views below the horizon
     * are clamped to it: such vertices are visible only in triangles that cross the silhouette.
     */
    function table_coordinates(view: Vec3): Vec2 {
        const [columns, rows] = [program.number("TABLE_COLUMNS"), program.number("TABLE_ROWS")];
        const half_texel = vec2(0.5 / columns, 0.5 / rows);
        const mapping = program.number("VIEW_MAPPING");
        if (mapping === SPHERICAL) {
            const HALF_PI = Math.PI / 2;
            const theta = min(atan(length(view.xy), view.z), HALF_PI);
            const phi = select(view.x.equal(0).and(view.y.equal(0)), float(0), atan(view.y, view.x)) as Float;
            return vec2(phi.div(4 * HALF_PI), theta.div(HALF_PI).mul(1 - 1 / rows)).add(half_texel);
        }
        if (mapping === PARABOLIC) {
            const p = view.xy.div(max(view.z, 0).add(1));
            return p.mul(vec2(0.5).sub(half_texel)).add(0.5);
        }
        return vec2(view.x.mul(0.5 - 0.5 / columns).add(0.5), 0.5);
    }

    /** Scale and bias of each layer of the table are one after the other in table_range. */
    function table_entries(coordinates: Vec2, layer: number): Vec4 {
        const stored = program.textureLayer("packed_table", coordinates, layer);
        const [scale, bias] = [2 * layer, 2 * layer + 1].map((i) => program.stored_vec4("table_range", int(i)));
        return stored.mul(scale).add(bias);
    }

    function arc_radiance(view: GrooveView): Vec3 {
        const v_g = view.map ? view.map.fade.mul(view.direction.x) : view.direction.x;
        const coordinates = table_coordinates(vec3(v_g, view.direction.yz).toVar()).toVar();
        if (program.has("PITCH_AXIS")) {
            // From the logarithm of the pitch factor to the table's second coordinate.
            const pitch_scale_bias = program.vec2("pitch_scale_bias");
            coordinates.y.assign(log(view.pitch).mul(pitch_scale_bias.x).add(pitch_scale_bias.y));
        }
        const sum = vec3(0).toVar();
        for (let j = 0; j < layers; ++j) {
            const weights = table_entries(coordinates, j).toVar();
            const [red, green, blue] = arc_products.slice(3 * j);
            sum.addAssign(vec3(dot(weights, red), dot(weights, green), dot(weights, blue)));
        }
        return sum;
    }

    return { arc_radiance };
}
