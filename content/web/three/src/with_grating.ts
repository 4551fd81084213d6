import type { Camera, Intersection, Material, Mesh, MeshPhysicalMaterial, MeshPhysicalMaterialParameters } from "three";
import { pointFrame } from "./frames.js";
import { GratingState, type GratingOwner, type GratingSettings } from "./grating_state.js";
import type { Efficiencies, Rowland } from "./rowland.js";

export interface GratingParameters extends MeshPhysicalMaterialParameters, GratingSettings {}

/** A class of physical materials: MeshPhysicalMaterial, or that of another renderer. TypeScript wants `any` of mixins. */
type Physical = new (...parameters: any[]) => Material & Pick<MeshPhysicalMaterial, "color" | "roughness">;

/** The class with a GratingState, and what a page asks of it. A subclass does what its renderer needs. */
export function withGrating<Base extends Physical>(base: Base) {
    return class extends base implements GratingOwner {
        readonly isGratingMaterial = true;
        readonly state: GratingState = new GratingState(this);

        constructor(...[parameters = {}]: any[]) {
            const { rowland, grating, efficiencies, grooves, representation, grooveTexture, ...physical } = parameters as GratingParameters;
            super({ color: 0x000000, roughness: 0.3, ...physical });
            this.state.configure({ rowland, grating, efficiencies, grooves, representation, grooveTexture });
        }

        override copy(source: this): this {
            super.copy(source);
            this.state.configure(source.state.settings);
            this.optionsChanged(); // a copy has three's own defines
            return this;
        }

        /** Of three's MaterialLoader, which gets the grating without a Rowland: call bake(rowland, material.grating) then. */
        override toJSON(meta?: Parameters<Material["toJSON"]>[0]): ReturnType<Material["toJSON"]> {
            const { grating, grooves, representation } = this.state.settings;
            return Object.assign(super.toJSON(meta), { type: "GratingMaterial", grating, grooves, representation });
        }

        override fromJSON(...[json, textures]: Parameters<Material["fromJSON"]>): this {
            super.fromJSON(json, textures);
            const { grating, grooves, representation } = json as GratingSettings;
            this.state.configure({ grating, grooves, representation });
            return this;
        }

        override dispose(): void {
            super.dispose();
            this.state.dispose();
        }

        valueAdded(): void {
            this.needsUpdate = true;
        }

        valueChanged(): void {}

        contentChanged(): void {}

        optionsChanged(): void {}

        layerChanged(colour: [number, number, number], roughness: number): void {
            this.color.setRGB(...colour);
            this.roughness = roughness;
        }

        /** Sets the grating, also another one on the same mesh, as sliders do. */
        bake(rowland: Rowland, grating: object, efficiencies?: Efficiencies | Float32Array): void {
            this.state.bake(rowland, grating, efficiencies);
        }

        /** What bake() was called with. */
        get grating(): object | undefined {
            return this.state.grating;
        }

        /** Resolves when the kernel is there; rejects for a bad material. */
        get ready(): Promise<void> {
            return this.state.ready;
        }

        /** Resolves when the efficiencies of its theory are there; for rigorous theory, seconds after `ready`. */
        get solved(): Promise<void> {
            return this.state.solved;
        }

        /** Resolves when the light shown is that of the current probe and plane. */
        get settled(): Promise<void> {
            return this.state.settled;
        }

        /** Whether reference() shows its grooves: not those of a texture, which vary within a pixel. */
        get hasReference(): boolean {
            return this.state.hasReference;
        }

        /** Whether the picture has the light of the probe; maps are coarse at first. */
        get lit(): boolean {
            return this.state.lit;
        }

        /** Draws the light that the grooves diffract, alone: to compare it with reference(). */
        get diffractionOnly(): boolean {
            return this.state.diffractionOnly;
        }
        set diffractionOnly(on: boolean) {
            this.state.diffractionOnly = on;
        }

        /**
         * The ground truth under the probe, linear Rec.709: a sum over wavelengths along arcs of the probe's texels,
         * without tables. Nine numbers per point, as pointFrame() gives them. Takes milliseconds per point.
         */
        reference(points: Float32Array): Promise<Float32Array> {
            return this.state.reference(points);
        }

        /** The numbers of a point on a mesh that a Raycaster of `camera` hits. */
        pointFrame(hit: Intersection<Mesh>, camera: Camera): Float32Array {
            const { state } = this;
            return pointFrame(hit, state.probeOf(hit.object), state.groovesOf(hit.object.geometry), state.rotation, camera);
        }

        /** Texture look-ups per pixel for the light of the probe without its key lights. */
        get price(): { map: number } {
            return this.state.price;
        }
    };
}
