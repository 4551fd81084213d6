import { RGBE_ReadHeader, RGBE_ReadPixels } from "@babylonjs/core/Misc/HighDynamicRange/hdr.js";
import type { Panorama } from "./shared/rowland.js";

export { FilmPlugin, filmMaterial, type FilmSettings } from "./film.js";
export { registerFilms, registerGratings } from "./gltf.js";
export { GratingPlugin, gratingMaterial } from "./grating.js";
export { Rowland, type Efficiencies, type Panorama } from "./shared/rowland.js";
export type { GratingSettings } from "./shared/grating_state.js";
export type { Representation } from "./shared/surface.js";
export type { Grooves } from "./engine.js";

/** A Radiance file (.hdr), as HDRCubeTexture shows it. */
export async function readPanorama(url: string): Promise<Panorama> {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    const bytes = new Uint8Array(await response.arrayBuffer());
    const header = RGBE_ReadHeader(bytes);
    return { texels: RGBE_ReadPixels(bytes, header), width: header.width, height: header.height };
}
