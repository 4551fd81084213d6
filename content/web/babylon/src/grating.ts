import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import type { MaterialDefines } from "@babylonjs/core/Materials/materialDefines.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { AbstractMesh } from "@babylonjs/core/Meshes/abstractMesh.js";
import type { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import type { SubMesh } from "@babylonjs/core/Meshes/subMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import { toProbe } from "./engine.js";
import { definitions, only as onlyIf, ValuesPlugin } from "./plugin.js";
import { FRAGMENT, VERTEX } from "./shared/generated/shaders.js";
import { GratingState, type GratingOwner, type GratingSettings } from "./shared/grating_state.js";

/** The attribute that numbers the instances of createInstance(), of which Babylon draws those in sight alone. */
const INSTANCE = "groove_instance";

const only = (text: string) => onlyIf("defined(ROWLAND)", text);

/** three's GLSL, which takes directions in its view, with Babylon's world for that. */
const ofThree = (text: string) => definitions("#define SHOWN_LAYERS LAYERS\n#define viewMatrix mat4(1.0)\n" + text);
/** For "#include GROOVE_SPARKLE", once a grating has asked for it. */
let sparkle = "";
const CODE: Record<string, Record<string, string>> = {
    vertex: {
        CUSTOM_VERTEX_DEFINITIONS: only(`#if defined(INSTANCES) && !defined(THIN_INSTANCES)
in float ${INSTANCE};
#else
#define ${INSTANCE} gl_InstanceID
#endif
${ofThree(VERTEX)}`),
        CUSTOM_VERTEX_UPDATE_WORLDPOS: only(`vec4 across = vec4(1.0);
#ifdef TANGENT
across = tangentUpdated;
#endif
groove_position = positionUpdated;
groove_normal = normalUpdated;
pass_grooves(normal, across, mat3(finalWorld), vNormalW, int(${INSTANCE}));`),
    },
    fragment: {
        CUSTOM_FRAGMENT_BEFORE_LIGHTS: only(`vec3 to_eye = vEyePosition.xyz - vPositionW;
if (projection[2][3] == 0.0) { // orthographic
to_eye = vec3(view[0].z, view[1].z, view[2].z);
#ifndef RIGHT_HANDED
to_eye = -to_eye;
#endif
}
prepare_grooves(to_eye, vNormalW);`),
        // Each of Babylon's lights. The number of a light is in the line before.
        "!diffuseBase\\+=info\\.diffuse\\*shadowDebug(\\d+);\\n#else\\ndiffuseBase\\+=info\\.diffuse\\*shadow;":
            `diffuseBase+=info.diffuse*shadowDebug$1;
#else
diffuseBase+=info.diffuse*shadow;
` + onlyIf("defined(ROWLAND) && (defined(DIRLIGHT$1) || defined(POINTLIGHT$1) || defined(SPOTLIGHT$1))",
                "add_lamp(in_probe(preInfo.L), vLightingIntensity.x * preInfo.attenuation * shadow * diffuse$1.rgb);"),
        CUSTOM_FRAGMENT_BEFORE_FOG: only(`vec4 mirrored = vec4(0.0);
#if defined(REFLECTION) && !defined(UNLIT)
#ifdef LODBASEDMICROSFURACE
mirrored = sampleReflectionLod(reflectionSampler, reflectionOut.reflectionCoords, 0.0);
#else
mirrored = sampleReflection(reflectionSampler, reflectionOut.reflectionCoords);
#endif
#ifdef RGBDREFLECTION
mirrored.rgb = fromRGBD(mirrored);
#endif
#ifdef GAMMAREFLECTION
mirrored.rgb = toLinearSpace(mirrored.rgb);
#endif
mirrored.rgb *= vReflectionInfos.x * vReflectionColor.rgb * vLightingIntensity.z;
#endif
finalColor.rgb = grating_surface(finalColor.rgb - finalEmissive, mirrored.rgb) + finalEmissive;
#ifndef ROWLAND_DIFFRACTION_ONLY
// Colours outside the screen's gamut are desaturated until no component is negative.
finalColor.rgb -= min(min(finalColor.r, finalColor.g), min(finalColor.b, 0.0));
#endif`),
    },
};

/**
 * A diffraction grating over a PBRMaterial, which is the layer beneath it. `rowland`'s panorama and Babylon's lights light
 * both; until the first map or table arrives, only the layer is drawn.
 */
export class GratingPlugin extends ValuesPlugin implements GratingOwner {
    readonly state = new GratingState(this);
    protected readonly values = this.state.values;

    constructor(material: PBRMaterial, settings: GratingSettings) {
        super(material, "Rowland");
        this.state.configure(settings);
    }

    override getClassName(): string {
        return "GratingPlugin";
    }

    override getCustomCode(shader: string): Record<string, string> | null {
        if (shader !== "fragment") return CODE[shader] ?? null;
        return { CUSTOM_FRAGMENT_DEFINITIONS: only(ofThree(FRAGMENT.replace("#include GROOVE_SPARKLE", sparkle))), ...CODE.fragment };
    }

    protected get options(): ReadonlyMap<string, string> {
        const { options } = this.state;
        return options.has("ROWLAND") ? options : new Map();
    }

    valueChanged(name: string): void {
        this.valueAdded(name);
    }

    contentChanged(): void {}

    async loadSparkle(): Promise<void> {
        ({ SPARKLE: sparkle } = await import("./shared/generated/sparkle.js"));
    }

    layerChanged(colour: [number, number, number], roughness: number): void {
        Object.assign(this.material, { albedoColor: new Color3(...colour), metallic: 0, roughness });
    }

    override getAttributes(attributes: string[]): void {
        attributes.push(INSTANCE);
    }

    override prepareDefinesBeforeAttributes(defines: MaterialDefines, scene: Scene, mesh: AbstractMesh): void {
        super.prepareDefinesBeforeAttributes(defines, scene, mesh);
        if (this.options.size > 0) defines._needNormals = true;
        const uv = this.options.get("ROWLAND_GROOVE_UV");
        if (!uv) return;
        defines._needUVs = true;
        if (!mesh.isVerticesDataPresent(uv)) defines.ROWLAND_GROOVE_UV = "vec2(0.0)";
    }

    override hardBindForSubMesh(_: unknown, scene: Scene, __: unknown, subMesh: SubMesh): void {
        const { material, state } = this;
        const mesh = subMesh.getRenderingMesh();
        if (mesh.hasInstances) numberInstances(mesh);
        const environment = material.reflectionTexture ?? scene.environmentTexture;
        const environmentIntensity = scene.environmentIntensity * material.environmentIntensity * (environment?.level ?? 1);
        state.see({ environmentIntensity, probe: toProbe(scene, environment) }, mesh, mesh);
        this.bind(this.options.size > 0 ? subMesh.effect : null, scene);
    }

    override dispose(): void {
        this.state.dispose();
    }
}

function numberInstances(mesh: Mesh): void {
    if (!(INSTANCE in (mesh.instancedBuffers ?? {}))) mesh.registerInstancedBuffer(INSTANCE, 1);
    mesh.instances.forEach((one, i) => (one.instancedBuffers[INSTANCE] = i + 1)); // the mesh itself is 0
}

/** A material of grooves over a black layer. */
export function gratingMaterial(name: string, scene: Scene, settings: GratingSettings): PBRMaterial {
    const material = Object.assign(new PBRMaterial(name, scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0.3 });
    new GratingPlugin(material, settings);
    return material;
}
