// Khronos' validator on .glb files: prints a line a file, and each of its errors and warnings.
//
// node validate.mjs FOLDER FILE.glb...     FOLDER: node_modules, with gltf-validator (npm install gltf-validator)
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { resolve } from 'node:path';

const [folder, ...files] = process.argv.slice(2);
const { validateBytes } = (await import(pathToFileURL(resolve(folder, 'gltf-validator/index.js')).href)).default;
let failed = false;
for (const file of files) {
    const { issues } = await validateBytes(new Uint8Array(readFileSync(file)));
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
    for (const { code, message, pointer, severity } of issues.messages.slice(0, 20))
        if (severity <= 1) console.log(`  ${code} at ${pointer}: ${message}`);
    failed = failed || issues.numErrors + issues.numWarnings > 0;
}
process.exitCode = failed ? 1 : 0;
