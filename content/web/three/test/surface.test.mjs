// What a mesh costs in each frame: instances that stay are not walked.
import assert from "node:assert/strict";
import test from "node:test";
import { InstancedMesh, Matrix3, Matrix4, PlaneGeometry, SphereGeometry } from "three";
import { Surface } from "../dist/surface.js";

class CountedMesh extends InstancedMesh {
    reads = 0;
    getMatrixAt(...of) {
        this.reads += 1;
        super.getMatrixAt(...of);
    }
}

for (const [representation, geometry] of [["planar", new PlaneGeometry()], ["arc", new SphereGeometry(1, 4, 3)]])
    test(`instances are read again when they, the mesh or the probe turn: ${representation}`, () => {
        const mesh = new CountedMesh(geometry, undefined, 3);
        const surface = new Surface(mesh, geometry);
        const probe = new Matrix3();
        const settled = () => {
            surface.see(probe);
            const before = mesh.reads;
            surface.see(probe);
            const answer = surface.isSettled(1, representation);
            surface.isSettled(1, representation);
            return { answer, reads: mesh.reads - before };
        };
        assert.equal(surface.see(probe), true);
        surface.ask(1, representation);
        surface.see(probe);
        surface.isSettled(1, representation);
        const turnedInstances = () => {
            for (let i = 0; i < 3; ++i) mesh.setMatrixAt(i, new Matrix4().makeRotationX(0.5));
            mesh.instanceMatrix.needsUpdate = true;
        };
        for (const turn of [turnedInstances, () => mesh.matrixWorld.makeRotationX(1), () => probe.set(0, 1, 0, -1, 0, 0, 0, 0, 1).transpose()]) {
            mesh.reads = 0;
            assert.deepEqual(surface.isSettled(1, representation), true);
            assert.equal(mesh.reads, 0);
            turn();
            assert.equal(settled().answer, false);
            assert.ok(mesh.reads >= 3);
            surface.ask(1, representation);
            surface.see(probe);
            assert.equal(surface.isSettled(1, representation), true);
        }
        assert.deepEqual(settled(), { answer: true, reads: 0 });
    });
