/**
 * The members of ROWLAND_materials_diffraction, as its schema has them; lengths in nanometres. What the numbers mean:
 * content/gltf/ROWLAND_materials_diffraction/README.md.
 */

export type Profile =
    | { type: "slit"; width_nm: number }
    | { type: "lamellar"; duty: number; depth_nm: number }
    | { type: "sinusoidal"; depth_nm: number }
    | { type: "blazed"; depth_nm: number }
    | { type: "table"; file: string };

export type GrooveLobe =
    | "flat"
    | { sigma: number }
    | { pits: { length_nm: number; coherent: number } }
    | { pit_sequence: { spacings_nm: number[]; coherent?: number; sigma?: number } };

/** Grooves of one direction. */
export interface Grooves {
    pitch_nm: number;
    profile: Profile;
    orders?: "all" | number[];
    theory?: "scalar" | "rigorous";
    films?: { ior: number; thickness_nm: number }[];
    groove_lobe?: GrooveLobe;
    grooves?: number;
    normalization?: "energy" | "agu";
}

export type CellProfile =
    | { type: "crossed"; along_a: Exclude<Profile, { type: "table" }>; along_b: Exclude<Profile, { type: "table" }> }
    | { type: "aperture"; width_nm: number; height_nm: number }
    | { type: "height_map"; file: string; depth_nm: number };

/** A surface that repeats along two directions. */
export interface Lattice {
    lattice: { a_nm: [number, number]; b_nm: [number, number] };
    profile: CellProfile;
    orders?: number;
}

/** The members that are JSON alone; a document's other members of the object, of later versions, are kept beside them. */
export interface Members {
    grating: Grooves | Lattice;
    metal?: "Al" | "Ag" | "Au" | "Cu";
    cover?: { ior: number; tint?: [number, number, number] };
    transmission?: { ior: number; reflectance?: number };
    base?: { color?: [number, number, number]; roughness?: number };
    quality?: Record<string, unknown>;
}
