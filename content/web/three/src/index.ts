export { GratingMaterial } from "./material.js";
export type { GratingParameters } from "./graded.js";
export type { Representation } from "./surface.js";
export { FilmMaterial, type FilmParameters } from "./film_material.js";
export { FilmExtension, GratingExtension } from "./gltf.js";
export { Rowland, type Efficiencies } from "./rowland.js";
export type { Grooves } from "./frames.js";
