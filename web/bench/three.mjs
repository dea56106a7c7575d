// What the page is measured against: the shortest page of three.js that shows an OBJ file lit by Phong's model.

import {
  AmbientLight, Box3, Color, DirectionalLight, MeshPhongMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";

const renderer = new WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);

const scene = new Scene();
scene.background = new Color(0x808080);
scene.add(new AmbientLight(0xffffff, 0.3));
const light = new DirectionalLight(0xffffff, 2);
light.position.set(1, 2, 3);
scene.add(light);

const object = await new OBJLoader().loadAsync(new URLSearchParams(location.search).get("open"));
const material = new MeshPhongMaterial({ color: 0xd08040, shininess: 40 });
object.traverse((child) => {
  if (child.isMesh) child.material = material;
});
scene.add(object);

const camera = new PerspectiveCamera(45, innerWidth / innerHeight, 0.01, 100);
const size = new Box3().setFromObject(object).getSize(new Vector3()).length();
camera.position.set(0, 0.3 * size, 1.2 * size);
camera.lookAt(0, 0, 0);
renderer.render(scene, camera);
requestAnimationFrame(() => performance.mark("three-first-picture"));
