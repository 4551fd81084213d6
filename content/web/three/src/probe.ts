import { DataUtils, FloatType, HalfFloatType, type DataTexture, type Texture } from "three";
import { Rowland as Workers, type Panorama } from "./rowland.js";

/** RGB texels of a texture that three's HDR or EXR loader gives, row 0 at the top. */
export function texelsOf(texture: Texture): Panorama {
    const { data, width, height } = (texture as DataTexture).image as { data: ArrayLike<number>; width: number; height: number };
    if (!data || !(texture.type === FloatType || texture.type === HalfFloatType))
        throw new Error("the probe: expected an equirectangular DataTexture of floats or halves, as HDRLoader or EXRLoader gives");
    const components = data.length / (width * height);
    const texels = new Float32Array(3 * width * height);
    const number = texture.type === HalfFloatType ? DataUtils.fromHalfFloat : (x: number) => x;
    for (let row = 0; row < height; ++row) {
        // Row 0 of a texture that is not flipped on upload is at the bottom.
        const from = texture.flipY ? row : height - 1 - row;
        for (let column = 0; column < width; ++column)
            for (let c = 0; c < 3; ++c)
                texels[3 * (row * width + column) + c] = number(data[components * (from * width + column) + c]);
    }
    return { texels, width, height };
}

/** The workers that bake materials and light, the latter from three's textures. One Rowland for a page. */
export class Rowland extends Workers {
    override setProbe(light: Texture | Panorama, options?: { keyLights?: number | "later" }): Promise<void> {
        return super.setProbe("isTexture" in light ? texelsOf(light) : light, options);
    }
}
