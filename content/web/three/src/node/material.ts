import type { BufferGeometry, Mesh, Object3D, Scene } from "three";
import {
    cameraWorldMatrix, diffuseColor, float, isolate, materialEnvIntensity, min, normalView, OnObjectUpdate,
    positionViewDirection, vec3, vec4,
} from "three/tsl";
import { EnvironmentNode, MeshPhysicalNodeMaterial, PhysicalLightingModel, type Node, type NodeBuilder } from "three/webgpu";
import { withGrating, type GratingParameters } from "../with_grating.js";
import { posed_vertex, type PosedVertex } from "./pose.js";
import { Program, type Vec3 } from "./program.js";
import { in_probe, surface, type Surface } from "./surface.js";

/** Of three's builder, beyond its types. */
interface Building {
    scene: Scene;
    geometry: BufferGeometry;
    object: Object3D;
    context: { lightingModel: GratingLightingModel; outgoingLight: Vec3 };
}
const building = (builder: NodeBuilder) => builder as unknown as Building;

/** RE_Direct_Grating of src/glsl/surface.frag.glsl: three's lights light the layer beneath the grooves and the grooves. */
class GratingLightingModel extends PhysicalLightingModel {
    /** The environment in the mirror direction. */
    mirrored: Vec3 = vec3(0);

    constructor(private readonly surface: Surface, private readonly program: Program, layer: MeshPhysicalNodeMaterial) {
        super(layer.useClearcoat, layer.useSheen, layer.useIridescence, layer.useAnisotropy, layer.useTransmission,
            layer.useDispersion);
    }

    override direct(light: Parameters<PhysicalLightingModel["direct"]>[0], builder: NodeBuilder): void {
        super.direct(light, builder);
        const toward = (light.lightDirection as Vec3).transformDirection(cameraWorldMatrix).toVar();
        this.surface.add_lamp(in_probe(this.program, toward).toVar(), (light.lightColor as Vec3).toVar());
    }

    // A clearcoat and sheen lie over the grating.
    override finish(builder: NodeBuilder): void {
        const { outgoingLight } = building(builder).context;
        outgoingLight.assign(this.surface.grating_surface(outgoingLight.toVar(), this.mirrored));
        super.finish(builder);
    }
}

/** Three's environment, and its radiance in the mirror direction for GratingLightingModel. */
class MirroredEnvironment extends EnvironmentNode {
    override setup(builder: NodeBuilder): null {
        super.setup(builder);
        // Of a texture, its filtered levels; else a node of the page's.
        const { _pmremNode, envNode } = this as unknown as { _pmremNode: Vec3 | null; envNode: Vec3 };
        const direction = positionViewDirection.negate().reflect(normalView).transformDirection(cameraWorldMatrix);
        const sharp = { getUV: () => direction, getTextureLevel: () => float(0) };
        const radiance = (_pmremNode ?? envNode).context(sharp) as unknown as Vec3;
        const { lightingModel } = building(builder).context;
        lightingModel.mirrored = isolate(radiance.mul(materialEnvIntensity)) as unknown as Vec3;
        return null;
    }
}

/**
 * GratingMaterial for WebGPURenderer, on WebGPU and on its WebGL 2 back end: MeshPhysicalNodeMaterial under a diffraction
 * grating, with the parameters and the workers of GratingMaterial.
 */
export class GratingNodeMaterial extends withGrating(MeshPhysicalNodeMaterial) {
    // A leading underscore keeps a member out of NodeMaterial's copy() and of its cache key.
    private readonly _program = new Program(this.state);
    private _eachFrame?: Node; // three updates a material each frame if a node is among its members
    private _surface?: Surface; // until a lighting model has it
    private _vertex?: PosedVertex;
    private _light?: Vec3;

    static override get type(): string {
        return "GratingNodeMaterial";
    }

    constructor(parameters: GratingParameters = {}) {
        super(parameters);
        Object.defineProperty(this, "state", { enumerable: false }); // copy() gives a copy its own
    }

    override optionsChanged(): void {
        this.needsUpdate = true;
    }

    // WebGPURenderer does not call it.
    override onBeforeRender(): void {
        this.state.refuse("WebGLRenderer", "GratingNodeMaterial", "GratingMaterial of @rowland/three");
    }

    override customProgramCacheKey(): string {
        return `${this.type} ${this.id} ${this._program.key} ${super.customProgramCacheKey()}`;
    }

    override setupVariants(builder: NodeBuilder): void {
        this._eachFrame = OnObjectUpdate((({ scene, object }: { scene: Scene; object: Mesh }) => {
            this.state.see(scene, object.geometry, object);
            this._program.update();
        }) as never) as unknown as Node;
        super.setupVariants(builder);
    }

    override setupPosition(builder: NodeBuilder): never {
        if (this._program.has("ROWLAND")) this._vertex = posed_vertex(builder);
        return super.setupPosition(builder) as never;
    }

    override setupEnvironment(builder: NodeBuilder): never {
        const environment = super.setupEnvironment(builder) as unknown as { envNode: Node } | null;
        return (environment && this._surface ? new MirroredEnvironment(environment.envNode) : environment) as never;
    }

    override setupLightingModel(): PhysicalLightingModel {
        const grating = this._surface;
        this._surface = undefined;
        return grating ? new GratingLightingModel(grating, this._program, this) : super.setupLightingModel();
    }

    override setupLighting(builder: NodeBuilder): Node {
        const program = this._program;
        this._light = this._surface = undefined;
        if (!program.has("ROWLAND")) return super.setupLighting(builder);
        const { scene, geometry, object } = building(builder);
        this.state.see(scene, geometry, object);
        const grating = (this._surface = surface(program, geometry, this._vertex!));
        const light = (super.setupLighting(builder) as Vec3).toVar();
        // Without lights and environment three has asked for no lighting model.
        if (this._surface) light.addAssign(grating.grating_surface(vec3(0), vec3(0)));
        // Colours outside the screen's gamut are desaturated until no component is negative.
        if (!this.isUnclamped) light.subAssign(min(min(light.x, light.y), min(light.z, 0)));
        return (this._light = light);
    }

    private get isUnclamped(): boolean {
        return this._program.has("ROWLAND_UNCOMPRESSED") || this._program.has("ROWLAND_DIFFRACTION_ONLY");
    }

    override setupOutput(builder: NodeBuilder, output: Node): Node {
        return super.setupOutput(builder, this._light && this.isUnclamped ? vec4(this._light, diffuseColor.a) : output);
    }
}
