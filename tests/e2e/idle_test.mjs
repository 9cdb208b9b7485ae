// Connections are kept as long as was said, and longer: no common client's request fails because it comes after a pause.
// The daemon announces 2 s and keeps a connection for 7; every client pauses for every time around both.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { Agent, request } from 'node:http';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { startDaemon } from './daemon.mjs';

const announced = 2, kept = announced + 5;
// At the very moment when the daemon closes, a request may be on its way already: nobody can help that.
const blink = 0.15;
const isBlink = (waited) => waited >= kept && waited < kept + 2 * blink;
const pauses = Array.from({ length: 61 }, (_, i) => announced - 0.5 + i / 10).filter((pause) => Math.abs(pause - kept) > blink);
const path = '/v1/refine?level=0&format=json';
const body = '{"points":[[0,0,0],[1,0,0],[0,1,0]],"faceVertexIndices":[0,1,2]}';
const headers = { 'Content-Type': 'application/json' };

let daemon;
before(async () => { daemon = await startDaemon(['--max-waiting', '1000', '--idle-timeout', `${announced}`]); });
after(async () => { await daemon.stop(); });

// Runs `client(pause)` for all pauses at once, and says which of them failed.
async function failures(client) {
  const outcomes = await Promise.allSettled(pauses.map(client));
  return outcomes.flatMap(({ status, reason }, i) => status === 'rejected' ? [`${pauses[i]} s: ${reason?.cause ?? reason}`] : []);
}

test('the announcement is the setting', async () => {
  const response = await fetch(`${daemon.url}/livez`);
  assert.equal(response.headers.get('keep-alive'), `timeout=${announced}`);
});

describe('a pause does no harm to', { concurrency: true }, () => {
  test('fetch', async () => {
    const ask = async () => {
      const response = await fetch(daemon.url + path, { method: 'POST', body, headers });
      assert.equal(response.status, 200);
      await response.arrayBuffer();
    };
    assert.deepEqual(await failures(async (pause) => { await ask(); await sleep(pause * 1000); await ask(); }), []);
  });

  test('http.Agent', async () => {
    const ask = (agent) => new Promise((resolve, reject) => {
      const sent = request(daemon.url + path, { agent, method: 'POST', headers }, (response) => {
        response.resume().on('end', () => response.statusCode === 200 ? resolve() : reject(new Error(`status ${response.statusCode}`)));
      });
      sent.on('error', reject).end(body);
    });
    assert.deepEqual(await failures(async (pause) => {
      const agent = new Agent({ keepAlive: true, maxSockets: 1 });
      await ask(agent);
      await sleep(pause * 1000);
      await ask(agent);
      agent.destroy();
    }), []);
  });

  test('Python', async () => {
    const { hostname, port } = new URL(daemon.url);
    const script = join(dirname(fileURLToPath(import.meta.url)), 'idle_client.py');
    const { stdout } = await promisify(execFile)('python3', [script, hostname, port, path, body, ...pauses.map(String)]);
    const results = JSON.parse(stdout);
    assert.equal(results.length, pauses.length);
    assert.deepEqual(results.filter(({ error, waited }) => error !== null && !isBlink(waited)), []);
    assert.deepEqual(results.filter(({ waited, kept: open }) => !open && waited < kept), []);
  });

  // --rate spaces the transfers of one curl, which then go over one connection as long as that is open.
  test('curl', async () => {
    const run = promisify(execFile);
    const closed = [];
    const failed = await failures(async (pause) => {
      const start = performance.now();
      const { stdout } = await run('curl', ['-sS', '--rate', `${Math.round(3600 / pause)}/h`, '-w', '%{http_code} %{num_connects}\n', '-o', '/dev/null',
        '-o', '/dev/null', '--json', body, daemon.url + path, daemon.url + path]);
      const [first, second] = stdout.trim().split('\n');
      assert.equal(first, '200 1');
      assert.match(second, /^200 [01]$/);
      if (second === '200 1' && performance.now() - start < kept * 1000) closed.push(pause);
    });
    assert.deepEqual(failed, []);
    assert.deepEqual(closed, []);
  });
});
