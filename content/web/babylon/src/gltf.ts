import type { Material } from "@babylonjs/core/Materials/material.js";
import type { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import type { IMaterial } from "@babylonjs/loaders/glTF/2.0/glTFLoaderInterfaces.js";
import type { GLTFLoader } from "@babylonjs/loaders/glTF/2.0/glTFLoader.js";
import type { IGLTFLoaderExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtension.js";
import { registerGLTFExtension, unregisterGLTFExtension } from "@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js";
import type { Rowland } from "./shared/rowland.js";
import { GratingPlugin } from "./plugin.js";

const NAME = "ROWLAND_materials_diffraction";

class GratingExtension implements IGLTFLoaderExtension {
    readonly name = NAME;
    enabled: boolean;

    constructor(private readonly loader: GLTFLoader, private readonly rowland: Rowland) {
        this.enabled = loader.isExtensionUsed(NAME);
    }

    dispose(): void {}

    /** Gives each mesh a material, so that flat ones keep their maps beside curved ones. */
    _loadMaterialAsync(context: string, material: IMaterial, _: Mesh | null, drawMode: number, assign: (material: Material) => void) {
        const grating = material.extensions?.[NAME] as { grooveTexture?: object } | undefined;
        if (!grating) return null;
        if (grating.grooveTexture)
            this.rowland.onError(new Error(`${context}: grooveTexture is not drawn by @rowland/babylon; the grooves are drawn without it`));
        const own = this.loader.createMaterial(context, material, drawMode) as PBRMaterial;
        new GratingPlugin(own, { rowland: this.rowland, grating });
        assign(own);
        this.loader.parent.onMaterialLoadedObservable.notifyObservers(own);
        return this.loader.loadMaterialPropertiesAsync(context, material, own).then(() => own as Material);
    }
}

/** Loads ROWLAND_materials_diffraction from now on, with `rowland`'s workers. */
export function registerGratings(rowland: Rowland): void {
    unregisterGLTFExtension(NAME);
    registerGLTFExtension(NAME, true, (loader) => new GratingExtension(loader as GLTFLoader, rowland));
}
