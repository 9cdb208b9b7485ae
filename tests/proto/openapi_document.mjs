// openapi_document.mjs DOCUMENT: the OpenAPI document by judges of its own kind: it is valid OpenAPI, and its schema of a request accepts what the
// reader accepts (the examples) and refuses what it refuses.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { Validator } from '@seriousme/openapi-schema-validator';
import Ajv2020 from 'ajv/dist/2020.js';
import addFormats from 'ajv-formats';

const folder = fileURLToPath(new URL('../../proto/', import.meta.url));
const document = JSON.parse(readFileSync(process.argv[2], 'utf8'));

const validator = new Validator();
const verdict = await validator.validate(structuredClone(document));
assert.ok(verdict.valid, JSON.stringify(verdict.errors));
assert.equal(validator.version, '3.1');

const ajv = new Ajv2020({ strict: false });
addFormats(ajv);
ajv.addSchema(document, 'openapi');
const request = ajv.getSchema('openapi#/components/schemas/RefineRequest');

for (const name of readdirSync(`${folder}examples`)) {
  const body = JSON.parse(readFileSync(`${folder}examples/${name}`, 'utf8'));
  assert.ok(request(body), `${name}: ${JSON.stringify(request.errors)}`);
}

const triangle = { points: [0, 0, 0, 1, 0, 0, 0, 1, 0], faceVertexIndices: [0, 1, 2] };
assert.ok(request(triangle));
const refused = {
  'nothing to refine': {},
  'an unknown member': { ...triangle, vertices: [] },
  'a misspelt option': { ...triangle, options: { levle: 1 } },
  'a level too high': { ...triangle, options: { level: 16 } },
  'a word that is none': { ...triangle, interpolateBoundary: 'edgeonly' },
  'points of two numbers': { ...triangle, points: [[0, 0], [1, 0], [0, 1]] },
  'mixed forms': { ...triangle, points: [[0, 0, 0], 1, 0, 0] },
  'an index that is none': { ...triangle, holeIndices: [4294967295] },
  'a negative index': { ...triangle, holeIndices: [-1] },
  'no faces': { points: triangle.points },
  'meshes and a mesh': { ...triangle, meshes: [] },
  'a primvar without values': { ...triangle, primvars: { st: { elementSize: 2 } } },
  'a curve without points': { curves: [{}] },
};
for (const [what, body] of Object.entries(refused)) assert.ok(!request(body), `the schema accepts ${what}`);
