import type { Camera, Material, Mesh, Scene, Texture, WebGLRenderer } from "three";
import type { GratingMaterial } from "@rowland/three";
import { gpuDone } from "./frames.js";

/** A task that takes longer is continued in another, as events wait for its end. */
const TASK_MS = 10;
/** Texels that the browser takes before it waits for the GPU's process. */
const UPLOAD = 2 ** 18;

/** Compiles the programs of a scene beside the page, and uploads its textures: a frame would wait for them. */
export class Programs {
    private stale = true;
    private readonly uploaded = new WeakMap<Texture, number>();

    constructor(private readonly renderer: WebGLRenderer, private readonly scene: Scene, private readonly camera: Camera) {}

    /** Materials are new, or have other options or textures. */
    changed(): void {
        this.stale = true;
    }

    async compile(): Promise<void> {
        if (!this.stale) return;
        this.stale = false;
        const { renderer, scene, camera } = this;
        let begun = performance.now();
        const yielded = async () => {
            if (performance.now() - begun < TASK_MS) return;
            await new Promise((resolve) => setTimeout(resolve));
            begun = performance.now();
        };
        const meshes = new Map<Material, Mesh>();
        scene.traverse((object) => {
            const mesh = object as Mesh<never, Material>;
            if (mesh.isMesh) meshes.set(mesh.material, mesh);
        });
        for (const mesh of meshes.values()) {
            renderer.compile(mesh, camera, scene);
            await yielded();
        }
        const programs = renderer.info.programs as unknown as { isReady(): boolean; getUniforms(): void; getAttributes(): void }[];
        do await gpuDone(renderer);
        while (!programs.every((program) => program.isReady()));
        // The first use of a program asks the GPU's process for these, and would wait for what was drawn before.
        for (const program of programs) {
            program.getUniforms();
            program.getAttributes();
            await yielded();
        }
        let texels = 0;
        for (const texture of texturesOf(meshes.keys())) {
            if (this.uploaded.get(texture) === texture.version) continue;
            this.uploaded.set(texture, texture.version);
            renderer.initTexture(texture);
            const { width, height, depth = 1 } = texture.image as { width: number; height: number; depth?: number };
            texels += width * height * depth;
            if (texels < UPLOAD) continue;
            await gpuDone(renderer);
            texels = 0;
        }
    }
}

/** Of materials, and of the gratings' tables. */
function texturesOf(materials: Iterable<Material>): Texture[] {
    const all = [...materials].flatMap((material) => [
        ...Object.values(material), ...Object.values((material as Partial<GratingMaterial>).state?.values ?? {}).map(({ value }) => value)]);
    return all.filter((value) => (value as Partial<Texture> | null)?.isTexture && !value.isRenderTargetTexture);
}
