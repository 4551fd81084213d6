import {
    BufferGeometry, Float32BufferAttribute, Matrix3, Vector3, Vector4, type BufferAttribute, type Camera, type Intersection,
    type Mesh, type Object3D,
} from "three";

/** Which way g, across the grooves, points on a mesh: along its tangents, or away from its origin as on a disc. */
export type Grooves = "tangent" | "radial";

export function groovesOf(geometry: BufferGeometry): Grooves {
    return geometry.getAttribute("tangent") ? "tangent" : "radial";
}

/** The normal that all vertices have, to 1e-3; null for curved meshes. */
export function flatNormal(geometry: BufferGeometry): Vector3 | null {
    const normals = geometry.getAttribute("normal");
    if (!normals || normals.count === 0) return null;
    const first = new Vector3().fromBufferAttribute(normals, 0).normalize();
    const other = new Vector3();
    for (let i = 1; i < normals.count; ++i)
        if (other.fromBufferAttribute(normals, i).normalize().distanceTo(first) > 1e-3) return null;
    return first;
}

export function worldNormal(normal: Vector3, object: Object3D): Vector3 {
    return normal.clone().applyMatrix3(new Matrix3().getNormalMatrix(object.matrixWorld)).normalize();
}

/**
 * Normals and grating vectors of all vertices in the world, as src/glsl/surface.vert.glsl computes them. `turnOf`: radians
 * from the tangent toward the bitangent at a vertex.
 */
export function worldFrames(geometry: BufferGeometry, object: Object3D, grooves: Grooves, turnOf: (vertex: number) => number) {
    const count = geometry.getAttribute("position").count;
    const normals = new Float32Array(3 * count);
    const gratings = new Float32Array(3 * count);
    const toWorld = new Matrix3().setFromMatrix4(object.matrixWorld);
    const normalToWorld = new Matrix3().getNormalMatrix(object.matrixWorld);
    const tangents = geometry.getAttribute("tangent");
    const mirroring = toWorld.determinant() < 0 ? -1 : 1; // inverts the cross product
    const [p, n, g, h] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    for (let i = 0; i < count; ++i) {
        n.fromBufferAttribute(geometry.getAttribute("normal"), i);
        if (grooves === "radial") {
            p.fromBufferAttribute(geometry.getAttribute("position"), i);
            g.copy(p).addScaledVector(n, -p.dot(n));
        } else {
            g.fromBufferAttribute(tangents, i);
        }
        n.applyMatrix3(normalToWorld).normalize();
        g.applyMatrix3(toWorld);
        const turn = turnOf(i);
        h.crossVectors(n, g).multiplyScalar(mirroring * Math.sin(turn) * (tangents ? tangents.getW(i) : 1));
        g.multiplyScalar(Math.cos(turn)).add(h);
        g.addScaledVector(n, -g.dot(n)).normalize();
        n.toArray(normals, 3 * i);
        g.toArray(gratings, 3 * i);
    }
    return { normals, gratings };
}

/** Unit vectors in the world at a point of a mesh: toward the eye, the normal, the grating vector. */
export function pointFrame({ object, point, face, barycoord }: Intersection<Mesh>, grooves: Grooves, turn: number, camera: Camera): Float32Array {
    const vertex = new BufferGeometry();
    for (const [name, size] of [["position", 3], ["normal", 3], ["tangent", 4]] as const) {
        const attribute = object.geometry.getAttribute(name) as BufferAttribute | undefined;
        if (!attribute) continue;
        const sum = new Vector4(0, 0, 0, 0);
        for (const [index, weight] of [[face!.a, barycoord!.x], [face!.b, barycoord!.y], [face!.c, barycoord!.z]])
            sum.addScaledVector(new Vector4().fromBufferAttribute(attribute, index), weight);
        vertex.setAttribute(name, new Float32BufferAttribute(sum.toArray().slice(0, size), size));
    }
    const { normals, gratings } = worldFrames(vertex, object, grooves, () => turn);
    const view = new Vector3().setFromMatrixPosition(camera.matrixWorld).sub(point).normalize();
    return Float32Array.of(...view.toArray(), ...normals, ...gratings);
}
