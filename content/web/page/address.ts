import type { Representation } from "@rowland/three";
import { LIGHT_NAMES } from "./lights.js";

/** What the address names after #: `scene=cabinet&light=Night`, `sample=CD&representation=arc&material={…}`. */
export interface Settings {
    scene: number;
    sample?: string;
    light: number;
    representation?: Representation;
    material?: object; // in place of the sample's
}

export const SCENE_NAMES = ["cabinet", "samples"];
const REPRESENTATIONS = ["planar", "arc", "direct"];

function choice(words: URLSearchParams, key: string, names: string[]): number | undefined {
    const word = words.get(key);
    if (word === null) return undefined;
    const index = names.indexOf(word);
    if (index < 0) throw new Error(`the address: expected ${key} to be one of ${names.join(", ")}, found "${word}"`);
    return index;
}

export function settingsOf(address: string): Settings {
    const words = new URLSearchParams(address.replace(/^#/, ""));
    const representation = choice(words, "representation", REPRESENTATIONS);
    const material = words.get("material");
    return {
        // An address of one sample, as a trade report gives it, is of the samples.
        scene: choice(words, "scene", SCENE_NAMES) ?? (words.has("sample") ? 1 : 0),
        sample: words.get("sample") ?? undefined,
        light: choice(words, "light", LIGHT_NAMES) ?? 0,
        representation: representation === undefined ? undefined : (REPRESENTATIONS[representation] as Representation),
        material: material === null ? undefined : JSON.parse(material),
    };
}

export function addressOf({ scene, sample, light, representation, material }: Settings): string {
    const words = new URLSearchParams({ scene: SCENE_NAMES[scene], light: LIGHT_NAMES[light] });
    if (sample) words.set("sample", sample);
    if (representation) words.set("representation", representation);
    if (material) words.set("material", JSON.stringify(material));
    return "#" + words;
}
