export { GratingMaterial, type GratingParameters, type Representation } from "./material.js";
export { GratingExtension } from "./gltf.js";
export { Rowland } from "./probe.js";
export type { Efficiencies, Panorama } from "./rowland.js";
export type { Grooves } from "./frames.js";
