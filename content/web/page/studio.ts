import { Group, Vector3, type BufferGeometry, type Material, type Mesh, type Object3D, type Texture } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { GratingExtension, type GratingMaterial, type Rowland } from "@rowland/three";
import type { Stage } from "./stage.js";

/** Radians. */
const MOST_TILT = 0.9;
/** Of a drag, for each pixel. */
const BY_DRAG = 0.006;
/** A new card waits within the old one. */
const WITHIN = 0.9;

/** Where the card looks: the page's lights have lamps before it and above. Radians from +X toward +Z. */
const FACING = (-30 * Math.PI) / 180;
const DISTANCE = 0.19;

type Front = Mesh<BufferGeometry, GratingMaterial>;
interface Card {
    object: Object3D;
    front: Front;
}

const clamped = (x: number, most: number) => Math.min(Math.max(x, -most), most);

/** A tilt: about the axis to the right, which brings the top nearer, and about that upward, which brings the left nearer. */
type Tilt = [about: number, sideways: number];

/** A foil card in a hand. */
export class FoilStudio {
    readonly stage: Stage;
    private readonly tilted = new Group();
    private readonly sides = new Group();
    private readonly loader: GLTFLoader;
    private card?: Card;
    private coming?: { card: Card; shown: () => void };
    private byHand: Tilt = [0, 0];
    private byPhone?: Tilt;
    private neutral?: Tilt; // how the phone was held at first, degrees
    private sway: Tilt = [0, 0];
    private swayed = 0; // since when, seconds
    private swaying = false;
    private readonly fingers = new Map<number, PointerEvent>();
    private draw = () => {};

    constructor(private readonly rowland: Rowland) {
        this.tilted.add(this.sides);
        this.loader = new GLTFLoader().register((parser) => new GratingExtension(parser, rowland));
        const facing = new Group().add(this.tilted);
        facing.rotation.y = Math.PI / 2 - FACING;
        const eye = new Vector3(Math.cos(FACING), 0, Math.sin(FACING)).multiplyScalar(DISTANCE);
        this.stage = { objects: facing, pieces: [], eye, target: new Vector3(), nearest: 0.06, farthest: 0.6, studio: this };
    }

    /** Shows a card's file; the old card stays until the new one has its light. Resolves then. */
    async show(glb: Uint8Array<ArrayBuffer>): Promise<void> {
        const { scene: object } = await this.loader.parseAsync(glb.buffer, "");
        let front: Front | undefined;
        object.traverse((mesh) => {
            if ((mesh as Partial<Front>).material?.isGratingMaterial) front = mesh as Front;
        });
        const card = { object, front: front! };
        await card.front.material.ready;
        if (this.card) object.scale.setScalar(WITHIN);
        this.sides.add(object);
        if (this.card) {
            const shown = new Promise<void>((resolve) => (this.coming = { card, shown: resolve }));
            this.rowland.onUpdate();
            await shown;
        }
        this.replace(card);
        this.rowland.onUpdate();
    }

    /** The page has drawn, or something has changed. */
    updated(): void {
        if (!this.coming?.card.front.material.lit) return;
        const { shown } = this.coming;
        this.coming = undefined;
        shown();
    }

    private replace(card: Card): void {
        const old = this.card;
        card.object.scale.setScalar(1);
        this.card = card;
        const { grating } = card.front.material;
        this.stage.pieces.splice(0, 1, { name: "card", handle: this.sides, meshes: [card.front], given: grating!, grating: grating! });
        if (!old) return;
        this.sides.remove(old.object);
        old.object.traverse((object) => {
            const mesh = object as Mesh<BufferGeometry, Material>;
            if (!mesh.isMesh) return;
            for (const value of Object.values(mesh.material)) if ((value as Texture | null)?.isTexture) (value as Texture).dispose();
            mesh.material.dispose();
            mesh.geometry.dispose();
        });
    }

    /** Takes the pointer, the phone and the clock. `draw`: the tilt has changed. */
    open(canvas: HTMLCanvasElement, draw: () => void): void {
        this.draw = draw;
        canvas.addEventListener("pointerdown", (event) => this.fingers.set(event.pointerId, event));
        canvas.addEventListener("pointermove", (event) => {
            const before = this.fingers.get(event.pointerId);
            if (!before) return;
            this.fingers.set(event.pointerId, event);
            if (this.fingers.size === 1) this.tilt(BY_DRAG * (event.clientY - before.clientY), BY_DRAG * (event.clientX - before.clientX));
        });
        for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, (event) => this.fingers.delete(event.pointerId));
        addEventListener("deviceorientation", this.follow);
        this.place();
    }

    tilt(about: number, sideways: number): void {
        this.byHand = [clamped(this.byHand[0] + about, MOST_TILT), clamped(this.byHand[1] + sideways, MOST_TILT)];
        this.place();
    }

    /** Whether a phone's browser may give its tilt only after a tap. */
    static get asksForPhone(): boolean {
        return typeof DeviceOrientationEvent !== "undefined" && "requestPermission" in DeviceOrientationEvent && matchMedia("(pointer: coarse)").matches;
    }

    /** After a tap. */
    async askForPhone(): Promise<void> {
        const ask = (DeviceOrientationEvent as unknown as { requestPermission(): Promise<string> }).requestPermission;
        if ((await ask.call(DeviceOrientationEvent)) !== "granted")
            throw new Error("The browser did not give the phone's tilt: allow motion and orientation for this page, then tap again.");
        // A listener from before the permission may get nothing.
        removeEventListener("deviceorientation", this.follow);
        addEventListener("deviceorientation", this.follow);
    }

    private readonly follow = ({ beta, gamma }: DeviceOrientationEvent): void => {
        if (beta === null || gamma === null) return;
        const screenAngle = ((screen.orientation?.angle ?? 0) * Math.PI) / 180;
        const [cos, sin] = [Math.cos(screenAngle), Math.sin(screenAngle)];
        const now: Tilt = [beta * cos - gamma * sin, gamma * cos + beta * sin];
        const most = (MOST_TILT * 180) / Math.PI;
        // Whoever sits up takes the card along.
        this.neutral = now.map((degrees, i) => degrees - clamped(degrees - (this.neutral?.[i] ?? degrees), most)) as Tilt;
        this.byPhone = now.map((degrees, i) => ((degrees - this.neutral![i]) * Math.PI) / 180) as Tilt;
        this.move(false);
        this.place();
    };

    showSide(back: boolean): void {
        this.sides.rotation.y = back ? Math.PI : 0;
        this.draw();
    }

    /** A gentle motion, as of a hand that holds the card; not where the phone's tilt is known. */
    move(on: boolean): void {
        const begins = on && !this.swaying && !this.byPhone;
        this.swaying = on && !this.byPhone;
        if (!begins) return;
        this.swayed = performance.now() / 1000;
        requestAnimationFrame(this.step);
    }

    get moving(): boolean {
        return this.swaying;
    }

    private readonly step = (milliseconds: number): void => {
        if (!this.swaying) return;
        requestAnimationFrame(this.step);
        if (this.fingers.size > 0) return;
        const t = Math.max(milliseconds / 1000 - this.swayed, 0);
        const grown = 1 - Math.exp(-t / 1.5);
        this.sway = [grown * (0.13 * Math.sin(0.8 * t) + 0.02 * Math.sin(2.1 * t)), grown * (0.2 * Math.sin(0.55 * t) + 0.02 * Math.sin(1.7 * t + 1))];
        this.place();
    };

    private place(): void {
        const [about, sideways] = [0, 1].map((i) => this.byHand[i] + this.sway[i] + (this.byPhone?.[i] ?? 0));
        this.tilted.rotation.set(about, sideways, 0);
        document.documentElement.dataset.tilt = JSON.stringify([about, sideways]);
        this.draw();
    }
}
