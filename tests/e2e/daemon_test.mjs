// The running daemon from outside: life cycle, CORS, and every sample through every kind of answer.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { Validator } from '@seriousme/openapi-schema-validator';
import { validateGltf } from './commands.mjs';
import { Contract } from './contract.mjs';
import { root, startDaemon } from './daemon.mjs';

const bodies = ['tests/shapes', 'proto/examples'].flatMap((folder) => readdirSync(join(root, folder))
  .filter((name) => /\.(json|glb)$/.test(name))
  .map((name) => ({ name, bytes: readFileSync(join(root, folder, name)), isGlb: name.endsWith('.glb') })));

let daemon, contract, folder;
before(async () => {
  daemon = await startDaemon();
  contract = await Contract.of(daemon.url);
  folder = mkdtempSync(join(tmpdir(), 'subdivd-e2e-'));
});
after(async () => {
  rmSync(folder, { recursive: true });
  await daemon.stop();
});

// Posts without a Content-Type that would give the kind away, and holds the answer against the document.
async function post(path, query, bytes) {
  const response = await fetch(`${daemon.url}${path}?${query}`, { method: 'POST', body: bytes, headers: { 'Content-Type': 'application/octet-stream' } });
  const answer = { path, method: 'POST', status: response.status, type: response.headers.get('content-type'), bytes: Buffer.from(await response.arrayBuffer()) };
  assert.deepEqual(contract.faults({ ...answer, body: answer.bytes.toString() }), []);
  return answer;
}

test('livez and readyz answer 200', async () => {
  for (const path of ['/livez', '/readyz']) {
    const response = await fetch(daemon.url + path);
    assert.equal(response.status, 200);
    assert.deepEqual(contract.faults({ path, method: 'GET', status: 200, type: response.headers.get('content-type') }), []);
  }
});

test('the page at / is HTML', async () => {
  const response = await fetch(daemon.url);
  assert.match(response.headers.get('content-type'), /^text\/html/);
  assert.match(await response.text(), /<!doctype html>/i);
});

test('the OpenAPI document is valid', async () => {
  const { valid, errors } = await new Validator().validate(structuredClone(contract.document));
  assert.ok(valid, JSON.stringify(errors));
});

// post() holds every answer, granted or refused, against the document.
test('every operation answers its examples, and refusals, as it says', async () => {
  let shown = 0;
  for (const [path, { post: operation }] of Object.entries(contract.document.paths)) {
    if (!operation) continue;
    // Warren's weights, which one example chooses, have nothing to be compared with.
    const query = path === '/v1/verify' ? 'loopWeights=loop' : '';
    for (const { value } of Object.values(operation.requestBody.content['application/json'].examples)) {
      const { status, bytes } = await post(path, query, JSON.stringify(value));
      assert.equal(status, 200, `${path}: ${bytes}`);
      assert.equal((await post(path, '', JSON.stringify({ ...value, undocumented: 1 }))).status, 422, path);
      assert.equal((await post(path, 'undocumented=1', JSON.stringify(value))).status, 400, path);
      ++shown;
    }
    assert.equal((await post(path, '', '{')).status, 400, path);
    assert.equal((await post(path, '', '{}')).status, 422, path);
  }
  assert.ok(shown >= 15, `${shown} examples`);
});

test('every page that is read is answered as it says', async () => {
  for (const [path, { get: operation }] of Object.entries(contract.document.paths)) {
    if (!operation) continue;
    const listed = (await (await fetch(`${daemon.url}/v1/schemes`)).json()).schemes;
    for (const { name, kind } of path.includes('{') ? listed : [{ name: '' }]) {
      const target = path.replace('{name}', name).replace('{valence}', kind === 'surface' ? '5' : '2');
      const response = await fetch(daemon.url + target);
      const answer = { path, method: 'GET', status: response.status, type: response.headers.get('content-type') };
      assert.equal(response.status, 200, target);
      assert.deepEqual(contract.faults({ ...answer, body: await response.text() }), []);
    }
  }
});

test('what the document shows of curves is answered as it says', async () => {
  for (const [path, { post: operation }] of Object.entries(contract.document.paths)) {
    if (!operation?.tags.includes('curves')) continue;
    const shown = Object.values(operation.requestBody.content['application/json'].examples);
    assert.ok(shown.length > 0, path);
    for (const { value } of shown) {
      const { status, bytes } = await post(path, '', JSON.stringify(value));
      assert.equal(status, 200, `${path}: ${bytes}`);
      const { status: refused } = await post(path, '', JSON.stringify({ ...value, points: [[0, 0]] }));
      assert.equal(refused, 422, path);
    }
  }
});

for (const { name, bytes } of bodies) {
  test(`${name} is refined to JSON`, async () => {
    const { status, bytes: text } = await post('/v1/refine', 'format=json&normals=true', bytes);
    assert.equal(status, 200, text.toString());
  });

    test(`${name} agrees with OpenSubdiv`, async () => {
    const { status, bytes: text } = await post('/v1/verify', 'level=3&loopWeights=loop', bytes);
    assert.equal(status, 200, text.toString());
    assert.equal(JSON.parse(text).verification.passed, true, text.toString());
  });

  for (const format of ['glb', 'gltf'])
    test(`${name} is refined to a ${format} that Khronos' validator calls clean`, async () => {
      const { status, bytes: model } = await post('/v1/refine', `format=${format}&limit=true&level=2`, bytes);
      assert.equal(status, 200, model.toString());
      const file = join(folder, `${name}.${format}`);
      writeFileSync(file, model);
      const { valid, report } = validateGltf([file]);
      assert.ok(valid, report);
    });
}

for (const { name, bytes } of bodies.filter(({ name }) => ['cube.json', 'house.json', 'sample.glb', 'seams.json'].includes(name)))
  for (const scheme of ['catmullClark', 'bilinear'])
    test(`${name} agrees with OpenSubdiv by ${scheme}`, async () => {
      const { status, bytes: text } = await post('/v1/verify', `level=2&normals=true&subdivisionScheme=${scheme}`, bytes);
      assert.equal(status, 200, text.toString());
      assert.equal(JSON.parse(text).verification.passed, true, text.toString());
    });

for (const { name, bytes } of bodies.filter(({ isGlb }) => !isGlb))
  test(`the answer to ${name} is a valid request`, async () => {
    const first = await post('/v1/refine', 'level=1', bytes);
    const { status, bytes: text } = await post('/v1/refine', 'level=1', first.bytes);
    assert.equal(status, 200, text.toString());
  });

test('curves come with tangents where meshes come with normals', async () => {
  const { bytes } = await post('/v1/refine', 'normals=true', readFileSync(join(root, 'tests/shapes/curve.json')));
  for (const curve of JSON.parse(bytes).curves) assert.equal(curve.tangents?.length, curve.points.length);
});

test('a refusal is a problem that points at the place', async () => {
  const { status, bytes } = await post('/v1/refine', '', '{"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,3]}');
  const problem = JSON.parse(bytes);
  assert.equal(status, 422);
  assert.equal(problem.code, 'out_of_range');
  assert.equal(problem.errors[0].pointer, '/faceVertexIndices/2');
});

test('a page of any origin may read answers', async () => {
  const response = await fetch(`${daemon.url}/livez`, { headers: { Origin: 'https://example.org' } });
  assert.equal(response.headers.get('access-control-allow-origin'), '*');
});

test('a preflight allows POST with a content type', async () => {
  const response = await fetch(`${daemon.url}/v1/refine`, {
    method: 'OPTIONS',
    headers: { Origin: 'https://example.org', 'Access-Control-Request-Method': 'POST', 'Access-Control-Request-Headers': 'content-type' },
  });
  assert.ok(response.ok);
  assert.match(response.headers.get('access-control-allow-methods'), /POST/);
  assert.match(response.headers.get('access-control-allow-headers'), /content-type/i);
});

test('with a list of origins others are not allowed', async () => {
  const strict = await startDaemon(['--cors-origins', 'https://a.example']);
  const allowed = async (origin) => (await fetch(`${strict.url}/livez`, { headers: { Origin: origin } })).headers.get('access-control-allow-origin');
  assert.equal(await allowed('https://a.example'), 'https://a.example');
  assert.equal(await allowed('https://b.example'), null);
  await strict.stop();
});

for (const signal of ['SIGTERM', 'SIGINT'])
  test(`${signal} ends the daemon with exit code 0`, async () => {
    const other = await startDaemon();
    assert.equal(await other.stop(signal), 0);
  });
