import { RGBE_ReadHeader, RGBE_ReadPixels } from "@babylonjs/core/Misc/HighDynamicRange/hdr.js";
import type { Panorama } from "../../three/src/rowland.js";

/** A Radiance file (.hdr), as HDRCubeTexture shows it. */
export async function readPanorama(url: string): Promise<Panorama> {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    const bytes = new Uint8Array(await response.arrayBuffer());
    const { width, height, ...header } = RGBE_ReadHeader(bytes);
    return { texels: RGBE_ReadPixels(bytes, { width, height, ...header }), width, height };
}
