/** Foil recipes as the studio edits them: content/README.md, "Foil cards". */
import { ARTWORK_NAMES, PAIR } from "./artworks.js";

export interface Foil {
    type: string;
    [key: string]: string | number | number[];
}

export interface Recipe {
    artwork: string;
    mask?: string;
    foil: Foil;
    ink?: string;
    under?: string;
    lacquer?: { gloss?: boolean; tint?: number[] };
    card?: { corner_mm?: number; back?: string };
}

/** A slider on a number of the foil. */
export interface Knob {
    label: string;
    key: string;
    /** Of a pair of numbers. */
    index?: number;
    from: number;
    to: number;
    step: number;
    value: number;
    /** Of the type's own choices, instead of a number. */
    choices?: string[];
}

export interface Type {
    name: string;
    label: string;
    knobs: Knob[];
    /** Pictures that it takes: keys of the recipe. */
    pictures: { key: string; label: string }[];
    /** What the light does along the grooves can be chosen. */
    spread?: number;
}

const knob = (label: string, key: string, from: number, to: number, step: number, value: number, index?: number): Knob =>
    ({ label, key, from, to, step, value, index });
const CENTRE = [knob("Centre across", "centre", 0, 1, 0.01, 0.5, 0), knob("Centre up", "centre", 0, 1, 0.01, 0.5, 1)];
const CELLS = [knob("Size, mm", "size_mm", 1, 20, 0.5, 5), knob("Directions", "directions", 2, 36, 1, 12)];

/** In the order of FoilType in modules/diffraction/foil/recipe.h, with its default numbers. */
export const TYPES: Type[] = [
    { name: "pillars", label: "Pillars", pictures: [], knobs: [knob("Band, mm", "band_mm", 2, 40, 0.5, 9), knob("Colours a band", "pitch_range", 1.1, 2, 0.05, 1.5)] },
    { name: "rainbow", label: "Rainbow", pictures: [], knobs: [], spread: 12 },
    { name: "radial", label: "Radial", pictures: [], knobs: [{ ...knob("Grooves", "grooves", 0, 1, 1, 0), choices: ["rays", "circles"] }, ...CENTRE], spread: 6 },
    { name: "tiles", label: "Tiles", pictures: [], knobs: CELLS, spread: 8 },
    { name: "hexagons", label: "Hexagons", pictures: [], knobs: CELLS, spread: 8 },
    { name: "cosmos", label: "Cosmos", pictures: [], knobs: [knob("Largest, mm", "size_mm", 2, 30, 0.5, 12)], spread: 8 },
    { name: "cracked_ice", label: "Cracked ice", pictures: [], knobs: [knob("Shards, mm", "size_mm", 1, 30, 0.5, 7)], spread: 8 },
    { name: "glitter", label: "Glitter", pictures: [], knobs: [knob("Grains, µm", "size_um", 60, 1000, 10, 120)], spread: 6 },
    {
        name: "brushed", label: "Brushed", pictures: [], spread: 8,
        knobs: [knob("Strokes, mm", "stroke_mm", 0.05, 2, 0.05, 0.15), knob("Length, mm", "length_mm", 1, 60, 1, 12), knob("Unrest, °", "angle_spread_deg", 0, 45, 1, 8)],
    },
    {
        name: "two_pictures", label: "Two pictures", pictures: [{ key: "picture_a", label: "First" }, { key: "picture_b", label: "Second" }],
        knobs: [knob("First at, °", "tilts_deg", -30, 0, 1, -10, 0), knob("Second at, °", "tilts_deg", 0, 30, 1, 10, 1), knob("Lamp above, °", "lamp_deg", 20, 70, 1, 40),
            knob("Cells, mm", "cell_mm", 0.05, 0.5, 0.01, 0.09)],
    },
    { name: "lens", label: "Lens", pictures: [], knobs: [knob("Focus, mm", "focal_mm", 20, 300, 5, 60), ...CENTRE] },
    { name: "own", label: "Own", pictures: [{ key: "drawing", label: "Drawing" }], knobs: [knob("Smooth, mm", "smooth_mm", 0.1, 6, 0.1, 0.6)], spread: 8 },
];

export const typeOf = (recipe: Recipe): Type => TYPES.find(({ name }) => name === recipe.foil.type)!;

export const COMMON: Knob[] = [
    knob("Scale, ×", "scale", 0.2, 5, 0.1, 1), knob("Direction, °", "direction_deg", -180, 180, 5, 0), knob("Grooves, µm", "groove_um", 0.6, 4, 0.05, 1),
    knob("Variation", "seed", 1, 50, 1, 1),
];

export const FIRST: Recipe = { artwork: ARTWORK_NAMES[0], foil: { type: "cracked_ice" } };

/** The foil as another type: what all types have stays. */
export function withType(recipe: Recipe, name: string): Recipe {
    const foil: Foil = { type: name };
    const type = TYPES.find((one) => one.name === name)!;
    for (const { key } of COMMON) if (key in recipe.foil) foil[key] = recipe.foil[key];
    if (type.spread && "spread_deg" in recipe.foil) foil.spread_deg = recipe.foil.spread_deg;
    type.pictures.forEach(({ key }, i) => (foil[key] = name === "own" ? recipe.artwork : PAIR[i]));
    return { ...recipe, foil };
}

export function valueOf(recipe: Recipe, { key, index, value, choices }: Knob): number {
    const found = recipe.foil[key];
    if (found === undefined) return value;
    if (choices) return choices.indexOf(String(found));
    return index === undefined ? Number(found) : (found as number[])[index];
}

export function withValue(recipe: Recipe, { key, index, choices }: Knob, value: number, knobs: Knob[]): Recipe {
    if (choices) return { ...recipe, foil: { ...recipe.foil, [key]: choices[value] } };
    if (index === undefined) return { ...recipe, foil: { ...recipe.foil, [key]: value } };
    const pair = knobs.filter((other) => other.key === key).map((other) => (other.index === index ? value : valueOf(recipe, other)));
    return { ...recipe, foil: { ...recipe.foil, [key]: pair } };
}

/** The names of the pictures that a recipe takes. */
export function picturesOf(recipe: Recipe): string[] {
    const own = typeOf(recipe)?.pictures.map(({ key }) => String(recipe.foil[key] ?? "")) ?? [];
    return [...new Set([recipe.artwork, recipe.mask ?? "", recipe.card?.back ?? "", ...own])].filter((name) => name !== "");
}

/** A recipe of an address: its shape is checked here, its numbers by the foil library. */
export function checkedRecipe(given: unknown): Recipe {
    const recipe = { ...FIRST, ...(given as Recipe) };
    if (typeof recipe.artwork !== "string" || typeof recipe.foil !== "object" || recipe.foil === null || !typeOf(recipe))
        throw new Error(`the address: expected a foil recipe whose type is one of ${TYPES.map(({ name }) => name).join(", ")}`);
    return recipe;
}
