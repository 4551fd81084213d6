import { GratingPlugin } from "../gltf_plugin.js";
import { GratingNodeMaterial } from "./material.js";

/** The plug-in of GLTFLoader for ROWLAND_materials_diffraction: loader.register((parser) => new GratingExtension(parser, rowland)). */
export class GratingExtension extends GratingPlugin {
    protected readonly type = GratingNodeMaterial;
}
