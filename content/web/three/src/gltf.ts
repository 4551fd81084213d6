import type { MeshPhysicalMaterial } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { FilmMaterial, type FilmParameters } from "./film_material.js";
import { askFirst, GratingPlugin } from "./gltf_plugin.js";
import { GratingMaterial } from "./material.js";
import type { Rowland } from "./rowland.js";

/** The plug-in of GLTFLoader for ROWLAND_materials_diffraction: loader.register((parser) => new GratingExtension(parser, rowland)). */
export class GratingExtension extends GratingPlugin {
    protected readonly type = GratingMaterial;
}

interface Iridescence {
    readonly iridescenceFactor?: number;
    readonly iridescenceTexture?: { index: number };
    readonly iridescenceIor?: number;
    readonly iridescenceThicknessMinimum?: number;
    readonly iridescenceThicknessMaximum?: number;
    readonly iridescenceThicknessTexture?: { index: number };
    readonly extras?: { readonly metal?: string; readonly base?: object; readonly illuminant?: string };
}

/**
 * The plug-in of GLTFLoader for KHR_materials_iridescence by exact films:
 * loader.register((parser) => new FilmExtension(parser, rowland)). The extension's extras may name the base.
 */
export class FilmExtension implements GLTFLoaderPlugin {
    readonly name = "KHR_materials_iridescence";

    constructor(private readonly parser: GLTFParser, private readonly rowland: Rowland) {}

    beforeRoot(): null {
        askFirst(this.parser, this);
        return null;
    }

    private material(index: number) {
        return this.parser.json.materials[index];
    }

    getMaterialType(index: number): typeof MeshPhysicalMaterial | null {
        return this.material(index).extensions?.[this.name] ? (FilmMaterial as unknown as typeof MeshPhysicalMaterial) : null;
    }

    async extendMaterialParams(index: number, parameters: FilmParameters): Promise<void> {
        const { extensions, pbrMetallicRoughness = {} } = this.material(index);
        const iridescence = extensions?.[this.name] as Iridescence | undefined;
        if (!iridescence) return;
        const { iridescenceIor: ior = 1.3, iridescenceThicknessMinimum: least = 100, iridescenceThicknessMaximum: most = 400, extras = {} } = iridescence;
        parameters.iridescence = iridescence.iridescenceFactor ?? 0;
        parameters.iridescenceThicknessRange = [least, most];
        if (iridescence.iridescenceTexture) await this.parser.assignTexture(parameters, "iridescenceMap", iridescence.iridescenceTexture);
        if (iridescence.iridescenceThicknessTexture)
            await this.parser.assignTexture(parameters, "iridescenceThicknessMap", iridescence.iridescenceThicknessTexture);
        const { metal, base, illuminant } = extras;
        parameters.film = { film: { ior, thickness_nm: most }, metal, base, illuminant, roughness: pbrMetallicRoughness.roughnessFactor ?? 1 };
        parameters.rowland = this.rowland;
    }
}
