import { FilmMaterial } from "./film_material.js";
import { FilmPlugin, GratingPlugin } from "./gltf_plugin.js";
import { GratingMaterial } from "./material.js";

/** The plug-in of GLTFLoader for ROWLAND_materials_diffraction: loader.register((parser) => new GratingExtension(parser, rowland)). */
export class GratingExtension extends GratingPlugin {
    protected readonly type = GratingMaterial;
}

/**
 * The plug-in of GLTFLoader for KHR_materials_iridescence by exact films:
 * loader.register((parser) => new FilmExtension(parser, rowland)). The extension's extras may name the base.
 */
export class FilmExtension extends FilmPlugin {
    protected readonly type = FilmMaterial;
}
