// A daemon for one test, and what the kernel tells of its process.
import { readFileSync } from 'node:fs';
import { setTimeout as pause } from 'node:timers/promises';
import { startDaemon } from '../e2e/daemon.mjs';

export const MiB = 2 ** 20;
export const GiB = 2 ** 30;
export const isLong = process.env.SUBDIVD_ATTACK === 'long';

// It is killed afterwards, whatever it is at.
export async function withDaemon(flags, body, options) {
  const daemon = await startDaemon(flags, options);
  try {
    await body(daemon);
  } finally {
    daemon.child.kill('SIGKILL');
  }
}

function statusBytes(daemon, name) {
  const status = readFileSync(`/proc/${daemon.child.pid}/status`, 'utf8');
  return Number(status.match(new RegExp(`^${name}:\\s+(\\d+) kB`, 'm'))[1]) * 1024;
}
export const residentBytes = (daemon) => statusBytes(daemon, 'VmRSS');
export const peakBytes = (daemon) => statusBytes(daemon, 'VmHWM');
export const virtualBytes = (daemon) => statusBytes(daemon, 'VmSize');
export const inMiB = (bytes) => `${Math.round(bytes / MiB)} MiB`;

// Seconds of processor time that the daemon has used.
export function processorSeconds(daemon) {
  const fields = readFileSync(`/proc/${daemon.child.pid}/stat`, 'latin1').split(') ')[1].split(' ');
  return (Number(fields[11]) + Number(fields[12])) / 100;
}

export async function eventually(condition, patience) {
  const deadline = performance.now() + patience;
  while (performance.now() < deadline) {
    if (await condition()) return true;
    await pause(50);
  }
  return condition();
}

// The exit code, a signal's name, or 'still running' after `patience` milliseconds.
export function stopWithin(daemon, patience) {
  return Promise.race([daemon.stop(), pause(patience, 'still running', { ref: false })]);
}
