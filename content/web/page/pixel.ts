import { FloatType, WebGLRenderTarget, type DirectionalLight, type Intersection, type Mesh, type PerspectiveCamera, type Scene, type WebGLRenderer } from "three";
import type { GratingMaterial } from "@rowland/three";

export interface PixelComparison {
    shown: number[];
    reference: number[];
    error: number; // of the difference, relative to the reference
}

const length = (rgb: ArrayLike<number>) => Math.hypot(rgb[0], rgb[1], rgb[2]);

/** What a pixel shows of the light that the grooves diffract, and the sum over wavelengths and texels of the probe. */
export class PixelComparer {
    private readonly target = new WebGLRenderTarget(1, 1, { type: FloatType });

    constructor(
        private readonly renderer: WebGLRenderer,
        private readonly scene: Scene,
        private readonly camera: PerspectiveCamera,
        private readonly lamp: DirectionalLight, // not of the probe
    ) {}

    /** `hit`: through the middle of the pixel (x, y) of the picture. */
    async compare(hit: Intersection<Mesh>, x: number, y: number): Promise<PixelComparison> {
        const material = hit.object.material as GratingMaterial;
        const shown = this.shown(material, x, y);
        const reference = [...(await material.reference(material.pointFrame(hit, this.camera)))];
        const difference = length(shown.map((value, c) => value - reference[c]));
        return { shown, reference, error: difference === 0 ? 0 : difference / length(reference) };
    }

    private shown(material: GratingMaterial, x: number, y: number): number[] {
        const { renderer, camera, lamp } = this;
        const { width, height } = renderer.domElement;
        const intensity = lamp.intensity;
        const only = material.diffractionOnly;
        material.diffractionOnly = true;
        lamp.intensity = 0;
        camera.setViewOffset(width, height, x, y, 1, 1);
        renderer.setRenderTarget(this.target);
        renderer.render(this.scene, camera);
        const rgba = new Float32Array(4);
        renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, rgba);
        renderer.setRenderTarget(null);
        camera.clearViewOffset();
        lamp.intensity = intensity;
        material.diffractionOnly = only;
        return [...rgba.subarray(0, 3)];
    }
}
