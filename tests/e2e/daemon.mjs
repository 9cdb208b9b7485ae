// Starts the daemon on a port that the kernel chooses, and ends it again.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';

export const root = process.env.SUBDIVD_SOURCE_DIR ?? join(dirname(fileURLToPath(import.meta.url)), '../..');
const program = process.env.SUBDIVD_DAEMON ?? join(root, 'build/subdivd');

// Resolves once /readyz says 200: { url, port, child, stop(signal) }. stop resolves to the exit code, or to the name of
// the signal that killed the daemon. `log` is where its stderr goes, `inShell` a command before it ('ulimit -v 1000000').
export async function startDaemon(flags = [], { log = 'inherit', inShell } = {}) {
  const level = flags.includes('--log-level') ? [] : ['--log-level', 'error'];
  const words = [program, '--port', '0', ...level, ...flags];
  if (inShell) words.unshift('sh', '-c', `${inShell}; exec "$@"`, 'sh');
  const child = spawn(words[0], words.slice(1), { stdio: ['ignore', 'pipe', log] });
  const ended = once(child, 'exit').then(([code, signal]) => code ?? signal);
  const kill = () => child.kill('SIGKILL');
  process.once('exit', kill);  // a failed test must not leave a daemon behind
  child.once('exit', () => process.off('exit', kill));
  const url = await Promise.race([urlPrintedBy(child), ended.then((code) => { throw new Error(`the daemon ended with ${code}`); })]);
  await untilReady(url);
  return {
    url,
    port: Number(new URL(url).port),
    child,
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
