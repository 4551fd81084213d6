export { GratingMaterial, type GratingParameters, type Representation } from "./material.js";
export { GratingExtension } from "./gltf.js";
export { Rowland, type Efficiencies } from "./rowland.js";
export type { Grooves } from "./frames.js";
