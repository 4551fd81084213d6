export { GratingMaterial } from "./material.js";
export type { GratingParameters } from "./with_grating.js";
export type { Representation } from "./surface.js";
export { FilmMaterial } from "./film_material.js";
export type { FilmParameters } from "./with_film.js";
export { FilmExtension, GratingExtension } from "./gltf.js";
export { Rowland } from "./probe.js";
export type { Efficiencies, Panorama } from "./rowland.js";
export type { Grooves } from "./frames.js";
