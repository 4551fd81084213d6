export { GratingMaterial, type GratingParameters, type Representation } from "./material.js";
export { FilmMaterial, type FilmParameters } from "./film_material.js";
export { FilmExtension, GratingExtension } from "./gltf.js";
export { Rowland, type Efficiencies } from "./rowland.js";
export type { Grooves } from "./frames.js";
