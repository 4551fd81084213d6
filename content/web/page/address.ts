import type { Representation } from "@rowland/three";
import { LIGHT_NAMES } from "./lights.js";

/** The settings in the address after #: `scene=cabinet&light=Night`, `sample=CD&representation=arc&material={…}`. */
export interface Settings {
    scene: number;
    sample?: string;
    light: number;
    representation?: Representation;
    material?: object; // in place of the sample's
}

export const SCENE_NAMES = ["cabinet", "samples", "films"];
const REPRESENTATIONS = ["planar", "arc", "direct"];

function choice(params: URLSearchParams, key: string, names: string[]): number | undefined {
    const value = params.get(key);
    if (value === null) return undefined;
    const index = names.indexOf(value);
    if (index < 0) throw new Error(`the address: expected ${key} to be one of ${names.join(", ")}, found "${value}"`);
    return index;
}

export function settingsOf(address: string): Settings {
    const params = new URLSearchParams(address.replace(/^#/, ""));
    const representation = choice(params, "representation", REPRESENTATIONS);
    const material = params.get("material");
    return {
        // A link to one sample, as in a trade report, opens the scene of samples.
        scene: choice(params, "scene", SCENE_NAMES) ?? (params.has("sample") ? 1 : 0),
        sample: params.get("sample") ?? undefined,
        light: choice(params, "light", LIGHT_NAMES) ?? 0,
        representation: representation === undefined ? undefined : (REPRESENTATIONS[representation] as Representation),
        material: material === null ? undefined : JSON.parse(material),
    };
}

export function addressOf({ scene, sample, light, representation, material }: Settings): string {
    const params = new URLSearchParams({ scene: SCENE_NAMES[scene], light: LIGHT_NAMES[light] });
    if (sample) params.set("sample", sample);
    if (representation) params.set("representation", representation);
    if (material) params.set("material", JSON.stringify(material));
    return "#" + params;
}
