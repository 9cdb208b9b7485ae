// Starts the daemon on a port that the kernel chooses, and ends it again.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';

export const root = process.env.SUBDIVD_SOURCE_DIR ?? join(dirname(fileURLToPath(import.meta.url)), '../..');
const program = process.env.SUBDIVD_DAEMON ?? join(root, 'build/subdivd');

// Resolves once /readyz says 200: { url, stop(signal) }. stop resolves to the exit code, or to the name of the
// signal that killed the daemon.
export async function startDaemon(flags = []) {
  const child = spawn(program, ['--port', '0', '--log-level', 'error', ...flags], { stdio: ['ignore', 'pipe', 'inherit'] });
  const ended = once(child, 'exit').then(([code, signal]) => code ?? signal);
  process.once('exit', () => child.kill('SIGKILL'));  // a failed test must not leave a daemon behind
  const url = await Promise.race([urlPrintedBy(child), ended.then((code) => { throw new Error(`the daemon ended with ${code}`); })]);
  await untilReady(url);
  return {
    url,
    stop(signal = 'SIGTERM') {
      child.kill(signal);
      return ended;
    },
  };
}

async function urlPrintedBy(child) {
  for await (const line of createInterface({ input: child.stdout })) {
    const found = line.match(/http:\/\/\S+/);
    if (found) return found[0];
  }
  throw new Error('the daemon printed no address');
}

async function untilReady(url) {
  for (let tries = 0; tries < 600; ++tries) {
    if ((await fetch(`${url}/readyz`)).status === 200) return;
    await pause(50);
  }
  throw new Error('the daemon is not ready after 30 s');
}
