import type { Document, Primitive, Property, Transform } from "@gltf-transform/core";
import { NAME } from "./diffraction.js";

const TANGENT = "TANGENT";
/** Transforms keep an application's attributes, whose names begin with an underscore. */
const KEPT = "_ROWLAND_TANGENT";

function rename(primitives: Primitive[], from: string, to: string): void {
    for (const primitive of primitives) {
        const tangents = primitive.getAttribute(from);
        if (tangents) primitive.setAttribute(from, null).setAttribute(to, tangents);
    }
}

/**
 * prune() as gratings need it: `document.transform(withGratings(prune()))`. Alone it removes the tangents of materials
 * without a normal map, which say where a grating's grooves lie, and keeps the groove textures of materials that it
 * removes. For transforms that do not turn meshes.
 */
export function withGratings(transform: Transform): Transform {
    return async (document: Document, context) => {
        const root = document.getRoot();
        const graph = document.getGraph();
        const primitives = () => root.listMeshes().flatMap((mesh) => mesh.listPrimitives())
            .filter((primitive) => primitive.getMaterial()?.getExtension(NAME));
        const gratings = new Map<Property, Property | null>(
            root.listMaterials().map((material) => [material, material.getExtension(NAME)]));
        const onDispose = (event: unknown) => {
            const grating = gratings.get((event as { target: Property }).target);
            if (grating && grating.listParents().length === 0) grating.dispose();
        };
        rename(primitives(), TANGENT, KEPT);
        graph.addEventListener("node:dispose", onDispose);
        try {
            await transform(document, context);
        } finally {
            graph.removeEventListener("node:dispose", onDispose);
            rename(primitives(), KEPT, TANGENT);
        }
    };
}
