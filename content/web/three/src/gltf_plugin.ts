import { DataTexture, LoaderUtils, Matrix4, RGBAFormat, UnsignedShortType, type BufferGeometry, type Mesh, type MeshPhysicalMaterial, type Texture } from "three";
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { filmOf, type Iridescence } from "./film_table.js";
import { flatNormal } from "./frames.js";
import { decodePng16 } from "./png16.js";
import type { Rowland } from "./rowland.js";
import type { FilmParameters } from "./with_film.js";
import type { GratingParameters } from "./with_grating.js";

const IDENTITY = new Matrix4();

/** A plug-in of GLTFLoader for an extension of materials, with a class of materials. */
abstract class MaterialPlugin implements GLTFLoaderPlugin {
    abstract readonly name: string;
    protected abstract readonly type: unknown;

    constructor(protected readonly parser: GLTFParser, protected readonly rowland: Rowland) {}

    /** Comes before others that are asked for a material's type: the first answer holds, and three's plug-ins answer for theirs. */
    beforeRoot(): null {
        const { [this.name]: own, ...others } = this.parser.plugins;
        this.parser.plugins = { [this.name]: own, ...others };
        return null;
    }

    protected extension(material: number): object | undefined {
        return this.parser.json.materials[material].extensions?.[this.name];
    }

    getMaterialType(material: number): typeof MeshPhysicalMaterial | null {
        return this.extension(material) ? (this.type as typeof MeshPhysicalMaterial) : null;
    }
}

type Grating = MeshPhysicalMaterial & { isGratingMaterial?: boolean };

/** That for ROWLAND_materials_diffraction. */
export abstract class GratingPlugin extends MaterialPlugin {
    readonly name = "ROWLAND_materials_diffraction";

    async extendMaterialParams(material: number, parameters: GratingParameters): Promise<void> {
        const grating = this.extension(material) as { grooveTexture?: { index: number } } | undefined;
        if (!grating) return;
        Object.assign(parameters, { grating, rowland: this.rowland });
        if (!grating.grooveTexture) return;
        await this.parser.assignTexture(parameters, "grooveTexture", grating.grooveTexture);
        parameters.grooveTexture = await this.exact(parameters.grooveTexture!, grating.grooveTexture.index);
    }

    /** A texture with all bits of its file, where that is a PNG of 16 bits: browsers decode it to 8. */
    private async exact(texture: Texture, index: number): Promise<Texture> {
        const { json, fileLoader, options } = this.parser;
        const { bufferView, uri } = json.images[json.textures[index].source] ?? {};
        if (bufferView === undefined && !/^data:image.png|\.png$/i.test(uri)) return texture;
        const file = bufferView === undefined ? fileLoader.loadAsync(LoaderUtils.resolveURL(uri, options.path)) : this.parser.getDependency("bufferView", bufferView);
        const picture = await decodePng16(new Uint8Array((await file) as ArrayBuffer));
        if (!picture) return texture;
        const { wrapS, wrapT, magFilter, minFilter, channel, rotation, name } = texture;
        const exact = new DataTexture(picture.data, picture.width, picture.height, RGBAFormat, UnsignedShortType);
        Object.assign(exact, { wrapS, wrapT, magFilter, minFilter, channel, rotation, name });
        exact.offset.copy(texture.offset);
        exact.repeat.copy(texture.repeat);
        texture.dispose();
        return exact;
    }

    /** Gives each mesh a material, so that flat ones keep their maps beside curved ones; flat parts that face one way share one. */
    async afterRoot(gltf: GLTF): Promise<void> {
        const seen = new Set<Grating>();
        for (const scene of gltf.scenes)
            scene.traverse((parent) => {
                const facing = new Map<string, Grating>();
                for (const object of parent.children) {
                    const mesh = object as Mesh<BufferGeometry, Grating>;
                    if (!mesh.material?.isGratingMaterial) continue;
                    mesh.updateMatrix();
                    const flat = mesh.isMesh && mesh.matrix.equals(IDENTITY) ? flatNormal(mesh.geometry) : null;
                    const key = `${mesh.material.uuid} ${flat?.toArray().map((x) => x.toFixed(3))}`;
                    const shared = flat && facing.get(key);
                    if (!shared && seen.has(mesh.material)) mesh.material = mesh.material.clone();
                    if (shared) mesh.material = shared;
                    seen.add(mesh.material);
                    if (flat) facing.set(key, mesh.material);
                }
            });
    }
}

/** That for KHR_materials_iridescence. */
export abstract class FilmPlugin extends MaterialPlugin {
    readonly name = "KHR_materials_iridescence";

    async extendMaterialParams(material: number, parameters: FilmParameters): Promise<void> {
        const iridescence = this.extension(material) as Iridescence | undefined;
        if (!iridescence) return;
        const { iridescenceThicknessMinimum: least = 100, iridescenceThicknessMaximum: most = 400 } = iridescence;
        parameters.iridescence = iridescence.iridescenceFactor ?? 0;
        parameters.iridescenceThicknessRange = [least, most];
        if (iridescence.iridescenceTexture) await this.parser.assignTexture(parameters, "iridescenceMap", iridescence.iridescenceTexture);
        if (iridescence.iridescenceThicknessTexture)
            await this.parser.assignTexture(parameters, "iridescenceThicknessMap", iridescence.iridescenceThicknessTexture);
        parameters.film = filmOf(iridescence, this.parser.json.materials[material].pbrMetallicRoughness?.roughnessFactor ?? 1);
        parameters.rowland = this.rowland;
    }
}
