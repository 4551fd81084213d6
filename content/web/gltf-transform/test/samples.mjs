// The tree's samples and a program that reads and writes them.
import { createHash } from "node:crypto";
import { existsSync, readdirSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { Logger, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import draco from "draco3dgltf";
import { RowlandMaterialsDiffraction } from "../dist/index.js";

export const NAME = "ROWLAND_materials_diffraction";

/** content/gltf/ROWLAND_materials_diffraction of the source tree that this folder, or a copy of it, lies in. */
export const extensionFolder = (() => {
    for (let folder = fileURLToPath(new URL(".", import.meta.url)); folder !== dirname(folder); folder = dirname(folder))
        if (existsSync(`${folder}/content/gltf/${NAME}`)) return `${folder}/content/gltf/${NAME}/`;
    throw new Error("not within the source tree of Rowland");
})();

export const samples = readdirSync(extensionFolder + "samples").filter((name) => /\.(gltf|glb)$/.test(name))
    .map((name) => extensionFolder + "samples/" + name);
export const cabinet = extensionFolder + "../../scenes/cabinet.glb";

export const quiet = new Logger(Logger.Verbosity.SILENT);
export const io = new NodeIO().setLogger(quiet).registerExtensions([...ALL_EXTENSIONS, RowlandMaterialsDiffraction])
    .registerDependencies({ "draco3d.decoder": await draco.createDecoderModule(), "draco3d.encoder": await draco.createEncoderModule() });

export const digest = (bytes) => createHash("sha256").update(bytes).digest("hex");

/** The document's gratings by the name of their material, each with its texture and its sampler instead of indices. */
export function gratings({ json, resources }) {
    const image = ({ uri, bufferView }) => {
        if (uri) return digest(resources[uri]);
        const { byteOffset = 0, byteLength } = json.bufferViews[bufferView];
        return digest(Object.values(resources)[0].subarray(byteOffset, byteOffset + byteLength));
    };
    const known = (json.materials ?? []).filter(({ extensions }) => extensions?.[NAME]);
    return Object.fromEntries(known.map(({ name, extensions }) => {
        const grating = structuredClone(extensions[NAME]);
        const { index, ...rest } = grating.grooveTexture ?? {};
        if (index === undefined) return [name, grating];
        const { source, sampler } = json.textures[index];
        // The defaults of the specification are written out.
        const sampled = JSON.parse(JSON.stringify({ wrapS: 10497, wrapT: 10497, ...json.samplers?.[sampler] }));
        return [name, { ...grating, grooveTexture: { ...rest, sampled, image: image(json.images[source]) } }];
    }));
}
