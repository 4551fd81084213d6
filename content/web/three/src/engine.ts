/** What grating_state.ts and surface.ts take from their engine, which here is three. @rowland/babylon has a file of these names. */
export {
    Matrix3, Texture, type Texture as GrooveTexture, Vector2, Vector3, Vector4, type BatchedMesh, type BufferGeometry, type InstancedMesh, type Object3D, type Scene,
} from "three";
export { frames, groovesOf, partsOf, planeNormal, poseKey, poseOf, probeFromWorld, type Grooves } from "./frames.js";
export {
    arrayTexture, coordinatesOf, grooveImage, mipmapTexture, MOST_STORED, planeTexture, storageTexture, takeContent, volumeTexture,
} from "./textures.js";
