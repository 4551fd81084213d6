import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import type { Effect } from "@babylonjs/core/Materials/effect.js";
import type { MaterialDefines } from "@babylonjs/core/Materials/materialDefines.js";
import type { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { AbstractMesh } from "@babylonjs/core/Meshes/abstractMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import { Texture, type Vector4 } from "./engine.js";
import { FILM_TABLE, FRAGMENT, VERTEX } from "./shared/generated/shaders.js";

const OPTIONS = ["ROWLAND", "ROWLAND_PLANAR", "ROWLAND_ARC", "ROWLAND_DIFFRACTION_ONLY", "ROWLAND_MAXIMUM_KEY_LOBES", "ROWLAND_GROOVE_UV",
    "KERNEL_VIEWS", "LOBE_GAUSSIAN", "LOBE_PITS", "COVER", "ZERO_ORDER", "LOBE_MAP", "HALF_TURN", "PITCH_AXIS", "GROOVE_GAPS", "GROOVES_EVEN", "GROOVE_SPARKLE",
    "VIEW_MAPPING", "TABLE_COLUMNS", "TABLE_ROWS", "LAYERS", "ROWLAND_FILM", "FILM_LINE", "FILM_ROUGHNESSES", "FILM_PATHS"];
const DEFINES = Object.fromEntries(OPTIONS.map((name) => [name, false]));

/** The type of each uniform by its name; of textures, sampler2D or others. */
const TYPES = new Map([...(VERTEX + FRAGMENT + FILM_TABLE).matchAll(/uniform (\w+) (\w+);|STORAGE\(\d+,\w+,\w+,(\w+)\)/g)]
    .map(([, type = "sampler2D", name, stored]) => [name ?? stored, type]));
const SETTERS = { int: "setInt", float: "setFloat", vec2: "setVector2", vec3: "setVector3", vec4: "setVector4", mat3: "setMatrix3x3" } as const;
const KEY_LOBE = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
const isNumber = (name: string) => TYPES.get(name)! in SETTERS;
const UNIFORMS = [...[...TYPES.keys()].filter(isNumber),
    ...Array.from({ length: 64 }, (_, light) => KEY_LOBE.map((member) => `key_lobes[${light}].${member}`)).flat()];
const SAMPLERS = [...TYPES.keys()].filter((name) => !isNumber(name));

/** GLSL's own preprocessor evaluates "# if"; Babylon's, which evaluates "#if", knows neither all operators nor continued lines. */
export const only = (condition: string, text: string): string => `# if ${condition}\n${text.replace(/^#(?=\w)/gm, "# ")}\n# endif`;

/** What @rowland/three's build leaves out of its GLSL. */
export const definitions = (text: string): string =>
    ["int", "sampler2D", "sampler2DArray", "sampler3D"].map((type) => `precision highp ${type};\n`).join("") + text;

/** A plug-in whose GLSL reads @rowland/three's values. WebGL 2 alone. */
export abstract class ValuesPlugin extends MaterialPluginBase {
    /** By the name of their uniform. */
    protected abstract readonly values: Record<string, { value: unknown }>;
    /** By the name of their define. */
    protected abstract readonly options: ReadonlyMap<string, string>;
    private stale = false;

    constructor(protected readonly material: PBRMaterial, name: string) {
        super(material, name, 300, DEFINES, true, false);
        this.doNotSerialize = true; // without its workers it would show nothing
        this.registerForExtraEvents = true; // hardBindForSubMesh
        this._enable(true);
    }

    override getUniforms() {
        return { externalUniforms: UNIFORMS };
    }

    override getSamplers(samplers: string[]): void {
        samplers.push(...SAMPLERS);
    }

    override prepareDefinesBeforeAttributes(defines: MaterialDefines, _: Scene, __: AbstractMesh): void {
        for (const name of OPTIONS) defines[name] = this.options.get(name) ?? false;
    }

    /** Textures are made here, as in hardBindForSubMesh() one that is new would take the unit of the one before. */
    valueAdded(name: string): void {
        const { value } = this.values[name];
        if (value instanceof Texture) value.of(this.material.getScene());
    }

    /** The program is compiled again. */
    optionsChanged(): void {
        this.stale = this.material.getScene().blockMaterialDirtyMechanism; // while a glTF loads
        if (!this.stale) this.markAllDefinesAsDirty();
    }

    protected bind(effect: Effect | null, scene: Scene): void {
        if (this.stale) this.optionsChanged();
        if (!effect) return;
        for (const [name, { value }] of Object.entries(this.values)) {
            if (value instanceof Texture) effect.setTexture(name, value.of(scene));
            else if (name === "key_lobes")
                (value as Record<string, Vector4>[]).forEach((one, i) => KEY_LOBE.forEach((member) => effect.setVector4(`key_lobes[${i}].${member}`, one[member])));
            else effect[SETTERS[TYPES.get(name) as keyof typeof SETTERS]](name, value as never);
        }
    }
}
