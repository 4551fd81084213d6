import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingExtension, Rowland } from "@rowland/three";

const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector("canvas") ?? undefined });
const camera = new THREE.PerspectiveCamera(35, 16 / 9, 0.01, 10);
camera.position.set(0, 0.3, 0.6);
camera.lookAt(0, 0, 0);

const rowland = new Rowland();
const light = await new HDRLoader().setDataType(THREE.FloatType).loadAsync("light.hdr");
const loader = new GLTFLoader().register((parser) => new GratingExtension(parser, rowland));
const scene = new THREE.Scene().add((await loader.loadAsync("scene.glb")).scene);
scene.environment = Object.assign(light, { mapping: THREE.EquirectangularReflectionMapping });
rowland.onUpdate = () => renderer.render(scene, camera);
await rowland.setProbe(light);
