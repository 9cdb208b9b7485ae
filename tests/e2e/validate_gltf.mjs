// Khronos' glTF validator over files and folders: node validate_gltf.mjs FILE|FOLDER...
// Prints every issue; exits with 1 on any error or warning, or when there was nothing to judge.
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import validator from 'gltf-validator';

const names = ['error', 'warning', 'information', 'hint'];
const isGltf = (name) => name.endsWith('.glb') || name.endsWith('.gltf');
const files = process.argv.slice(2).flatMap((path) =>
  statSync(path).isDirectory() ? readdirSync(path).filter(isGltf).sort().map((name) => join(path, name)) : [path]);

let bad = 0;
for (const file of files) {
  let report;
  try {
    report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: file, maxIssues: 100 });
  } catch (error) {
    console.log(`${file}: unreadable: ${error}`);
    ++bad;
    continue;
  }
  const { numErrors, numWarnings, messages } = report.issues;
  for (const issue of messages)
    console.log(`${file}: ${names[issue.severity]}: ${issue.code} ${issue.pointer ?? ''}: ${issue.message}`);
  if (numErrors + numWarnings > 0) ++bad;
}
console.log(`${files.length} files, ${bad} with errors or warnings`);
process.exit(bad > 0 || files.length === 0 ? 1 : 0);
