import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import type { MaterialDefines } from "@babylonjs/core/Materials/materialDefines.js";
import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { RawTexture2DArray } from "@babylonjs/core/Materials/Textures/rawTexture2DArray.js";
import { RawTexture3D } from "@babylonjs/core/Materials/Textures/rawTexture3D.js";
import type { Texture } from "@babylonjs/core/Materials/Textures/texture.js";
import type { AbstractMesh } from "@babylonjs/core/Meshes/abstractMesh.js";
import type { SubMesh } from "@babylonjs/core/Meshes/subMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import { GratingState, type Representation, type TableTexture, type Value, type VectorTexture } from "../../three/src/grating_state.js";
import type { Efficiencies, Rowland } from "../../three/src/rowland.js";
import { FRAGMENT, VERTEX } from "./generated/shaders.js";
import { MeshSurface, toProbe, type Grooves } from "./surface.js";

export interface GratingOptions {
    rowland: Rowland;
    /** A material file's JSON, or the object of ROWLAND_materials_diffraction. */
    grating: object;
    /** Of a grating of rigorous theory. Without them a worker computes them; scalar theory shows until then. */
    efficiencies?: Efficiencies | Float32Array;
    /** By default "tangent" for meshes with tangents, else "radial". */
    grooves?: Grooves;
    /** By default "planar" for flat meshes, else "arc". */
    representation?: Representation;
}


const FLAGS = ["ROWLAND", "ROWLAND_PLANAR", "ROWLAND_ARC", "ROWLAND_RADIAL", "ROWLAND_DIFFRACTION_ONLY", "KERNEL_VIEWS",
    "LOBE_GAUSSIAN", "LOBE_PITS", "COVER", "ZERO_ORDER", "LOBE_MAP", "HALF_TURN", "PITCH_AXIS"];
const NUMBERS = ["ROWLAND_MAXIMUM_KEY_LOBES", "VIEW_MAPPING", "TABLE_COLUMNS", "TABLE_ROWS", "LAYERS"];
const DEFINES = Object.fromEntries([...FLAGS.map((name) => [name, false]), ...NUMBERS.map((name) => [name, 0])]);

const DECLARED = [...(VERTEX + FRAGMENT).matchAll(/uniform (\w+) (\w+);|STORAGE\(\d+, \w+, (\w+), (\w+)\)/g)];
const nameOf = ([, , uniform, , storage]: RegExpMatchArray) => uniform ?? storage;
const isSampler = ([, type]: RegExpMatchArray) => !type || type.startsWith("sampler");
const SAMPLERS = [...new Set(DECLARED.filter(isSampler).map(nameOf))];
const KEY_LOBE = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
const UNIFORMS = [...new Set(DECLARED.filter((one) => !isSampler(one)).map(nameOf)),
    ...Array.from({ length: 64 }, (_, light) => KEY_LOBE.map((member) => `key_lobes[${light}].${member}`)).flat()];

/** GLSL's own preprocessor evaluates "# if"; Babylon's, which evaluates "#if", knows neither all operators nor continued lines. */
const only = (text: string) => `# ifdef ROWLAND\n${text.replace(/^#(?=\w)/gm, "# ")}\n# endif`;

const CODE: Record<string, Record<string, string>> = {
    vertex: {
        CUSTOM_VERTEX_DEFINITIONS: only(VERTEX),
        CUSTOM_VERTEX_UPDATE_WORLDPOS: only(`vec4 across = vec4(1.0);
#ifdef TANGENT
across = tangentUpdated;
#endif
pass_grooves(positionUpdated, normalUpdated, across, finalWorld, vNormalW);`),
    },
    fragment: {
        CUSTOM_FRAGMENT_DEFINITIONS: only(`precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler3D;
${FRAGMENT}`),
        CUSTOM_FRAGMENT_BEFORE_LIGHTS: only("prepare_grooves();"),
        // Each of Babylon's lights. The number of a light is in the line before.
        "!diffuseBase\\+=info\\.diffuse\\*shadowDebug(\\d+);\\n#else\\ndiffuseBase\\+=info\\.diffuse\\*shadow;":
            `diffuseBase+=info.diffuse*shadowDebug$1;
#else
diffuseBase+=info.diffuse*shadow;
` + only(`#if defined(DIRLIGHT$1) || defined(POINTLIGHT$1) || defined(SPOTLIGHT$1)
add_lamp(to_probe * preInfo.L, vLightingIntensity.x * preInfo.attenuation * shadow * diffuse$1.rgb);
#endif`),
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
// Colours outside the screen's gamut are desaturated until no component is negative.
finalColor.rgb -= min(min(finalColor.r, finalColor.g), min(finalColor.b, 0.0));`),
    },
};

function textureOf(value: TableTexture | VectorTexture, scene: Scene): Texture {
    const [rgba, half] = [Constants.TEXTUREFORMAT_RGBA, Constants.TEXTURETYPE_HALF_FLOAT];
    if (value.kind === "vectors") {
        const rows = Math.max(1, Math.ceil(value.vectors.length / 4096));
        const padded = new Float32Array(4096 * rows);
        padded.set(value.vectors);
        return new RawTexture(padded, 1024, rows, rgba, scene, false, false, Constants.TEXTURE_NEAREST_SAMPLINGMODE, Constants.TEXTURETYPE_FLOAT);
    }
    const { texels, width, height, depth } = value.table;
    const linear = Constants.TEXTURE_BILINEAR_SAMPLINGMODE;
    const wrap = (axis: string) => (value.repeats.includes(axis) ? Constants.TEXTURE_WRAP_ADDRESSMODE : Constants.TEXTURE_CLAMP_ADDRESSMODE);
    const texture = value.kind === "2d" ? new RawTexture(texels, width, height, rgba, scene, false, false, linear, half)
        : value.kind === "array" ? new RawTexture2DArray(texels, width, height, depth, rgba, scene, false, false, linear, half)
        : new RawTexture3D(texels, width, height, depth, rgba, scene, false, false, linear, half);
    return Object.assign(texture, { wrapU: wrap("s"), wrapV: Constants.TEXTURE_CLAMP_ADDRESSMODE, wrapR: wrap("r") });
}

/**
 * A diffraction grating over a PBRMaterial, which is the layer beneath it. `rowland`'s panorama and Babylon's lights light
 * both; until the first map or table arrives, only the layer is drawn. Each mesh needs a material for itself, since the map
 * follows the mesh. WebGL 2 alone.
 */
export class GratingPlugin extends MaterialPluginBase {
    readonly state: GratingState;
    private readonly textures = new Map<string, Texture>();
    private stale = false;
    private surface?: { mesh: AbstractMesh; surface: MeshSurface };

    constructor(private readonly material: PBRMaterial, private readonly settings: GratingOptions) {
        super(material, "Rowland", 300, DEFINES, true, false);
        this.doNotSerialize = true; // without its workers it would show nothing
        this.registerForExtraEvents = true; // hardBindForSubMesh
        this._enable(true);
        this.state = new GratingState(settings.rowland, (name) => this.put(name), () => this.refresh(), (colour, roughness) => {
            Object.assign(material, { albedoColor: Color3.FromArray(colour), roughness, metallic: 0 });
        });
        this.state.representation = settings.representation;
        this.state.bake(settings.grating, settings.efficiencies);
    }

    override getClassName(): string {
        return "GratingPlugin";
    }

    private put(name: string): void {
        const value = this.state.values.get(name) as Value;
        if (typeof value !== "object" || !("kind" in value)) return;
        this.textures.get(name)?.dispose();
        this.textures.set(name, textureOf(value, this.material.getScene()));
    }

    /** Asks for another program. While a glTF loads, Babylon ignores this. */
    private refresh(): void {
        this.stale = this.material.getScene().blockMaterialDirtyMechanism;
        if (!this.stale) this.markAllDefinesAsDirty();
    }

    private groovesOf(mesh: AbstractMesh): Grooves {
        return this.settings.grooves ?? (mesh.isVerticesDataPresent("tangent") ? "tangent" : "radial");
    }

    override prepareDefinesBeforeAttributes(defines: MaterialDefines, _: Scene, mesh: AbstractMesh): void {
        const { options } = this.state;
        const on = options.get("ROWLAND") !== undefined;
        for (const name of FLAGS) defines[name] = on && options.get(name) !== undefined;
        for (const name of NUMBERS) defines[name] = Number(options.get(name) ?? 0);
        defines.ROWLAND_RADIAL = on && this.groovesOf(mesh) === "radial";
        if (on) defines._needNormals = true;
    }

    override getUniforms() {
        return { externalUniforms: UNIFORMS };
    }

    override getSamplers(samplers: string[]): void {
        samplers.push(...SAMPLERS);
    }

    override getCustomCode(shader: string): Record<string, string> | null {
        return CODE[shader] ?? null;
    }

    override hardBindForSubMesh(_: unknown, scene: Scene, __: unknown, subMesh: SubMesh): void {
        const { material, state } = this;
        const mesh = subMesh.getRenderingMesh();
        const environment = material.reflectionTexture ?? scene.environmentTexture;
        const probe = () => toProbe(scene, material.reflectionTexture ?? scene.environmentTexture);
        if (this.surface?.mesh !== mesh) this.surface = { mesh, surface: new MeshSurface(mesh, this.groovesOf(mesh), probe) };
        state.see(this.surface.surface);
        if (this.stale) this.refresh();
        const effect = subMesh.effect;
        if (!effect || !state.options.get("ROWLAND")) return;
        effect.setMatrix3x3("to_probe", Float32Array.from(probe()));
        for (const [name, value] of state.values) {
            if (typeof value === "number") effect.setFloat(name, value);
            else if ("kind" in value) effect.setTexture(name, this.textures.get(name)!);
            else if (value.length === 2) effect.setFloat2(name, value[0], value[1]);
            else if (value.length === 3) effect.setFloat3(name, value[0], value[1], value[2]);
            else if (value.length === 4) effect.setFloat4(name, value[0], value[1], value[2], value[3]);
            else effect.setMatrix3x3(name, value as Float32Array);
        }
        effect.setFloat("light_scale", scene.environmentIntensity * material.environmentIntensity * (environment?.level ?? 1));
    }

    override dispose(): void {
        this.state.leave?.();
        for (const texture of this.textures.values()) texture.dispose();
    }
}

/** A material of grooves over a black layer. */
export function gratingMaterial(name: string, scene: Scene, options: GratingOptions): PBRMaterial {
    const material = Object.assign(new PBRMaterial(name, scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0.3 });
    new GratingPlugin(material, options);
    return material;
}
