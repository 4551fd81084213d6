import type { Material } from "@babylonjs/core/Materials/material.js";
import type { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import "@babylonjs/loaders/glTF/2.0/Extensions/KHR_materials_iridescence.js";
import type { IMaterial, ITextureInfo } from "@babylonjs/loaders/glTF/2.0/glTFLoaderInterfaces.js";
import type { GLTFLoader } from "@babylonjs/loaders/glTF/2.0/glTFLoader.js";
import type { IGLTFLoaderExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtension.js";
import { registerGLTFExtension, unregisterGLTFExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js";
import { FilmPlugin } from "./film.js";
import { GratingPlugin } from "./grating.js";
import { filmOf, type Iridescence } from "./shared/film_table.js";
import type { Rowland } from "./shared/rowland.js";

const GRATING = "ROWLAND_materials_diffraction";
const FILM = "ROWLAND_films"; // of this loader's extensions, beside Babylon's own for KHR_materials_iridescence

abstract class Extension implements IGLTFLoaderExtension {
    abstract readonly name: string;
    enabled = true;
    constructor(protected readonly loader: GLTFLoader, protected readonly rowland: Rowland) {}
    dispose(): void {}
}

class GratingExtension extends Extension {
    readonly name = GRATING;

    /** Gives each mesh a material, so that flat ones keep their maps beside curved ones. */
    _loadMaterialAsync(context: string, material: IMaterial, _: Mesh | null, drawMode: number, assign: (material: Material) => void) {
        const grating = material.extensions?.[GRATING] as { grooveTexture?: ITextureInfo } | undefined;
        return grating ? this.load(context, material, drawMode, assign, grating) : null;
    }

    private async load(context: string, material: IMaterial, drawMode: number, assign: (material: Material) => void,
        grating: { grooveTexture?: ITextureInfo }): Promise<Material> {
        const { loader, rowland } = this;
        const own = loader.createMaterial(context, material, drawMode) as PBRMaterial;
        const plugin = new GratingPlugin(own, {});
        assign(own);
        loader.parent.onMaterialLoadedObservable.notifyObservers(own);
        const info = grating.grooveTexture && { ...grating.grooveTexture, nonColorData: true };
        const [grooveTexture] = await Promise.all([info && loader.loadTextureInfoAsync(`${context}/extensions/${GRATING}/grooveTexture`, info),
            loader.loadMaterialPropertiesAsync(context, material, own)]);
        plugin.state.configure({ rowland, grating, grooveTexture });
        return own;
    }
}

class FilmExtension extends Extension {
    readonly name = FILM;
    readonly order = 1; // before Babylon's, whose textures it awaits

    loadMaterialPropertiesAsync(context: string, material: IMaterial, own: Material): Promise<void> | null {
        const iridescence = material.extensions?.KHR_materials_iridescence as Iridescence | undefined;
        if (!iridescence || material.extensions?.[GRATING]) return null;
        for (const info of [iridescence.iridescenceTexture, iridescence.iridescenceThicknessTexture])
            if (info) Object.assign(info, { nonColorData: true }); // Babylon's loader takes them for colours in sRGB
        const plugin = new FilmPlugin(own as PBRMaterial, {});
        return this.loader.loadMaterialPropertiesAsync(context, material, own)
            .then(() => plugin.bake(this.rowland, filmOf(iridescence, material.pbrMetallicRoughness?.roughnessFactor ?? 1)));
    }
}

function register(name: string, isGltf: boolean, Type: new (...of: [GLTFLoader, Rowland]) => Extension, rowland: Rowland): void {
    unregisterGLTFExtension(name);
    registerGLTFExtension(name, isGltf, (loader) => new Type(loader as GLTFLoader, rowland));
}

/** Loads ROWLAND_materials_diffraction from now on, with `rowland`'s workers. */
export const registerGratings = (rowland: Rowland): void => register(GRATING, true, GratingExtension, rowland);

/** Draws KHR_materials_iridescence by exact films from now on. The extension's extras may name the base. */
export const registerFilms = (rowland: Rowland): void => register(FILM, false, FilmExtension, rowland);
