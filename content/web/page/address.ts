import type { Representation } from "@rowland/three";
import { LIGHT_NAMES } from "./lights.js";
import { SAMPLES } from "./samples.js";

/** What the address names after #: `sample=CD&light=Night&representation=arc&material={…}`. */
export interface Settings {
    sample: number;
    light: number;
    representation?: Representation;
    material?: object; // in place of the sample's
}

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
        sample: choice(words, "sample", SAMPLES.map(({ name }) => name)) ?? 0,
        light: choice(words, "light", LIGHT_NAMES) ?? 0,
        representation: representation === undefined ? undefined : (REPRESENTATIONS[representation] as Representation),
        material: material === null ? undefined : JSON.parse(material),
    };
}

export function addressOf({ sample, light, representation, material }: Settings): string {
    const words = new URLSearchParams({ sample: SAMPLES[sample].name, light: LIGHT_NAMES[light] });
    if (representation) words.set("representation", representation);
    if (material) words.set("material", JSON.stringify(material));
    return "#" + words;
}
