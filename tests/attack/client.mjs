// Raw HTTP/1.1 over a socket: bodies of any size, an answer or the lack of one, and how long it took.
import { connect } from 'node:net';
import { once } from 'node:events';
import { setTimeout as pause } from 'node:timers/promises';

export const tetrahedron = Buffer.from(
  '{"points":[[4,4,4],[-4,-4,4],[-4,4,-4],[4,-4,-4]],"faceVertexIndices":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}');

// Whatever is wrong with a body, and whatever it takes.
export const documented = [200, 400, 413, 415, 422, 503];

export function head(method, path, headers = {}) {
  const lines = Object.entries({ Host: 'attack', ...headers }).map(([name, value]) => `${name}: ${value}\r\n`);
  return Buffer.from(`${method} ${path} HTTP/1.1\r\n${lines.join('')}\r\n`, 'latin1');
}

export async function connected(port) {
  const socket = connect({ port, host: '127.0.0.1', noDelay: true, allowHalfOpen: true });
  socket.on('error', () => {});  // whoever attacks may be cut off
  await Promise.race([once(socket, 'connect'), once(socket, 'close')]);
  return socket;
}

// The next answer on a socket: { status, headers, body, size, ms }; status 0 when there is none within `patience`. Interim
// answers (1xx) are skipped; of large bodies the beginning is kept.
export function answerOn(socket, patience = 20_000, kept = 65536) {
  const start = performance.now();
  return new Promise((resolve) => {
    let text = Buffer.alloc(0), answer, size = 0;
    const finish = (result) => {
      clearTimeout(timer);
      socket.off('data', take).off('close', cut).off('end', cut);
      resolve({ status: 0, headers: {}, size, body: text.toString('latin1', 0, 300), ...result, ms: performance.now() - start });
    };
    const cut = () => finish({});
    const timer = setTimeout(cut, patience);
    const take = (piece) => {
      if (answer) {
        size += piece.length;
        if (answer.body.length < kept) answer.body += piece.toString('latin1', 0, kept);
      } else {
        text = Buffer.concat([text, piece]);
        const isInterim = () => /^HTTP\/1\.1 1/.test(text.toString('latin1', 0, 10));
        let end = text.indexOf('\r\n\r\n');
        for (; end >= 0 && isInterim(); end = text.indexOf('\r\n\r\n')) text = text.subarray(end + 4);
        if (end < 0) return;
        const [first, ...lines] = text.toString('latin1', 0, end).split('\r\n');
        const headers = Object.fromEntries(lines.map((line) => [line.split(': ')[0].toLowerCase(), line.slice(line.indexOf(': ') + 2)]));
        answer = { status: Number(first.split(' ')[1]), headers, body: text.toString('latin1', end + 4, end + 4 + kept) };
        size = text.length - end - 4;
      }
      if (size >= Number(answer.headers['content-length'] ?? 0)) finish(answer);
    };
    socket.on('data', take).on('close', cut).on('end', cut);
  });
}

// One request on a connection of its own.
export async function ask(port, method, path, { body, headers, patience } = {}) {
  const socket = await connected(port);
  const start = performance.now();
  const answer = answerOn(socket, patience);
  socket.write(head(method, path, body ? { 'Content-Length': body.length, ...headers } : headers));
  if (body) socket.write(body);
  const result = await answer;
  socket.destroy();
  return { ...result, ms: performance.now() - start };
}
export const get = (port, path, options) => ask(port, 'GET', path, options);
export const post = (port, path, body, options) => ask(port, 'POST', path, { body, ...options });

// Another client with small requests, on new connections, until stop(): { count, slowest, failed } of them.
export function smallRequests(port) {
  const seen = { count: 0, slowest: 0, failed: [] };
  let stopped = false;
  const one = async (method, path, body) => {
    const answer = await ask(port, method, path, { body, patience: 10_000 });
    ++seen.count;
    seen.slowest = Math.max(seen.slowest, answer.ms);
    if (answer.status !== 200) seen.failed.push(`${method} ${path}: ${answer.status} ${answer.body}`);
  };
  const loop = async (...request) => {
    while (!stopped) {
      await one(...request);
      await pause(20);
    }
  };
  const loops = Promise.all([loop('GET', '/livez'), loop('POST', '/v1/refine?level=1', tetrahedron)]);
  return {
    async stop() {
      stopped = true;
      await loops;
      return seen;
    },
  };
}
