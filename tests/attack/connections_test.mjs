// Clients that hold on to what they were given: connections without a word, a log that nobody reads. And heads that are no
// HTTP, or odd but legal HTTP.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { closeSync, mkdtempSync, openSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import { startDaemon } from '../e2e/daemon.mjs';
import { sheet } from './bodies.mjs';
import { answerOn, ask, connected, get, head, post, tetrahedron } from './client.mjs';
import { eventually, isLong, stopWithin } from './process.mjs';

const kAtOnce = 1000;  // milliseconds
let daemon;
before(async () => { daemon = await startDaemon(); });
after(() => daemon.stop());

async function served(port) {
  for (const answer of await Promise.all([get(port, '/livez'), post(port, '/v1/refine?level=1', tetrahedron)])) {
    assert.equal(answer.status, 200, answer.body);
    assert.ok(answer.ms <= kAtOnce, `answered after ${Math.round(answer.ms)} ms`);
  }
}

// --- a log that nobody reads ----------------------------------------------------------------------------------

// A pipe that stays open and that nobody reads: 64 KiB fit into it.
async function withStalledLog(body) {
  const folder = mkdtempSync(join(tmpdir(), 'subdivd-attack-'));
  const pipe = join(folder, 'log');
  execFileSync('mkfifo', [pipe]);
  const end = openSync(pipe, 'r+');
  const stalled = await startDaemon(['--log-level', 'info', '--drain-seconds', '1'], { log: end });
  try {
    await body(stalled);
  } finally {
    stalled.child.kill('SIGKILL');
    closeSync(end);
    rmSync(folder, { recursive: true });
  }
}

// Each is a line of some hundred bytes in the log.
async function fillTheLog(port) {
  const client = async () => {
    for (let i = 0; i < (isLong ? 5000 : 500); ++i) {
      const { status } = await get(port, `/${'nowhere'.repeat(30)}`, { patience: 2000 });
      if (status !== 404) return status;
    }
    return 404;
  };
  return Promise.all([client(), client(), client(), client()]);
}

test('a log that nobody reads holds up no request', () => withStalledLog(async (stalled) => {
  assert.deepEqual(await fillTheLog(stalled.port), [404, 404, 404, 404]);
  await served(stalled.port);
}));

test('a log that nobody reads does not hold up SIGTERM', () => withStalledLog(async (stalled) => {
  await fillTheLog(stalled.port);
  assert.equal(await stopWithin(stalled, 3000), 0);
}));

// --- silence --------------------------------------------------------------------------------------------------

for (const count of [64, 200, 2000])
  test(`${count} silent connections keep nobody waiting`, async () => {
    const silent = await Promise.all(Array.from({ length: count }, () => connected(daemon.port)));
    try {
      await pause(100);
      await served(daemon.port);
    } finally {
      for (const socket of silent) socket.destroy();
    }
  });

test('200 connections that stop within the head keep nobody waiting', async () => {
  const halves = await Promise.all(Array.from({ length: 200 }, () => connected(daemon.port)));
  try {
    for (const socket of halves) socket.write('GET /livez HTTP/1.1\r\nHo');
    await pause(100);
    await served(daemon.port);
  } finally {
    for (const socket of halves) socket.destroy();
  }
});

// More of them than there are threads. Each may have its thread for a second, or three, when others wait.
async function servedBeside(count, bytes) {
  const slow = await Promise.all(Array.from({ length: count }, () => connected(daemon.port)));
  try {
    for (const socket of slow) socket.write(bytes);
    await pause(100);
    const [health, small] = await Promise.all([get(daemon.port, '/livez'), post(daemon.port, '/v1/refine?level=1', tetrahedron)]);
    assert.equal(health.status, 200);
    assert.ok(health.ms <= kAtOnce, `answered after ${Math.round(health.ms)} ms`);
    assert.equal(small.status, 200, small.body);
    assert.ok(small.ms <= 8000, `answered after ${Math.round(small.ms)} ms`);
  } finally {
    for (const socket of slow) socket.destroy();
  }
}

for (const length of [1000, 100_000])
  test(`200 connections that stop within a body of ${length} bytes give way`, () =>
    servedBeside(200, Buffer.concat([head('POST', '/v1/refine', { 'Content-Length': length }), tetrahedron])));

test('large bodies that are announced and not sent keep nobody waiting who sends a small one', async () => {
  const slow = await Promise.all(Array.from({ length: 8 }, () => connected(daemon.port)));
  try {
    for (const socket of slow)
      socket.write(Buffer.concat([head('POST', '/v1/refine', { 'Content-Length': 200 << 20 }), Buffer.alloc(1 << 20, ' ')]));
    await pause(300);
    await served(daemon.port);
    const cookie = { Cookie: 'c'.repeat(1500) };
    assert.equal((await get(daemon.port, '/livez', { headers: cookie })).status, 200);
  } finally {
    for (const socket of slow) socket.destroy();
  }
});

test('200 connections that are silent after a request keep nobody waiting', async () => {
  const idle = await Promise.all(Array.from({ length: 200 }, () => connected(daemon.port)));
  try {
    const answers = await Promise.all(idle.map((socket) => {
      const answer = answerOn(socket);
      socket.write(head('GET', '/livez'));
      return answer;
    }));
    for (const { status } of answers) assert.equal(status, 200);
    await served(daemon.port);
  } finally {
    for (const socket of idle) socket.destroy();
  }
});

// --- heads ----------------------------------------------------------------------------------------------------

async function answerTo(bytes, patience) {
  const socket = await connected(daemon.port);
  const answer = answerOn(socket, patience);
  socket.write(bytes);
  const result = await answer;
  socket.destroy();
  return result;
}

for (const [what, bytes] of [
  ['a TLS hello', Buffer.concat([Buffer.from('16030102000100 01fc0303'.replaceAll(' ', ''), 'hex'), randomBytes(506)])],
  ['a head of bare LFs', 'GET /livez HTTP/1.1\nHost: a\n\n'],
  ['one line with a bare LF', 'GET /livez HTTP/1.1\n'],
  ['an HTTP/2 preface', 'PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n'],
  ['zeros', Buffer.alloc(100)],
])
  test(`${what} is refused at once`, async () => {
    const { status, ms, body } = await answerTo(bytes, 5000);
    assert.ok([400, 505].includes(status), `status ${status} after ${Math.round(ms)} ms: ${body}`);
    assert.ok(ms <= kAtOnce, `answered after ${Math.round(ms)} ms`);
  });

for (const host of ['a b', '<script>', 'a/b', 'a?b', 'a@b', 'a:b', '[::1', '"'])
  test(`Host: ${host} is refused`, async () => {
    assert.equal((await get(daemon.port, '/livez', { headers: { Host: host } })).status, 400);
  });

for (const host of ['localhost', '127.0.0.1:8080', '[::1]:8080', 'example.com', 'xn--bcher-kva.example', 'a_b.internal', 'EXAMPLE.com:80'])
  test(`Host: ${host} is accepted`, async () => {
    assert.equal((await get(daemon.port, '/livez', { headers: { Host: host } })).status, 200);
  });

test('chunks may be followed by trailers', async () => {
  const chunk = `${tetrahedron.length.toString(16)};name=value\r\n${tetrahedron}\r\n`;
  const { status, body } = await answerTo(Buffer.concat([
    head('POST', '/v1/refine?level=1', { 'Transfer-Encoding': 'chunked', Trailer: 'X-Checksum' }),
    Buffer.from(`${chunk}0\r\nX-Checksum: 1\r\nX-More: words\r\n\r\n`)]));
  assert.equal(status, 200, body);
});

test('a client that has ended its half is answered', async () => {
  const body = sheet(60);
  const socket = await connected(daemon.port);
  const answer = answerOn(socket);
  socket.end(Buffer.concat([head('POST', '/v1/refine?level=4', { 'Content-Length': body.length }), body]));
  const { status, body: text } = await answer;
  socket.destroy();
  assert.equal(status, 200, text.slice(0, 300));
});

// --- signals --------------------------------------------------------------------------------------------------

for (const signal of ['SIGHUP', 'SIGUSR1', 'SIGUSR2', 'SIGPIPE'])
  test(`${signal} does not kill`, async () => {
    const signalled = await startDaemon();
    try {
      signalled.child.kill(signal);
      await pause(300);
      assert.ok(await eventually(() => signalled.child.exitCode === null && signalled.child.signalCode === null, 100), 'it ended');
      assert.equal((await ask(signalled.port, 'GET', '/livez')).status, 200);
      assert.equal(await signalled.stop(), 0);
    } finally {
      signalled.child.kill('SIGKILL');
    }
  });
