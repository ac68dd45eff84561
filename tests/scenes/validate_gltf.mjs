// The Khronos validator on the files named on the command line: no error, no warning.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

// Packages are those of the working directory, where CTest starts this.
const { validateBytes } = createRequire(join(process.cwd(), 'package.json'))('gltf-validator');

// glTF says how tangents are made where an asset has none, and some scenes are there to have that
// done: worth a hint (2), not a warning.
const severityOverrides = { MESH_PRIMITIVE_GENERATED_TANGENT_SPACE: 2 };

const files = process.argv.slice(2);
assert.ok(files.length > 0, 'usage: node validate_gltf.mjs FILE...');
for (const file of files) {
  const report = await validateBytes(new Uint8Array(readFileSync(file)), { severityOverrides });
  const { numErrors, numWarnings, messages } = report.issues;
  const listed = messages.map((issue) => `${issue.pointer}: ${issue.message}`).join('\n');
  assert.equal(numErrors + numWarnings, 0, `${file}\n${listed}`);
  console.log(`${file}: clean`);
}
