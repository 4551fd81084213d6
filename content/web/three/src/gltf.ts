import { MeshPhysicalMaterial, type Mesh } from "three";
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { GratingMaterial, type GratingParameters } from "./material.js";
import type { Rowland } from "./rowland.js";

/** The plug-in of GLTFLoader for ROWLAND_materials_diffraction: loader.register((parser) => new GratingExtension(parser, rowland)). */
export class GratingExtension implements GLTFLoaderPlugin {
    readonly name = "ROWLAND_materials_diffraction";

    constructor(private readonly parser: GLTFParser, private readonly rowland: Rowland) {}

    private grating(material: number): object | undefined {
        return this.parser.json.materials[material].extensions?.[this.name];
    }

    getMaterialType(material: number): typeof MeshPhysicalMaterial | null {
        return this.grating(material) ? (GratingMaterial as unknown as typeof MeshPhysicalMaterial) : null;
    }

    async extendMaterialParams(material: number, parameters: GratingParameters): Promise<void> {
        const grating = this.grating(material);
        if (!grating) return;
        if ("grooveTexture" in grating)
            console.warn(`material ${material}: its grooves do not follow grooveTexture, which @rowland/three does not read`);
        Object.assign(parameters, { grating, rowland: this.rowland });
    }

    /** A material for each mesh, as its map follows the mesh. */
    async afterRoot(gltf: GLTF): Promise<void> {
        const seen = new Set<GratingMaterial>();
        for (const scene of gltf.scenes)
            scene.traverse((object) => {
                const mesh = object as Mesh<never, GratingMaterial>;
                if (!mesh.material?.isGratingMaterial) return;
                if (seen.has(mesh.material)) mesh.material = mesh.material.clone();
                seen.add(mesh.material);
            });
    }
}
