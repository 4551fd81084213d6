export { GratingNodeMaterial } from "./node/material.js";
export { FilmNodeMaterial } from "./node/film_material.js";
export { FilmExtension, GratingExtension } from "./node/gltf.js";
export type { GratingParameters } from "./with_grating.js";
export type { Representation } from "./surface.js";
export { Rowland } from "./probe.js";
export type { Efficiencies } from "./rowland.js";
export type { Grooves } from "./frames.js";
export type { FilmParameters } from "./with_film.js";
