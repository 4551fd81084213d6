import { planeTexture, Vector4, type Texture } from "./engine.js";
import type { FilmSource, FilmTable } from "./tasks.js";

export interface Layer {
    readonly ior: number;
    readonly thickness_nm: number;
}

/** Members of a film material file that the material follows. */
export interface FilmFile {
    readonly film: Layer | readonly Layer[];
    readonly roughness?: number;
    readonly base?: object;
    readonly metal?: string;
}

/** What film_lookup.glsl reads. */
export interface FilmValues {
    readonly film_table: Texture;
    readonly film_path: Vector4;
    readonly film_axes: Vector4;
    readonly film_rough: number; // 1 if the table is for the material's roughness
}

/** Which of its looks a table has: a line of texels, rows of roughnesses, or of path differences. */
export type FilmRows = "FILM_LINE" | "FILM_ROUGHNESSES" | "FILM_PATHS";

/** The material beneath a film, and what textures vary. */
export interface FilmBase {
    readonly ior: number;
    readonly colour: readonly number[]; // linear
    readonly metalness: number;
    /** Of the outermost layer, whose thickness a texture varies from this to the film's own. */
    readonly least_nm?: number;
    readonly roughnessVaries: boolean;
}

/** Members of KHR_materials_iridescence. */
export interface Iridescence {
    readonly iridescenceFactor?: number;
    readonly iridescenceTexture?: { index: number };
    readonly iridescenceIor?: number;
    readonly iridescenceThicknessMinimum?: number;
    readonly iridescenceThicknessMaximum?: number;
    readonly iridescenceThicknessTexture?: { index: number };
    readonly extras?: { readonly metal?: string; readonly base?: object; readonly illuminant?: string };
}

/** The film of a glTF material. */
export const filmOf = ({ iridescenceIor: ior = 1.3, iridescenceThicknessMaximum: thickness_nm = 400, extras = {} }: Iridescence, roughness: number) => {
    const { metal, base, illuminant } = extras;
    return { film: { ior, thickness_nm }, metal, base, illuminant, roughness };
};

/** What Rowland.filmTable() takes. */
export function filmSource({ film, roughness = 0, ...rest }: FilmFile, { ior, colour, metalness, least_nm, roughnessVaries }: FilmBase): FilmSource {
    const varies = least_nm !== undefined;
    if (varies && roughnessVaries)
        throw new Error("the film: iridescenceThicknessMap beside roughnessMap; expected one of them: a table varies one");
    const layers = [film].flat();
    const { thickness_nm } = layers[0] ?? {};
    const known = rest.base !== undefined || rest.metal !== undefined;
    const named = known ? rest : { ...rest, base: { ior } };
    const range = varies ? [least_nm, thickness_nm].sort((a, b) => a - b) : [-1, thickness_nm];
    const outermost = { ...layers[0], thickness_nm: range[1] };
    const dielectric = ((ior - 1) / (ior + 1)) ** 2;
    return {
        json: JSON.stringify({ film: [outermost, ...layers.slice(1)], roughness, ...named }), thinnest_nm: range[0],
        smoothest: roughnessVaries ? 0 : -1,
        base: known ? [-1, -1, -1] : colour.map((metal) => dielectric + (metal - dielectric) * metalness),
    };
}

/** `roughness`: the film's. */
export const filmValues = ({ path, axes, table }: FilmTable, roughness: number): FilmValues => ({
    film_table: planeTexture(table, false), film_path: new Vector4(...path), film_axes: new Vector4(...axes), film_rough: roughness > 0 ? 1 : 0,
});

export const filmRows = ({ byRoughness, table }: FilmTable): FilmRows =>
    byRoughness ? "FILM_ROUGHNESSES" : table.height === 1 ? "FILM_LINE" : "FILM_PATHS";
