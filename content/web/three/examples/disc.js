import * as THREE from "three";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingMaterial, Rowland } from "@rowland/three";

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(35, innerWidth / innerHeight, 0.01, 10);
camera.position.set(0, 0.15, 0.2);
camera.lookAt(0, 0, 0);

const rowland = new Rowland();
const cd = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 90 } }, metal: "Al", cover: { ior: 1.58 } };
scene.add(new THREE.Mesh(new THREE.RingGeometry(0.02, 0.06, 128, 8).rotateX(-1.2), new GratingMaterial({ rowland, grating: cd })));
const texels = new Float32Array(4 * 64 * 32).fill(0.5).fill(60, 4 * 64 * 24 + 80, 4 * 64 * 24 + 92); // a lamp in a grey room
const light = new THREE.DataTexture(texels, 64, 32, THREE.RGBAFormat, THREE.FloatType);
await rowland.setProbe(light); // or: await new HDRLoader().loadAsync("sunset.hdr")
renderer.setAnimationLoop(() => renderer.render(scene, camera));
