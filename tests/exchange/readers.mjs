// Others' readers take what `shoal export` wrote: three.js a .glb, tinyusdz .usda files. Prints what they found.
//
// node readers.mjs FOLDER SCENE.glb FILE.usda...     FOLDER: node_modules, with three and tinyusdz (npm install three tinyusdz)
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';

const [folder, glb, ...stages] = process.argv.slice(2);
const from = (name) => import(pathToFileURL(resolve(folder, name)).href);

// What both take for a browser.
globalThis.self = globalThis;
globalThis.location = { href: 'file:///' };
globalThis.WorkerGlobalScope = class {};

const { GLTFLoader } = await from('three/examples/jsm/loaders/GLTFLoader.js');
const bytes = readFileSync(glb);
const scene = await new Promise((done, failed) =>
    new GLTFLoader().parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '', done, failed));
let vertices = 0;
scene.scene.traverse((node) => {
    if (node.geometry) vertices += node.geometry.attributes.position.count;
});
console.log(`three: ${vertices} vertices, ${scene.cameras.length} cameras`);

process.type = 'renderer';
const native = await (await from('tinyusdz/tinyusdz.js')).default({
    wasmBinary: readFileSync(resolve(folder, 'tinyusdz/tinyusdz.wasm')), print() {}, printErr() {},
});
for (const file of stages) {
    const whole = new native.TinyUSDZLoaderNative();
    if (!whole.loadAsLayerFromBinary(new Uint8Array(readFileSync(file)), file)) throw new Error(whole.error());
    // Its conversion to meshes knows neither readers of colours nor the alpha of images.
    const text = readFileSync(file, 'utf8').replace(/rel material:binding.*/g, '');
    const geometry = new native.TinyUSDZLoaderNative();
    if (!geometry.loadFromBinary(new TextEncoder().encode(text), file)) throw new Error(geometry.error());
    const meshes = Array.from({ length: geometry.numMeshes() }, (_, i) => geometry.getMesh(i));
    // Colliders and models stand before what moves.
    const first = meshes.length > 0 ? [...meshes.at(-1).points.slice(0, 3)].map((x) => x.toFixed(5)).join(' ') : 'none';
    console.log(`tinyusdz: ${meshes.length} meshes, first point ${first}`);
}
