import type { Representation } from "@rowland/three";
import { LIGHT_NAMES } from "./lights.js";

/** The settings in the address after #: `scene=cabinet&light=Night`, `sample=CD&representation=arc&material={…}`. */
export interface Settings {
    scene: number;
    sample?: string;
    light: number;
    representation?: Representation;
    material?: object; // in place of the sample's
    foil?: object; // a recipe
    art?: string; // its artwork, a WebP as base64
}

export const SCENE_NAMES = ["cabinet", "samples", "foil", "films"];
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
    const [material, foil] = ["material", "foil"].map((key) => {
        try {
            return params.has(key) ? JSON.parse(params.get(key)!) : undefined;
        } catch {
            throw new Error(`the address: expected JSON after ${key}=, found "${params.get(key)!.slice(0, 40)}"; copy the link as a whole`);
        }
    });
    // A link to one sample, as in a trade report, opens the scene of samples.
    const scene = choice(params, "scene", SCENE_NAMES) ?? (params.has("sample") ? 1 : 0);
    return {
        scene,
        sample: params.get("sample") ?? undefined,
        // Small lamps make a foil's colours pure.
        light: choice(params, "light", LIGHT_NAMES) ?? (SCENE_NAMES[scene] === "foil" ? LIGHT_NAMES.indexOf("Spotlights") : 0),
        representation: representation === undefined ? undefined : (REPRESENTATIONS[representation] as Representation),
        material,
        foil,
        art: params.get("art")?.replaceAll(" ", "+"),
    };
}

export function addressOf({ scene, sample, light, representation, material, foil, art }: Settings): string {
    const params = new URLSearchParams({ scene: SCENE_NAMES[scene], light: LIGHT_NAMES[light] });
    if (sample) params.set("sample", sample);
    if (representation) params.set("representation", representation);
    if (material) params.set("material", JSON.stringify(material));
    if (foil) params.set("foil", JSON.stringify(foil));
    if (art) params.set("art", art);
    return "#" + params;
}
