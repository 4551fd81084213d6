/** What grating_state.ts takes from its engine, which here is three. @rowland/babylon has a file of the same names. */
export { Matrix3, Texture, Vector2, Vector3, Vector4, type BufferGeometry, type Object3D, type Scene } from "three";
export { flatNormal, groovesOf, worldFrames, worldNormal, type Grooves } from "./frames.js";
export { grooveMap, rotationsOf, type GrooveMap } from "./groove_map.js";
export { arrayTexture, planeTexture, storageTexture, takeContent, volumeTexture } from "./textures.js";
