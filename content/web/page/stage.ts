import {
    Box3, Color, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, PlaneGeometry, Vector3, type BufferGeometry,
    type Light, type Material, type Object3D,
} from "three";
import { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { FilmExtension, FilmMaterial, GratingExtension, GratingMaterial, type Rowland } from "@rowland/three";
import type { Settings } from "./address.js";
import { FoilStudio } from "./studio.js";
import { builtInEfficiencies, SAMPLES } from "./samples.js";

type ShownMaterial = GratingMaterial | FilmMaterial;
type ShownMesh = Mesh<BufferGeometry, ShownMaterial>;

/** A thing with a grating or a film. */
export interface Piece {
    name: string;
    /** What a hand turns, about its y axis. */
    handle: Object3D;
    meshes: ShownMesh[];
    /** Its grating or film before a slider has moved. */
    given: object;
    /** The same in the present. */
    grating: object;
}

/** What the page shows, and whence. */
export interface Stage {
    objects: Object3D;
    pieces: Piece[];
    eye: Vector3;
    target: Vector3;
    nearest: number;
    farthest: number;
    /** Of the scene with a card. */
    studio?: FoilStudio;
}

export const materialsOf = (piece: Piece) => [...new Set(piece.meshes.map(({ material }) => material))];

export async function samples(rowland: Rowland, bent: Settings): Promise<Stage> {
    const efficiencies = await builtInEfficiencies();
    const objects = new Group();
    const ground = new Mesh(new PlaneGeometry(0.6, 0.6).rotateX(-Math.PI / 2), new MeshStandardMaterial({ color: 0x222326, roughness: 0.9 }));
    ground.position.y = -0.004;
    objects.add(ground);
    const pieces = SAMPLES.map(({ geometry, position, name, material }) => {
        const own = name === (bent.sample ?? SAMPLES[0].name) ? bent : undefined;
        const grating = own?.material ?? material;
        const solved = own?.material ? undefined : efficiencies(name);
        const mesh = new Mesh(geometry(), new GratingMaterial({ rowland, grating, efficiencies: solved, representation: own?.representation }));
        mesh.position.set(...position);
        objects.add(mesh);
        return { name, handle: mesh, meshes: [mesh], given: material, grating };
    });
    return { objects, pieces, eye: new Vector3(0.08, 0.24, 0.33), target: new Vector3(0.04, 0.0, 0.045), nearest: 0.12, farthest: 1.5 };
}

/** The outermost object around it that may be turned. */
function handleOf(mesh: Object3D): Object3D {
    let handle = mesh;
    for (let at: Object3D | null = mesh; at; at = at.parent) if (at.userData.grab) handle = at;
    return handle;
}

/** A scene of the demo, and its pieces: each handle with what lies on it. */
async function loaded(file: string, rowland: Rowland): Promise<{ scene: Object3D; pieces: Piece[] }> {
    const draco = new DRACOLoader().setDecoderPath("draco/").setWorkerLimit(1);
    const loader = new GLTFLoader().setDRACOLoader(draco).register((parser) => new GratingExtension(parser, rowland))
        .register((parser) => new FilmExtension(parser, rowland));
    const { scene } = await loader.loadAsync(file);
    draco.dispose();
    const byHandle = new Map<Object3D, Piece>();
    scene.traverse((object) => {
        if ((object as Light).isLight) object.visible = false; // the panel has one
        const mesh = object as ShownMesh;
        if (!mesh.isMesh) return;
        const { grating, film } = mesh.material as { grating?: object; film?: object };
        const given = grating ?? film;
        if (!given) return;
        const handle = handleOf(mesh);
        const piece = byHandle.get(handle);
        if (piece) piece.meshes.push(mesh);
        else byHandle.set(handle, { name: handle.name.replaceAll("_", " "), handle, meshes: [mesh], given, grating: given });
    });
    return { scene, pieces: [...byHandle.values()] };
}

/** The demo's cabinet. */
export async function cabinet(rowland: Rowland): Promise<Stage> {
    const { scene, pieces } = await loaded("cabinet.glb", rowland);
    return { objects: scene, pieces, eye: new Vector3(0.02, 1.36, 0.98), target: new Vector3(0.02, 0.97, -0.03), nearest: 0.15, farthest: 3 };
}

/** The foil studio's card, which comes with its panel. */
export async function foil(rowland: Rowland): Promise<Stage> {
    return new FoilStudio(rowland).stage;
}

/** The demo's films: a bubble, an anodised ring, lenses and oil. */
export async function films(rowland: Rowland): Promise<Stage> {
    const { scene, pieces } = await loaded("films.glb", rowland);
    const box = new Box3().makeEmpty();
    for (const { handle } of pieces) box.expandByObject(handle);
    const target = box.getCenter(new Vector3());
    const eye = target.clone().addScaledVector(new Vector3(0, 0.45, 1), 1.1 * box.getSize(new Vector3()).length());
    return { objects: scene, pieces, eye, target, nearest: 0.1, farthest: 3 };
}

/** What has no ground truth: black while that is shown. */
export class Rest {
    private readonly given: { mesh: Mesh; material: Material | Material[] }[] = [];
    private readonly black = new MeshBasicMaterial({ color: new Color(0) });

    constructor(objects: Object3D) {
        objects.traverse((object) => {
            const mesh = object as Mesh<BufferGeometry, Material>;
            if (mesh.isMesh && !hasReference(mesh)) this.given.push({ mesh, material: mesh.material });
        });
    }

    show(on: boolean): void {
        for (const { mesh, material } of this.given) {
            mesh.material = on ? this.black : material;
            mesh.visible = on ? !(material as Material).transparent : true;
        }
    }
}

export function hasReference(mesh: Mesh): boolean {
    const material = mesh.material as Partial<GratingMaterial>;
    return material.isGratingMaterial === true && material.hasReference === true;
}
