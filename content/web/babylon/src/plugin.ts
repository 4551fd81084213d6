import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import type { MaterialDefines } from "@babylonjs/core/Materials/materialDefines.js";
import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { SubMesh } from "@babylonjs/core/Meshes/subMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import { Numbers, Texture, toProbe } from "./engine.js";
import { FRAGMENT, VERTEX } from "./shared/generated/shaders.js";
import { GratingState, type GratingOwner, type GratingSettings } from "./shared/grating_state.js";

const FLAGS = ["ROWLAND", "ROWLAND_PLANAR", "ROWLAND_ARC", "ROWLAND_DIFFRACTION_ONLY", "KERNEL_VIEWS",
    "LOBE_GAUSSIAN", "LOBE_PITS", "COVER", "ZERO_ORDER", "LOBE_MAP", "HALF_TURN", "PITCH_AXIS"];
const NUMBERS = ["ROWLAND_MAXIMUM_KEY_LOBES", "VIEW_MAPPING", "TABLE_COLUMNS", "TABLE_ROWS", "LAYERS"];
const DEFINES = Object.fromEntries([...FLAGS.map((name) => [name, false]), ...NUMBERS.map((name) => [name, 0])]);

const DECLARED = [...(VERTEX + FRAGMENT).matchAll(/uniform (\w+) (\w+);|STORAGE\(\d+,\w+,(\w+),(\w+)\)/g)];
const nameOf = ([, , uniform, , storage]: RegExpMatchArray) => uniform ?? storage;
const INTEGERS = new Set(DECLARED.filter(([, type]) => type === "int").map(nameOf));
const isSampler = ([, type]: RegExpMatchArray) => !type || type.startsWith("sampler");
const SAMPLERS = [...new Set(DECLARED.filter(isSampler).map(nameOf))];
const KEY_LOBE = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
const UNIFORMS = [...new Set(DECLARED.filter((one) => !isSampler(one)).map(nameOf)),
    ...Array.from({ length: 64 }, (_, light) => KEY_LOBE.map((member) => `key_lobes[${light}].${member}`)).flat()];

/** GLSL's own preprocessor evaluates "# if"; Babylon's, which evaluates "#if", knows neither all operators nor continued lines. */
const only = (text: string) => `# ifdef ROWLAND\n${text.replace(/^#(?=\w)/gm, "# ")}\n# endif`;

/** three's GLSL, which takes directions in its view, with Babylon's world for that, and with what its build leaves out. */
const definitions = (text: string) => "#define SHOWN_LAYERS LAYERS\n#define viewMatrix mat4(1.0)\n" +
    ["sampler2D", "sampler2DArray", "sampler3D"].map((type) => `precision highp ${type};\n`).join("") + text;
const CODE: Record<string, Record<string, string>> = {
    vertex: {
        CUSTOM_VERTEX_DEFINITIONS: only(definitions(VERTEX)),
        CUSTOM_VERTEX_UPDATE_WORLDPOS: only(`vec4 across = vec4(1.0);
#ifdef TANGENT
across = tangentUpdated;
#endif
groove_position = positionUpdated;
groove_normal = normalUpdated;
pass_grooves(normal, across, mat3(finalWorld), vNormalW, 0);`),
    },
    fragment: {
        CUSTOM_FRAGMENT_DEFINITIONS: only(definitions(FRAGMENT)),
        CUSTOM_FRAGMENT_BEFORE_LIGHTS: only("prepare_grooves(vEyePosition.xyz - vPositionW, vNormalW);"),
        // Each of Babylon's lights. The number of a light is in the line before.
        "!diffuseBase\\+=info\\.diffuse\\*shadowDebug(\\d+);\\n#else\\ndiffuseBase\\+=info\\.diffuse\\*shadow;":
            `diffuseBase+=info.diffuse*shadowDebug$1;
#else
diffuseBase+=info.diffuse*shadow;
` + only(`#if defined(DIRLIGHT$1) || defined(POINTLIGHT$1) || defined(SPOTLIGHT$1)
add_lamp(in_probe(preInfo.L), vLightingIntensity.x * preInfo.attenuation * shadow * diffuse$1.rgb);
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
#ifndef ROWLAND_DIFFRACTION_ONLY
// Colours outside the screen's gamut are desaturated until no component is negative.
finalColor.rgb -= min(min(finalColor.r, finalColor.g), min(finalColor.b, 0.0));
#endif`),
    },
};

/**
 * A diffraction grating over a PBRMaterial, which is the layer beneath it. `rowland`'s panorama and Babylon's lights light
 * both; until the first map or table arrives, only the layer is drawn. WebGL 2 alone.
 */
export class GratingPlugin extends MaterialPluginBase implements GratingOwner {
    readonly state: GratingState;
    private stale = false;

    constructor(private readonly material: PBRMaterial, settings: GratingSettings) {
        super(material, "Rowland", 300, DEFINES, true, false);
        this.doNotSerialize = true; // without its workers it would show nothing
        this.registerForExtraEvents = true; // hardBindForSubMesh
        this._enable(true);
        this.state = new GratingState(this);
        this.state.configure(settings);
    }

    override getClassName(): string {
        return "GratingPlugin";
    }

    /** Textures are made here, as in hardBindForSubMesh() one that is new would take the unit of the one before. */
    valueAdded(name: string): void {
        const { value } = this.state.values[name];
        if (value instanceof Texture) value.of(this.material.getScene());
    }

    valueChanged(name: string): void {
        this.valueAdded(name);
    }

    contentChanged(): void {}

    optionsChanged(): void {
        this.stale = this.material.getScene().blockMaterialDirtyMechanism; // while a glTF loads
        if (!this.stale) this.markAllDefinesAsDirty();
    }

    layerChanged(colour: [number, number, number], roughness: number): void {
        Object.assign(this.material, { albedoColor: new Color3(...colour), metallic: 0, roughness });
    }

    override prepareDefinesBeforeAttributes(defines: MaterialDefines): void {
        const { options } = this.state;
        const on = options.has("ROWLAND");
        for (const name of FLAGS) defines[name] = on && options.has(name);
        for (const name of NUMBERS) defines[name] = Number(options.get(name) ?? 0);
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
        const environmentIntensity = scene.environmentIntensity * material.environmentIntensity * (environment?.level ?? 1);
        state.see({ environmentIntensity, probe: toProbe(scene, environment) }, mesh, mesh);
        if (this.stale) this.optionsChanged();
        const effect = subMesh.effect;
        if (!effect || !state.options.has("ROWLAND")) return;
        const put = (name: string, value: unknown): void => {
            if (typeof value === "number") INTEGERS.has(name) ? effect.setInt(name, value) : effect.setFloat(name, value);
            else if (value instanceof Texture) effect.setTexture(name, value.of(scene));
            else if (Array.isArray(value))
                value.forEach((one, i) => Object.entries(one).forEach(([member, numbers]) => put(`${name}[${i}].${member}`, numbers)));
            else if (value instanceof Numbers) {
                const [x, y, z, w] = value.numbers;
                if (value.numbers.length === 2) effect.setFloat2(name, x, y);
                else if (value.numbers.length === 3) effect.setFloat3(name, x, y, z);
                else if (value.numbers.length === 4) effect.setFloat4(name, x, y, z, w);
                else effect.setMatrix3x3(name, Float32Array.from(value.numbers));
            }
        };
        for (const [name, { value }] of Object.entries(state.values)) put(name, value);
    }

    override dispose(): void {
        this.state.dispose();
    }
}

/** A material of grooves over a black layer. */
export function gratingMaterial(name: string, scene: Scene, settings: GratingSettings): PBRMaterial {
    const material = Object.assign(new PBRMaterial(name, scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0.3 });
    new GratingPlugin(material, settings);
    return material;
}
