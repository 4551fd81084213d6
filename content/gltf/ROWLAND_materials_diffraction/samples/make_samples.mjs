// Writes the samples beside this file: node make_samples.mjs PACKAGE, @rowland/gltf-transform built. The gratings are those
// of content/materials and of the demo's cabinet; the discs, the card and its texture are drawn here.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";
import { crc32, deflateSync } from "node:zlib";

const here = fileURLToPath(new URL(".", import.meta.url));
const content = here + "../../../";
const [from] = process.argv.slice(2);
if (!from) throw new Error("expected: node make_samples.mjs PACKAGE");
const of = createRequire(pathToFileURL(from + "/package.json"));
const { Document, Logger, NodeIO, TextureInfo } = of("@gltf-transform/core");
const { ALL_EXTENSIONS, KHRDracoMeshCompression } = of("@gltf-transform/extensions");
const { prune, unpartition } = of("@gltf-transform/functions");
const draco = of("draco3dgltf");
const { RowlandMaterialsDiffraction, withGratings } = await import(pathToFileURL(from + "/dist/index.js"));

const NAME = "ROWLAND_materials_diffraction";
const ASSET = { generator: "Rowland", copyright: "2026 The Rowland authors, MIT licence" };
const TILTED = [Math.sin(Math.PI / 6), 0, 0, Math.cos(Math.PI / 6)]; // by 60 degrees, toward a viewer on +Z
const io = new NodeIO().setLogger(new Logger(Logger.Verbosity.ERROR))
    .registerExtensions([...ALL_EXTENSIONS, RowlandMaterialsDiffraction]).registerDependencies({
        "draco3d.decoder": await draco.createDecoderModule(), "draco3d.encoder": await draco.createEncoderModule(),
    });

/** Of a material file: without the layer beneath, which is the glTF's, and without how a program of ours draws it. */
function fileMembers(name) {
    const { base: _, quality: __, ...members } = JSON.parse(readFileSync(`${content}materials/${name}.json`));
    return members;
}

/** One mesh of a material that is a grating. `mesh`: positions and tangents, of which normals are +Y. */
function document(name, { positions, tangents, uvs, indices }, { members, colour, roughness, metallic = 0 }) {
    const made = new Document().setLogger(new Logger(Logger.Verbosity.ERROR));
    const grating = made.createExtension(RowlandMaterialsDiffraction).createDiffraction().setMembers(members);
    const material = made.createMaterial(name).setBaseColorFactor([...colour, 1]).setRoughnessFactor(roughness)
        .setMetallicFactor(metallic).setExtension(NAME, grating);
    const buffer = made.createBuffer();
    const accessor = (type, array) => made.createAccessor().setType(type).setArray(array).setBuffer(buffer);
    const primitive = made.createPrimitive().setMaterial(material).setIndices(accessor("SCALAR", Uint16Array.from(indices)))
        .setAttribute("POSITION", accessor("VEC3", Float32Array.from(positions)))
        .setAttribute("NORMAL", accessor("VEC3", Float32Array.from(positions, (_, i) => (i % 3 === 1 ? 1 : 0))))
        .setAttribute("TANGENT", accessor("VEC4", Float32Array.from(tangents)));
    if (uvs) primitive.setAttribute("TEXCOORD_0", accessor("VEC2", Float32Array.from(uvs)));
    const node = made.createNode(name).setMesh(made.createMesh(name).addPrimitive(primitive)).setRotation(TILTED);
    made.getRoot().setDefaultScene(made.createScene(name).addChild(node));
    Object.assign(made.getRoot().getAsset(), ASSET);
    return made;
}

/** A flat ring whose tangents point away from the middle: grooves are circles. */
function ring(inner, outer, segments = 128) {
    const [positions, tangents, indices] = [[], [], []];
    for (let i = 0; i <= segments; ++i) {
        const angle = (2 * Math.PI * i) / segments;
        const [x, z] = [Math.cos(angle), -Math.sin(angle)];
        for (const radius of [inner, outer]) {
            positions.push(radius * x, 0, radius * z);
            tangents.push(x, 0, z, 1);
        }
        if (i < segments) indices.push(...[0, 1, 2, 2, 1, 3].map((corner) => 2 * i + corner));
    }
    return { positions, tangents, indices };
}

/** A flat card whose tangents point along u. */
function card(width, depth) {
    const corners = [[0, 0], [1, 0], [0, 1], [1, 1]];
    return {
        positions: corners.flatMap(([u, v]) => [(u - 0.5) * width, 0, (v - 0.5) * depth]),
        tangents: corners.flatMap(() => [1, 0, 0, 1]),
        uvs: corners.flat(),
        indices: [0, 2, 1, 1, 2, 3],
    };
}

/** A PNG of RGB bytes. */
function png(width, height, rgb) {
    const chunk = (type, data) => {
        const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
        const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
        length.writeUInt32BE(data.length);
        sum.writeUInt32BE(crc32(body));
        return Buffer.concat([length, body, sum]);
    };
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2], 8); // eight bits of R, G and B
    const rows = Array.from({ length: height }, (_, row) =>
        Buffer.concat([Buffer.of(0), rgb.subarray(3 * width * row, 3 * width * (row + 1))]));
    return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), chunk("IHDR", header),
        chunk("IDAT", deflateSync(Buffer.concat(rows))), chunk("IEND", Buffer.alloc(0))]);
}

/** Pinwheels: the sectors of a cell have grooves of eight directions, cells have two pitches, and lines between are bare. */
function pinwheels(columns, rows, cell) {
    const [width, height] = [columns * cell, rows * cell];
    const rgb = Buffer.alloc(3 * width * height);
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) {
            const [column, row] = [Math.floor(x / cell), Math.floor(y / cell)];
            const [u, v] = [x % cell + 0.5 - cell / 2, y % cell + 0.5 - cell / 2];
            const sector = Math.floor(4 * (Math.atan2(v, u) / Math.PI + 2)) % 8;
            const bare = Math.max(Math.abs(u), Math.abs(v)) > cell / 2 - 1;
            const rotation = sector / 8; // over pi
            const pitch = (column + row) % 2 === 0 ? 1 : 1.25; // over pitch_nm
            rgb.set([Math.round(255 * rotation), bare ? 0 : Math.round((255 * pitch) / 2), 0], 3 * (width * y + x));
        }
    return png(width, height, rgb);
}

/** The demo's beetle: its wing cases, which are curved gratings, and its body. */
async function beetle() {
    const made = await io.readBinary(readFileSync(content + "web/page/cabinet.glb"));
    const root = made.getRoot();
    made.setLogger(new Logger(Logger.Verbosity.ERROR));
    const node = root.listNodes().find((one) => one.getName() === "beetle").setTranslation([0, 0, 0]).setExtras({});
    for (const child of node.listChildren()) if (child.getName() !== "wing cases") node.removeChild(child);
    const [scene] = root.listScenes();
    for (const child of scene.listChildren()) scene.removeChild(child);
    root.setDefaultScene(scene.addChild(node).setName("beetle").setExtras({})).setExtras({});
    for (const used of root.listExtensionsUsed()) if (used.extensionName === "KHR_lights_punctual") used.dispose();
    await made.transform(withGratings(prune()), unpartition());
    const wing = root.listMaterials().find((material) => material.getExtension(NAME));
    wing.setBaseColorFactor([0.011, 0.0085, 0.0075, 1]).setRoughnessFactor(0.24);
    wing.getExtension(NAME).setGrooveRotation(Math.PI / 2) // along the wing case, as the demo has it
        .setMembers({ grating: { pitch_nm: 1250, profile: { type: "slit", width_nm: 250 }, orders: [-1, 1] } });
    root.listExtensionsUsed().find((used) => used.extensionName === KHRDracoMeshCompression.EXTENSION_NAME)
        .setEncoderOptions({ quantizationBits: { POSITION: 11, NORMAL: 8, GENERIC: 8 } });
    Object.assign(root.getAsset(), ASSET);
    return made;
}

const cd = document("CD", ring(0.023, 0.0583),
    { members: fileMembers("cd_pressed"), colour: [0.02, 0.02, 0.02], roughness: 0.3 });
cd.getRoot().listBuffers()[0].setURI("cd.bin");
await io.write(here + "cd.gltf", cd);

const orders = Array.from({ length: 61 }, (_, i) => i - 30);
await io.write(here + "record.glb", document("record", ring(0.0605, 0.1462), {
    members: { grating: { pitch_nm: 60000, profile: { type: "slit", width_nm: 2400 }, orders } }, // the cabinet's
    colour: [0.012, 0.012, 0.013], roughness: 0.28,
}));

const { grating: { groove_lobe: _, ...grating }, ...layers } = fileMembers("holographic_foil"); // with the flat lobe
const foil = document("foil", card(0.08, 0.05),
    { members: { grating, ...layers }, colour: [0.25, 0.25, 0.26], roughness: 0.35, metallic: 1 });
const diffraction = foil.getRoot().listMaterials()[0].getExtension(NAME);
diffraction.setGrooveTexture(foil.createTexture("foil grooves").setImage(pinwheels(8, 5, 16)).setMimeType("image/png"));
diffraction.getGrooveTextureInfo().setMagFilter(TextureInfo.MagFilter.NEAREST).setWrapS(TextureInfo.WrapMode.CLAMP_TO_EDGE)
    .setWrapT(TextureInfo.WrapMode.CLAMP_TO_EDGE);
await io.write(here + "foil.glb", foil);

await io.write(here + "beetle.glb", await beetle());
