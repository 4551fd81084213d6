import {
    Color, DataTexture, FloatType, Mesh, MeshBasicMaterial, OrthographicCamera, PlaneGeometry, RGBAFormat, Scene,
    type Intersection, type PerspectiveCamera, type WebGLRenderer,
} from "three";
import type { GratingMaterial } from "@rowland/three";

/** Sides of the blocks of pixels that are filled in, first the coarse ones. */
const SIDES = [32, 16, 8];
const BATCH = 24;

type HitAt = (x: number, y: number) => Intersection<Mesh> | undefined;

/** The ground truth right of a line: the radiance of each block's middle, by the sum over wavelengths and the panorama. */
export class ReferenceView {
    /** The line, as a fraction of the width. */
    line = 0.5;
    private readonly scene = new Scene();
    private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    private readonly material = new MeshBasicMaterial();
    private run = 0;

    constructor(private readonly renderer: WebGLRenderer, private readonly onUpdate: () => void) {
        this.scene.background = new Color(0);
        this.scene.add(new Mesh(new PlaneGeometry(2, 2), this.material));
    }

    /** Over the picture, in its tone mapping. */
    draw(): void {
        const { renderer } = this;
        const { width, height } = renderer.domElement;
        const ratio = renderer.getPixelRatio();
        const begin = Math.round(this.line * width);
        renderer.setScissor(begin / ratio, 0, (width - begin) / ratio, height / ratio);
        renderer.setScissorTest(true);
        renderer.render(this.scene, this.camera);
        renderer.setScissorTest(false);
    }

    stop(): void {
        this.run += 1;
    }

    /** Fills in what the camera sees now; stop() or another start() ends it. */
    async start(hitAt: HitAt, camera: PerspectiveCamera): Promise<void> {
        const run = ++this.run;
        const { dataset } = document.documentElement;
        dataset.reference = "";
        const { width, height } = this.renderer.domElement;
        const finest = SIDES[SIDES.length - 1];
        const [columns, rows] = [Math.ceil(width / finest), Math.ceil(height / finest)];
        const texels = new Float32Array(4 * columns * rows);
        const texture = new DataTexture(texels, columns, rows, RGBAFormat, FloatType);
        texture.repeat.set(width / (finest * columns), height / (finest * rows));
        this.material.map?.dispose();
        this.material.map = texture;
        this.material.needsUpdate = true;
        for (const side of SIDES) {
            for (const batch of batches(side, width, height, hitAt)) {
                const material = batch.material;
                const points = batch.hits.map(({ hit }) => material.pointFrame(hit, camera));
                const radiance = await material.reference(Float32Array.from(points.flatMap((point) => [...point])));
                if (run !== this.run) return;
                batch.hits.forEach(({ x, y }, i) => {
                    for (let v = y / finest; v < Math.min((y + side) / finest, rows); ++v)
                        for (let u = x / finest; u < Math.min((x + side) / finest, columns); ++u)
                            texels.set(radiance.subarray(3 * i, 3 * i + 3), 4 * (v * columns + u));
                });
                texture.needsUpdate = true;
                this.onUpdate();
            }
            dataset.reference = String(side);
        }
    }
}

interface Block {
    x: number; // pixels from the left and from below
    y: number;
    hit: Intersection<Mesh>;
}

/** The blocks whose middle shows a sample, some of one material at a time. */
function* batches(side: number, width: number, height: number, hitAt: HitAt): Generator<{ material: GratingMaterial; hits: Block[] }> {
    const open = new Map<GratingMaterial, Block[]>();
    for (let y = 0; y < height; y += side)
        for (let x = 0; x < width; x += side) {
            const hit = hitAt(x + side / 2, y + side / 2);
            if (!hit) continue;
            const material = hit.object.material as GratingMaterial;
            const hits = open.get(material) ?? [];
            open.set(material, hits);
            hits.push({ x, y, hit });
            if (hits.length < BATCH) continue;
            open.delete(material);
            yield { material, hits };
        }
    for (const [material, hits] of open) yield { material, hits };
}
