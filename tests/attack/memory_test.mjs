// Resident memory at its peak stays within --max-memory-bytes and 15 %, beside what the process takes at rest: measured at
// the start, for its code, its libraries and its threads differ from build to build.
import assert from 'node:assert/strict';
import test from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import * as bodies from './bodies.mjs';
import { connected, documented, get, head, post, tetrahedron } from './client.mjs';
import { eventually, GiB, inMiB, isLong, MiB, peakBytes, residentBytes, virtualBytes, withDaemon } from './process.mjs';

// Runs `attack` on a daemon with this limit; everything that it returns are answers.
async function staysWithin(limit, attack, flags = []) {
  await withDaemon([...(limit === 4 * GiB ? [] : ['--max-memory-bytes', String(limit)]), ...flags], async (daemon) => {
    const atRest = residentBytes(daemon);
    for (const { status, body } of await attack(daemon.port))
      assert.ok(documented.includes(status), `status ${status}: ${body.slice(0, 300)}`);
    const peak = peakBytes(daemon), allowed = atRest + 1.15 * limit;
    assert.ok(peak <= allowed, `peak ${inMiB(peak)} of ${inMiB(allowed)} allowed, ${inMiB(atRest)} of them at rest`);
    assert.equal((await post(daemon.port, '/v1/refine?level=1', tetrahedron)).status, 200);
  });
}

// --- peaks ----------------------------------------------------------------------------------------------------
// The short half sends the same shapes under limits that a small machine has, all in proportion.
const scale = isLong ? 1 : 1 / 4;

test('six large bodies at once stay within the limit', async () => {
  const body = bodies.sheetOfBytes(60e6 * scale);
  await staysWithin(GiB * scale, (port) => Promise.all(Array.from({ length: 6 }, () =>
    post(port, '/v1/refine?level=0', body, { patience: 60_000 }))));
});

test('six large bodies of curves at once stay within the limit', async () => {
  const body = bodies.flatCurve(15_000_000 * scale);
  await staysWithin(GiB * scale, (port) => Promise.all(Array.from({ length: 6 }, () =>
    post(port, '/v1/curves/refine?level=0', body, { patience: 60_000 }))));
});

test('a curve of many points of one number is measured within the limit', async () => {
  const body = bodies.flatCurve(20_000_000 * (scale / 4));
  await staysWithin(4 * GiB * (scale / 4), async (port) => [await post(port, '/v1/curves/measure', body, { patience: 60_000 })],
    ['--deadline-seconds', '10']);
});

for (const [what, options] of [['', {}], [', all corners apart', { torn: true }], [' that are the same bytes', { shared: true }],
  [' that are the same bytes, all corners apart', { shared: true, torn: true }]])
  test(`a GLB of twenty attributes${what} is refined within the limit`, async () => {
    const body = bodies.glbWithAttributes(20, 36e6 * scale, options);
    await staysWithin(4 * GiB * scale, async (port) => [
      await post(port, '/v1/refine?level=0', body, { patience: 60_000 }), await post(port, '/v1/refine?level=2', body, { patience: 60_000 })]);
  });

test('a quarter of a kilobyte that stands for millions of elements stays within the limit', () =>
  staysWithin(256 * MiB, async (port) => [await post(port, '/v1/refine?level=0', bodies.elementsOfNothing(), { patience: 60_000 })]));

// The rows of the first step once held a weight for every two corners of a face.
for (const seams of [false, true])
  test(`two faces of many corners that share all edges${seams ? ', with seams,' : ''} stay within the limit`, async () => {
    const body = bodies.pillow(20_000, seams);
    await staysWithin(128 * MiB, async (port) => {
      const answers = [];
      for (const query of ['level=0', 'level=1', 'level=2&limit=true&normals=true&format=glb'])
        answers.push(await post(port, `/v1/refine?${query}`, body, { patience: 60_000 }));
      assert.ok(answers.some(({ status }) => status === 200), 'nothing was refined');
      return answers;
    });
  });

// Its plans hold the rows of every level.
test('the butterfly scheme stays within the limit', async () => {
  await staysWithin(256 * MiB, async (port) => {
    const answers = [];
    for (const [level, body] of [[0, bodies.sheet(100)], [1, bodies.sheet(100)], [2, bodies.sheet(100)], [3, bodies.sheet(60)], [2, bodies.fan(20_000)], [8, bodies.sheet(2)]])
      answers.push(await post(port, `/v1/refine?level=${level}&subdivisionScheme=butterfly&normals=true&format=glb`, body, { patience: 60_000 }));
    assert.ok(answers.some(({ status }) => status === 200), 'nothing was refined');
    return answers;
  });
});

test('levels of convergence stay within the limit', () =>
  staysWithin(256 * MiB, async (port) => [
    await post(port, '/v1/curves/measure', bodies.converge(20), { patience: 60_000 }),
    await post(port, '/v1/curves/measure', bodies.converge(24), { patience: 60_000 })]));

// The answer once echoed the key, and its bytes were in no account.
test('thirty clients that do not read a refusal stay within the limit', async () => {
  const body = bodies.longKey(20_000_000);
  await staysWithin(64 * MiB, async (port) => {
    const sockets = [];
    for (let i = 0; i < 30; ++i) {
      const socket = await connected(port);
      sockets.push(socket.pause());
      socket.write(head('POST', '/v1/refine', { 'Content-Length': body.length }));
      await Promise.race([new Promise((sent) => { socket.write(body, sent); }), pause(2000)]);
    }
    await pause(500);
    for (const socket of sockets) socket.destroy();
    return [];
  });
});

// --- echoes ---------------------------------------------------------------------------------------------------

for (const [what, body] of [
  ['a member name of 100 MB', () => bodies.longKey(100_000_000)],
  ['a glTF attribute name of 10 MB', () => bodies.glb({
    asset: { version: '2.0' }, accessors: [{ componentType: 5126, count: 3, type: 'VEC9' }],
    meshes: [{ primitives: [{ attributes: { [`_${'K'.repeat(10_000_000)}`]: 7, POSITION: 0 } }] }] })],
  ['a word of 10 MB where few are valid', () => Buffer.from(
    `{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"interpolateBoundary":"${'w'.repeat(10_000_000)}"}`)],
  ['a primvar name of 10 MB', () => Buffer.from(
    `{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"primvars":{"${'p'.repeat(10_000_000)}":{"interpolation":"vertex","values":[1]}}}`)],
])
  test(`${what} is refused in less than 10 kB`, () => withDaemon([], async (daemon) => {
    const answer = await post(daemon.port, '/v1/refine', body(), { patience: 60_000 });
    assert.ok([400, 422].includes(answer.status), `status ${answer.status}: ${answer.body.slice(0, 300)}`);
    assert.ok(answer.size < 10_000, `${answer.size} bytes`);
  }));

// --- out of memory --------------------------------------------------------------------------------------------

// Starting may take more addresses than resting: allocators take twice what they keep, to align it. A daemon that cannot
// start says so and ends; then another one is started.
async function withDaemonUnder(limit, flags, body) {
  for (let tries = 1; ; ++tries)
    try {
      return await withDaemon(flags, body, { inShell: `ulimit -v ${limit}` });
    } catch (error) {
      if (tries === 20 || !/^the daemon (printed no address|ended with)/.test(error.message)) throw error;
    }
}

test('where memory ends a valid body is answered 200 or 503, and the daemon lives', async () => {
  const flags = ['--threads', '4', '--max-concurrent', '1'];
  let atRest;
  await withDaemon(flags, async (daemon) => { atRest = virtualBytes(daemon); });
  const requests = [
    ['/v1/refine?level=0', bodies.sheetOfBytes(4e6)],
    ['/v1/refine?level=2&format=glb', bodies.sheetOfBytes(2e6)],
    ['/v1/refine?level=1', bodies.glbWithAttributes(4, 4e6)],
    ['/v1/curves/refine?level=1', bodies.flatCurve(1_000_000)],
    ['/v1/verify?level=2', bodies.sheetOfBytes(5e5)],
  ];
  const statuses = new Set();
  for (const more of isLong ? [8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256] : [16, 32, 64, 128])
    await withDaemonUnder(Math.round((atRest + more * MiB) / 1024), flags, async (daemon) => {
      for (const [path, body] of requests) {
        const answer = await post(daemon.port, path, body);
        statuses.add(answer.status);
        assert.ok([200, 503].includes(answer.status), `${path} with ${more} MiB: status ${answer.status}: ${answer.body.slice(0, 300)}`);
      }
      assert.equal((await get(daemon.port, '/livez')).status, 200);
    });
  assert.ok(statuses.has(503), 'memory never ended: the test tests nothing');
});

// --- given back -----------------------------------------------------------------------------------------------

test('430 hostile requests leave nothing behind', () => withDaemon(['--deadline-seconds', '5'], async (daemon) => {
  const hostile = bodies.hostile();
  for (let i = 0; i < 4; ++i) await post(daemon.port, '/v1/refine?level=3', tetrahedron);
  const before = residentBytes(daemon);
  const statuses = new Set();
  let next = 0;
  const client = async () => {
    while (next < 430) {
      const i = next++;
      statuses.add((await post(daemon.port, i % 3 ? '/v1/refine' : '/v1/curves/measure', hostile[i % hostile.length])).status);
    }
  };
  await Promise.all([client(), client(), client(), client()]);
  // 223 MiB stayed. What an allocator keeps for four threads at a time is less than this.
  const allowed = before + 64 * MiB;
  assert.ok(await eventually(() => residentBytes(daemon) <= allowed, 10_000),
    `${inMiB(before)} before, ${inMiB(residentBytes(daemon))} after, ${inMiB(allowed)} allowed`);
  assert.deepEqual([...statuses].filter((status) => !documented.includes(status)), []);
}));
