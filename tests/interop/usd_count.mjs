// Reads a .usda with TinyUSDZ and prints what it found, as JSON.
import fs from 'node:fs';
import { fileURLToPath } from 'node:url';

// Its WebAssembly was built for browsers and looks for one; the bytes are handed to it.
process.type = 'renderer';
globalThis.window = globalThis;
const { default: init } = await import('tinyusdz/tinyusdz.js');
const wasm = fileURLToPath(import.meta.resolve('tinyusdz/tinyusdz.wasm'));
const tinyusdz = await init({ wasmBinary: fs.readFileSync(wasm), print: () => {}, printErr: () => {} });

const layer = new tinyusdz.TinyUSDZLoaderNative();
const is_read = layer.loadFromBinary(new Uint8Array(fs.readFileSync(process.argv[2])), process.argv[2]);
const report = { is_read, error: layer.error?.() ?? '', meshes: 0, triangles: 0, materials: [] };
for (let i = 0; is_read && i < layer.numMeshes(); i++) {
    const mesh = layer.getMesh(i);
    report.meshes++;
    report.triangles += mesh.faceVertexIndices.length / 3;
    report.materials.push(mesh.materialId);
}
console.log(JSON.stringify(report));
