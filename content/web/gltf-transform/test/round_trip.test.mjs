import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename } from "node:path";
import test from "node:test";
import { Document } from "@gltf-transform/core";
import { dedup, draco, prune } from "@gltf-transform/functions";
import { RowlandMaterialsDiffraction, withGratings } from "../dist/index.js";
import { cabinet, digest, gratings, io, NAME, quiet, samples } from "./samples.mjs";

const opened = async (path) => (await io.read(path)).setLogger(quiet);
const written = async (document) => gratings(await io.writeJSON(document, { basename: "written" }));
const tangents = (document) => document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives())
    .filter((primitive) => primitive.getMaterial()?.getExtension(NAME))
    .map((primitive) => primitive.getAttribute("TANGENT")?.getArray());

test("there are samples", () => assert.ok(samples.length >= 4));

for (const path of [...samples, cabinet])
    test(`${basename(path)}: gratings, textures, samplers and transforms are the same after reading and writing`, async () => {
        const before = gratings(await io.readAsJSON(path));
        assert.ok(Object.keys(before).length > 0);
        assert.deepEqual(await written(await opened(path)), before);
    });

test("prune and dedup keep gratings, their tangents and the grooves' texture", async () => {
    for (const path of samples) {
        const before = gratings(await io.readAsJSON(path));
        const document = await opened(path);
        await document.transform(dedup(), withGratings(prune()));
        assert.deepEqual(await written(document), before, path);
        assert.ok(tangents(document).length > 0 && tangents(document).every((array) => array), path);
        const semantics = document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives()).flatMap((one) => one.listSemantics());
        assert.ok(!semantics.some((name) => name.startsWith("_")), "no attribute of the transform is left");
    }
});

test("prune removes the grooves' texture with the last material that has it", async () => {
    const document = await opened(samples.find((path) => path.endsWith("foil.glb")));
    const [mesh] = document.getRoot().listMeshes();
    for (const primitive of mesh.listPrimitives()) primitive.setMaterial(null);
    await document.transform(withGratings(prune()));
    assert.equal(document.getRoot().listTextures().length, 0);
});

test("dedup merges gratings that are the same, and no others", async () => {
    const document = await opened(samples.find((path) => path.endsWith("foil.glb")));
    const [mesh] = document.getRoot().listMeshes();
    const [primitive] = mesh.listPrimitives();
    const another = (change) => {
        const material = primitive.getMaterial().clone();
        const grating = material.getExtension(NAME).clone();
        change(grating);
        mesh.addPrimitive(primitive.clone().setMaterial(material.setExtension(NAME, grating)));
    };
    another(() => {});
    another((grating) => grating.setGrooveRotation(1));
    another((grating) => grating.setGrating({ ...grating.getGrating(), pitch_nm: 900 }));
    await document.transform(dedup());
    assert.equal(document.getRoot().listMaterials().length, 3);
});

test("a compressed mesh keeps its tangents", async () => {
    const document = await opened(samples.find((path) => path.endsWith("cd.gltf")));
    const [before] = tangents(document);
    await document.transform(draco({ quantizeGeneric: 12, method: "sequential" }));
    const [after] = tangents(await io.readBinary(await io.writeBinary(document)));
    assert.equal(after.length, before.length);
    after.forEach((x, i) => assert.ok(Math.abs(x - before[i]) < 1 / 2 ** 11, `${x} for ${before[i]}`));
});

test("setters change what they name", async () => {
    const document = await opened(samples.find((path) => path.endsWith("foil.glb")));
    const [material] = document.getRoot().listMaterials();
    const grating = material.getExtension(NAME);
    const before = gratings(await io.writeJSON(document, { basename: "written" })).foil;
    const image = new Uint8Array([1, 2, 3]);
    grating.setGrating({ pitch_nm: 740, profile: { type: "slit", width_nm: 300 } }).setMember("metal", undefined)
        .setGrooveRotation(0.5).setSparkle(true).setGrooveTexture(document.createTexture().setMimeType("image/png").setImage(image));
    grating.getGrooveTextureInfo().setTexCoord(1);
    const { metal: _, ...others } = before;
    assert.deepEqual((await written(document)).foil, { ...others, grating: { pitch_nm: 740, profile: { type: "slit", width_nm: 300 } },
        grooveRotation: 0.5, grooveTexture: { ...before.grooveTexture, texCoord: 1, sparkle: true, image: digest(image) } });
    grating.setGrooveTexture(null);
    assert.equal((await written(document)).foil.grooveTexture, undefined);
    material.setExtension(NAME, null);
    assert.deepEqual(await written(document), {});
});

test("what getters give is a copy", () => {
    const grating = new Document().createExtension(RowlandMaterialsDiffraction).createDiffraction();
    const given = { pitch_nm: 740, profile: { type: "blazed", depth_nm: 250 } };
    grating.setGrating(given);
    given.pitch_nm = 1;
    grating.getGrating().pitch_nm = 2;
    assert.equal(grating.getGrating().pitch_nm, 740);
    assert.equal(grating.clone().setMember("metal", "Au").getMember("metal"), "Au");
    assert.equal(grating.getMember("metal"), undefined);
});

test("members of later versions, extras and extensions are kept", async () => {
    const path = samples.find((one) => one.endsWith("foil.glb"));
    const source = await io.readAsJSON(path);
    const object = source.json.materials[0].extensions[NAME];
    Object.assign(object, { coating: { of: ["later", 1] }, extras: { made: "by hand" }, extensions: { TEST_more: { a: 1 } } });
    Object.assign(object.grooveTexture, { facets: 3, extras: { b: 2 }, extensions: { KHR_texture_transform: { scale: [2, 3] } } });
    source.json.extensionsUsed.push("KHR_texture_transform");
    const before = gratings(source).foil;
    const document = (await io.readJSON(source)).setLogger(quiet);
    document.getRoot().listMaterials()[0].getExtension(NAME).setGrooveRotation(1);
    await document.transform(dedup(), withGratings(prune()));
    assert.deepEqual((await written(document)).foil, { ...before, grooveRotation: 1 });
});

test("a texture without an image is refused", async () => {
    const source = await io.readAsJSON(samples.find((one) => one.endsWith("foil.glb")));
    source.json.materials[0].extensions[NAME].grooveTexture.index = 7;
    await assert.rejects(io.readJSON(source), /grooveTexture\.index 7/);
});

test("the README's lines run", async () => {
    const [, lines] = /```js\n(.*?)```/s.exec(readFileSync(new URL("../README.md", import.meta.url), "utf8"));
    const folder = mkdtempSync(new URL("../readme-", import.meta.url).pathname); // within the package, which its lines import
    try {
        writeFileSync(folder + "/readme.mjs", lines.replace("scene.glb", samples.find((path) => path.endsWith("foil.glb"))));
        execFileSync(process.execPath, ["readme.mjs"], { cwd: folder, stdio: ["ignore", "ignore", "pipe"] });
        const before = gratings(await io.readAsJSON(samples.find((path) => path.endsWith("foil.glb")))).foil;
        const after = gratings(await io.readAsJSON(folder + "/smaller.glb")).foil;
        assert.deepEqual(after, { ...before, cover: { ior: 1.49 }, grooveRotation: Math.PI / 2 });
    } finally {
        rmSync(folder, { recursive: true });
    }
});
