import { FilmPlugin, GratingPlugin } from "../gltf_plugin.js";
import { FilmNodeMaterial } from "./film_material.js";
import { GratingNodeMaterial } from "./material.js";

/** The plug-in of GLTFLoader for ROWLAND_materials_diffraction: loader.register((parser) => new GratingExtension(parser, rowland)). */
export class GratingExtension extends GratingPlugin {
    protected readonly type = GratingNodeMaterial;
}

/** That for KHR_materials_iridescence by exact films. */
export class FilmExtension extends FilmPlugin {
    protected readonly type = FilmNodeMaterial;
}
