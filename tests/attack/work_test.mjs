// Small bodies that once took the daemon seconds to minutes of work which nothing stopped. Each is sent twice at once, so
// that both places are taken, while another client goes on with small requests.
import assert from 'node:assert/strict';
import test from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import * as bodies from './bodies.mjs';
import { connected, documented, get, head, post, smallRequests } from './client.mjs';
import { isLong, processorSeconds, stopWithin, withDaemon } from './process.mjs';

const flags = ['--deadline-seconds', '3', '--max-concurrent', '2', '--drain-seconds', '1'];
const kAnswered = 5000, kServed = 1000, kNoticed = 500;  // milliseconds

// path, body; `leaving`: also with clients that go away, and with SIGTERM, in the short half
const shapes = {
  'crease pairs in one bucket of a hash table': { path: '/v1/refine', body: () => bodies.creasesInOneBucket(), leaving: true },
  '12,000 sparse accessors on one list of a million indices': { path: '/v1/refine', body: () => bodies.sparseAccessorsOnOneList(), leaving: true },
  '50,000 attributes on one primitive': { path: '/v1/refine', body: () => bodies.manyAttributes() },
  '500,000 unknown root members and 10,000 primitives': { path: '/v1/refine', body: () => bodies.manyRootMembers() },
  'a crease of two million points between two tips': { path: '/v1/refine?level=1', body: () => bodies.creaseBetweenTips() },
  '40,000 primitives': { path: '/v1/refine?normals=true', body: () => bodies.manyPrimitives(40_000) },
  '100,000 primitives': { path: '/v1/refine', body: () => bodies.manyPrimitives(100_000) },
  '100,000 glTF meshes': { path: '/v1/refine', body: () => bodies.manyGltfMeshes() },
  '200,000 nodes in one chain': { path: '/v1/refine', body: () => bodies.nodesInOneChain() },
  'a comparison of 400,000 faces on one edge': { path: '/v1/verify', body: () => bodies.facesOnOneEdge(), leaving: true },
  'a comparison of a fan of 65,535': { path: '/v1/verify?level=3&limit=true&normals=true', body: () => bodies.fan() },
  'a fan of 65,535 by the butterfly scheme': { path: '/v1/refine?level=3&subdivisionScheme=butterfly&normals=true', body: () => bodies.fan(), leaving: true },
  '65,000 meshes': { path: '/v1/refine', body: () => bodies.manyMeshes(65_000) },
  'a comparison of 65,000 meshes': { path: '/v1/verify', body: () => bodies.manyMeshes(65_000) },
  '65,000 curves': { path: '/v1/refine', body: () => bodies.manyCurves(65_000) },
  '24 levels of convergence': { path: '/v1/curves/measure', body: () => bodies.converge() },
  '100,000 closest points': { path: '/v1/curves/measure', body: () => bodies.closestPoints() },
  'a large mesh that is simply refined': { path: '/v1/refine?level=4&format=glb&limit=true&normals=true', body: () => bodies.sheet(200), leaving: true },
  ...(isLong && {
    'more crease pairs in one bucket': { path: '/v1/refine', body: () => bodies.creasesInOneBucket(300_000, 351_061) },
    '50,000 sparse accessors on one list': { path: '/v1/refine', body: () => bodies.sparseAccessorsOnOneList(50_000) },
    '500,000 attributes': { path: '/v1/refine', body: () => bodies.manyAttributes(500_000) },
    '500,000 primitives': { path: '/v1/refine', body: () => bodies.manyPrimitives(500_000) },
    'a crease of twenty million points': { path: '/v1/refine?level=0', body: () => bodies.creaseBetweenTips(100_000, 20_000_000) },
    'four million faces on one edge': { path: '/v1/refine', body: () => bodies.facesOnOneEdge(4_000_000) },
    'a fan of two million': { path: '/v1/refine?normals=true', body: () => bodies.fan(2_000_000) },
    '4,000 primvars': { path: '/v1/refine', body: () => bodies.manyPrimvars(4_000) },
    'a million degenerate faces': { path: '/v1/refine', body: () => bodies.degenerateFaces() },
    'a million unknown members': { path: '/v1/refine', body: () => bodies.manyMembers() },
  }),
};

// Both requests on their way, and the work begun.
async function twoAtWork(daemon, path, body) {
  const sockets = await Promise.all([connected(daemon.port), connected(daemon.port)]);
  for (const socket of sockets) {
    socket.resume();
    socket.write(head('POST', path, { 'Content-Length': body.length }));
    await new Promise((sent) => { socket.write(body, sent); });
  }
  await pause(300);
  return sockets;
}

for (const [name, { path, body: build, leaving }] of Object.entries(shapes)) {
  test(name, async (t) => {
    const body = build();

    await t.test('is answered, and others are served meanwhile', () => withDaemon(flags, async (daemon) => {
      const others = smallRequests(daemon.port);
      const once = () => post(daemon.port, path, body, { patience: 2 * kAnswered });
      const answers = await Promise.all([once(), once()]);
      const { count, slowest, failed } = await others.stop();
      const faults = answers
        .filter(({ status, ms }) => !documented.includes(status) || ms > kAnswered)
        .map(({ status, ms, body: text }) => `status ${status} after ${Math.round(ms)} ms: ${text.slice(0, 200)}`);
      if (failed.length > 0) faults.push(`${failed.length} of ${count} small requests failed, the first: ${failed[0]}`);
      if (count === 0 || slowest > kServed) faults.push(`the slowest of ${count} small requests took ${Math.round(slowest)} ms`);
      assert.deepEqual(faults, []);
    }));

    if (!leaving && !isLong) return;

    await t.test('ends when its clients go away', () => withDaemon(flags, async (daemon) => {
      for (const socket of await twoAtWork(daemon, path, body)) socket.resetAndDestroy();
      await pause(kNoticed);
      const before = processorSeconds(daemon);
      await pause(1000);
      const used = processorSeconds(daemon) - before;
      assert.ok(used < 0.2, `used ${used.toFixed(2)} s of processor time in a second that began ${kNoticed} ms after its clients had left`);
      assert.equal((await get(daemon.port, '/livez')).status, 200);
    }));

    await t.test('does not hold up SIGTERM', () => withDaemon(flags, async (daemon) => {
      await twoAtWork(daemon, path, body);
      assert.equal(await stopWithin(daemon, 3000), 0);  // a second of draining, and two
    }));
  });
}
