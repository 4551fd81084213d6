import { ArcRotateCamera, CreateDisc, DirectionalLight, Engine, HDRCubeTexture, Scene, Vector3 } from "@babylonjs/core";
import { gratingMaterial, readPanorama, Rowland } from "@rowland/babylon";

const engine = new Engine(document.querySelector("canvas"), true);
const scene = new Scene(engine);
new ArcRotateCamera("eye", -1.3, 1.1, 0.2, Vector3.Zero(), scene).minZ = 0.01;
const rowland = new Rowland();
const grating = { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 90 } };
const disc = CreateDisc("cd", { radius: 0.06, tessellation: 128 }, scene);
disc.material = gratingMaterial("cd", scene, { rowland, grating: { grating, metal: "Al", cover: { ior: 1.58 } } });
new DirectionalLight("lamp", new Vector3(0.1, 0.1, 1), scene).intensity = 0.5;
scene.environmentTexture = new HDRCubeTexture("light.hdr", scene, 256);
await rowland.setProbe(await readPanorama("light.hdr"));
engine.runRenderLoop(() => scene.render());
