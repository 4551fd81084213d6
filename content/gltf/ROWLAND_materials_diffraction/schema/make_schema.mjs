// rowland-cook schema ROWLAND_materials_diffraction | node make_schema.mjs > material.ROWLAND_materials_diffraction.schema.json
// Makes the extension's schema in Khronos' form of the one that is recorded from the parser of the C++ programs: adds
// descriptions and defaults, and gives parts that occur several times a definition. Limits and names stay the parser's.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const NAME = "ROWLAND_materials_diffraction";

/** By the path of members; [description, default]. */
const TEXTS = {
    "grating": ["The relief: grooves of one direction, or a lattice that repeats along two."],
    "grating/pitch_nm": ["Distance d of neighbouring grooves, in nanometres."],
    "grating/profile": ["The form of a groove, or of a lattice's cell, which gives the orders' efficiencies."],
    "grating/theory": ["How efficiencies are computed: from the phase of the relief, or by Maxwell's equations. By default " +
        "\"rigorous\" for lamellar, sinusoidal and blazed grooves of a metal with pitches of 190 to 20000 nm, else \"scalar\"."],
    "grating/films": ["Transparent films on the relief, from the metal up, that follow it; of rigorous theory alone."],
    "grating/films/ior": ["Refractive index of the film."],
    "grating/films/thickness_nm": ["Thickness of the film in nanometres, at most the pitch."],
    "grating/grooves": ["Number N of grooves that are lit together. From 50 on orders are infinitely narrow.", 1500],
    "grating/orders": ["The diffraction orders that are shaded. \"all\": each but 0 that propagates for a visible wavelength. Of a " +
        "lattice one number: each (m, k) but (0, 0) with |m| and |k| up to it, by default 2; of grooves by default [-2, -1, 1, 2]."],
    "grating/normalization": ["Whether orders carry their efficiencies, or the peak heights of Agu's form; slits alone have both.", "energy"],
    "grating/groove_lobe": ["How light spreads along the grooves.", "flat"],
    "grating/groove_lobe/sigma": ["Standard deviation of the normal distribution of s_h + v_h."],
    "grating/groove_lobe/pits": ["Pits of one length along the track (Stam 1999)."],
    "grating/groove_lobe/pits/length_nm": ["Length of a pit in nanometres."],
    "grating/groove_lobe/pits/coherent": ["Fraction of the light that the track reflects as a groove without pits."],
    "grating/groove_lobe/pit_sequence": ["Pits at several spacings along the track (Sun et al. 2000)."],
    "grating/groove_lobe/pit_sequence/spacings_nm": ["Distances from pit to pit in nanometres, ascending, of equal weights."],
    "grating/groove_lobe/pit_sequence/coherent": ["Fraction of the light that the track reflects as a groove without pits.", 0.3],
    "grating/groove_lobe/pit_sequence/sigma": ["Standard deviation of the orders along the track.", 0.02],
    "grating/lattice": ["The sides of a cell along (g, h), in nanometres: each 300 nm to 10 mm long, at least 2 degrees apart."],
    "metal": ["The coating, whose reflectance multiplies all efficiencies. Without it a perfect mirror."],
    "cover": ["A transparent layer over the grooves."],
    "cover/ior": ["Refractive index of the layer."],
    "cover/tint": ["What the layer's dye passes on the way in, and again on the way out, at normal incidence; linear Rec.709.", [1, 1, 1]],
    "transmission": ["Makes the grating a thin sheet that light passes; not beside metal or cover."],
    "transmission/ior": ["Refractive index of the sheet."],
    "transmission/reflectance": ["Fraction of the light that the sheet reflects; it transmits the rest.", 0],
    "base": ["The layer beneath the grating. Without it: the glTF material's own surface, with its textures."],
    "base/color": ["Albedo, linear Rec.709.", [0, 0, 0]],
    "base/roughness": ["Perceptual roughness.", 0.3],
    "quality": ["How Rowland's own programs draw the material. It does not change what the material is: others ignore it."],
    "grooveRotation": ["Angle by which g, across the grooves, is rotated from the tangent toward the bitangent, in radians.", 0],
    "grooveTexture": ["Varies the grooves over the surface. R: further rotation over pi; G: half the pitch over pitch_nm, 0 where " +
        "there is no grating. Linear."],
    "grooveTexture/sparkle": ["Whether the texture holds facets of random directions, of which a pixel shows some.", false],
};

/** Descriptions and defaults where TEXTS has them; a default of a required member is a suggestion of editors, and left out. */
function annotate(schema, path, used) {
    for (const alternative of schema.oneOf ?? []) annotate(alternative, path, used);
    if (schema.items) annotate(schema.items, path, used);
    for (const [name, member] of Object.entries(schema.properties ?? {})) {
        const at = path ? `${path}/${name}` : name;
        if (schema.required?.includes(name)) delete member.default;
        annotate(member, at, used);
        if (!(at in TEXTS)) continue;
        used.add(at);
        const [description, initial] = TEXTS[at];
        const { ...rest } = member;
        for (const key of Object.keys(member)) delete member[key];
        Object.assign(member, { description, ...(initial === undefined ? {} : { default: initial }) }, rest);
    }
}

/** Moves alternatives that a constant "type" names into definitions. */
function define(schema, definitions) {
    for (const part of [schema.items, ...(schema.oneOf ?? []), ...Object.values(schema.properties ?? {})])
        if (part) define(part, definitions);
    schema.oneOf?.forEach((alternative, i) => {
        const type = alternative.properties?.type?.const;
        if (!type) return;
        const known = definitions[type];
        if (known && JSON.stringify(known) !== JSON.stringify(alternative)) throw new Error(`two profiles are called ${type}`);
        definitions[type] = alternative;
        schema.oneOf[i] = { $ref: `#/$defs/${type}` };
    });
}

/** `recorded`: what `rowland-cook schema` prints. */
export function extensionSchema(recorded) {
    const { $schema, title: _, ...schema } = structuredClone(recorded);
    schema.properties.quality = { type: "object" }; // of our own programs
    const used = new Set();
    annotate(schema, "", used);
    const unknown = Object.keys(TEXTS).filter((path) => !used.has(path));
    if (unknown.length > 0) throw new Error(`described members that the parser does not know: ${unknown}`);
    const bare = Object.keys(schema.properties).filter((name) => !(name in TEXTS) && name !== "extras" && name !== "extensions");
    if (bare.length > 0) throw new Error(`members without a description: ${bare}`);
    const $defs = {};
    define(schema, $defs);
    const { type, properties, ...rest } = schema;
    properties.grooveTexture.allOf = [{ $ref: "textureInfo.schema.json" }];
    return {
        $schema, $id: `material.${NAME}.schema.json`, title: `${NAME} glTF Material Extension`,
        description: "A diffraction grating on a material: a relief finer than a pixel, whose colours follow from its form.",
        type, allOf: [{ $ref: "glTFProperty.schema.json" }], properties, ...rest, $defs,
    };
}

/** With indentation by four; what fits into a line stays in one. */
export function textOf(value, indent = "") {
    const line = JSON.stringify(value, null, 1)?.replace(/\n\s*/g, " ");
    if (value === null || typeof value !== "object" || (line.length + indent.length < 110 && !line.includes('"description"'))) return line;
    const inner = indent + "    ";
    const parts = Array.isArray(value) ? value.map((one) => inner + textOf(one, inner))
        : Object.entries(value).map(([key, one]) => `${inner}${JSON.stringify(key)}: ${textOf(one, inner)}`);
    const [open, close] = Array.isArray(value) ? "[]" : "{}";
    return `${open}\n${parts.join(",\n")}\n${indent}${close}`;
}

if (import.meta.url === pathToFileURL(process.argv[1]).href)
    process.stdout.write(textOf(extensionSchema(JSON.parse(readFileSync(0, "utf8")))) + "\n");
