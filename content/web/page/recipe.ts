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

/** A number in the schema of recipes, or a list of them. */
interface Member {
    type: "number" | "integer" | "array";
    minimum: number;
    maximum: number;
    default?: number | number[];
    items?: Member;
    enum?: string[];
}

/** What `rowland-cook schema foil` prints, by the names of types and of keys. build.mjs asks the foil library for it. */
declare const FOIL_SCHEMA: { foil: Record<string, Record<string, Member>>; card: Record<string, Member> };

/** A slider on a number. */
export interface Knob {
    label: string;
    key: string;
    /** Of a pair of numbers. */
    index?: number;
    from: number;
    to: number;
    step: number;
    value: number;
    /** Equal distances on the slider are equal ratios, and numbers have two digits; else `step` rounds them. */
    logarithmic: boolean;
    whole: boolean;
    /** Of the type's own choices, instead of a number. */
    choices?: string[];
}

/** How the studio shows a key: its label, the step of the slider and its most, where the schema's is beyond use. */
interface Shown {
    label: string;
    key: string;
    index?: number;
    step?: number;
    most?: number;
}

export interface Type {
    name: string;
    label: string;
    knobs: Knob[];
    /** Pictures that it takes: keys of the recipe. */
    pictures: { key: string; label: string }[];
}

const UNITS: Record<string, string> = { mm: ", mm", um: ", µm", deg: ", °", scale: ", ×" };

function knobOf(members: Record<string, Member>, { label, key, index, step = 1, most = Infinity }: Shown): Knob {
    const member = members[key];
    const unit = key.split("_").at(-1)!;
    const { minimum: from, maximum, type } = member.items ?? member;
    const to = Math.min(maximum, most);
    const value = index === undefined ? member.default : (member.default as number[])[index];
    return {
        label: label + (UNITS[unit] ?? ""), key, index, from, to, step, value: (value as number) ?? 0, choices: member.enum,
        logarithmic: unit !== "deg" && from > 0 && to >= 10 * from, whole: type === "integer",
    };
}

const CENTRE: Shown[] = [{ label: "Centre across", key: "centre", index: 0, step: 0.01 }, { label: "Centre up", key: "centre", index: 1, step: 0.01 }];
const CELLS: Shown[] = [{ label: "Size", key: "size_mm" }, { label: "Directions", key: "directions" }];
const SPREAD: Shown = { label: "Sparkle to calm", key: "spread_deg" };
const COMMON: Shown[] = [
    { label: "Scale", key: "scale" }, { label: "Direction", key: "direction_deg", step: 5 }, { label: "Grooves", key: "groove_um" }, { label: "Variation", key: "seed", most: 50 },
];

/** In the order of the studio's buttons. */
const SHOWN: { name: string; label: string; knobs?: Shown[]; common?: Shown[]; pictures?: { key: string; label: string }[] }[] = [
    { name: "pillars", label: "Pillars", knobs: [{ label: "Band", key: "band_mm" }, { label: "Colours a band", key: "pitch_range", step: 0.05 }] },
    { name: "rainbow", label: "Rainbow", common: [...COMMON, SPREAD] },
    { name: "radial", label: "Radial", knobs: [{ label: "Grooves", key: "grooves" }, ...CENTRE], common: [...COMMON, SPREAD] },
    { name: "tiles", label: "Tiles", knobs: CELLS, common: [...COMMON, SPREAD] },
    { name: "hexagons", label: "Hexagons", knobs: CELLS, common: [...COMMON, SPREAD] },
    { name: "cosmos", label: "Cosmos", knobs: [{ label: "Largest", key: "size_mm" }], common: [...COMMON, SPREAD] },
    { name: "cracked_ice", label: "Cracked ice", knobs: [{ label: "Shards", key: "size_mm" }], common: [...COMMON, SPREAD] },
    { name: "glitter", label: "Glitter", knobs: [{ label: "Grains", key: "size_um" }], common: [...COMMON, SPREAD] },
    {
        name: "brushed", label: "Brushed", common: [...COMMON, SPREAD],
        knobs: [{ label: "Strokes", key: "stroke_mm" }, { label: "Length", key: "length_mm" }, { label: "Unrest", key: "angle_spread_deg" }],
    },
    {
        name: "two_pictures", label: "Two pictures", common: COMMON.slice(0, 1), pictures: [{ key: "picture_a", label: "First" }, { key: "picture_b", label: "Second" }],
        knobs: [{ label: "First at", key: "tilts_deg", index: 0 }, { label: "Second at", key: "tilts_deg", index: 1 }, { label: "Lamp above", key: "lamp_deg" },
            { label: "Cells", key: "cell_mm" }],
    },
    { name: "lens", label: "Lens", knobs: [{ label: "Focus", key: "focal_mm" }, ...CENTRE] },
    { name: "own", label: "Own", pictures: [{ key: "drawing", label: "Drawing" }], knobs: [{ label: "Smooth", key: "smooth_mm" }], common: [...COMMON, SPREAD] },
];

export const TYPES: Type[] = SHOWN.map(({ name, label, knobs = [], common = COMMON, pictures = [] }) =>
    ({ name, label, pictures, knobs: [...knobs, ...common].map((shown) => knobOf(FOIL_SCHEMA.foil[name], shown)) }));

/** A larger radius would take the card's round edge from its artwork. */
export const CORNERS = knobOf(FOIL_SCHEMA.card, { label: "Corners", key: "corner_mm", step: 0.5, most: 12 });

export const typeOf = (recipe: Recipe): Type => TYPES.find(({ name }) => name === recipe.foil.type)!;

export const FIRST: Recipe = { artwork: ARTWORK_NAMES[0], foil: { type: "cracked_ice" } };

/** The foil as another type: what both types have in common stays. */
export function withType(recipe: Recipe, name: string): Recipe {
    const foil: Foil = { type: name };
    const type = TYPES.find((one) => one.name === name)!;
    for (const { key } of [...COMMON, SPREAD])
        if (key in recipe.foil && type.knobs.some((knob) => knob.key === key)) foil[key] = recipe.foil[key];
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

/** Positions of a logarithmic slider, from 0. */
export const POSITIONS = 200;

export const positionOf = ({ from, to }: Knob, value: number) => (POSITIONS * Math.log(value / from)) / Math.log(to / from);

export function numberAt({ from, to, whole }: Knob, position: number): number {
    const number = Number((from * (to / from) ** (position / POSITIONS)).toPrecision(2));
    return Math.min(Math.max(whole ? Math.round(number) : number, from), to);
}

/** The recipe with a picture for a key: "artwork", "mask", "back", or one of the type's. */
export function withPicture(recipe: Recipe, key: string, name: string): Recipe {
    if (key === "back") return { ...recipe, card: { ...recipe.card, back: name } };
    if (key === "artwork" || key === "mask") return { ...recipe, [key]: name };
    return { ...recipe, foil: { ...recipe.foil, [key]: name } };
}

export function withoutPicture(recipe: Recipe, key: "mask" | "back"): Recipe {
    const { mask, ...others } = recipe;
    if (key === "mask") return others;
    const { back, ...card } = recipe.card ?? {};
    return { ...recipe, card };
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
