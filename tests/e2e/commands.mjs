// Runs shell commands that call curl, as somebody would paste them, and says what came of it.
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { root } from './daemon.mjs';

export const writtenUrl = 'http://127.0.0.1:8080';  // in every text; the tests' daemon has another port

// A folder where `tests/shapes/…` and `proto/examples/…` can be read and files can be written.
export class Workshop {
  constructor(url) {
    this.url = url;
    this.folder = mkdtempSync(join(tmpdir(), 'subdivd-e2e-'));
    for (const folder of ['tests', 'proto']) symlinkSync(join(root, folder), join(this.folder, folder));
    this.runs = 0;
  }

  remove() {
    rmSync(this.folder, { recursive: true });
  }

  // { code, stdout, stderr, answers: [{ status, type, method, path }], files: [new .glb and .gltf files] }
  run(command) {
    const heads = join(this.folder, `heads-${++this.runs}`);
    mkdirSync(heads);
    const before = new Set(readdirSync(this.folder));
    const noted = `curl() { command curl --silent --show-error --max-time 60 --dump-header "$HEADS/$BASHPID-$RANDOM" "$@"; }\n`;
    const { status: code, stdout, stderr } = spawnSync('bash', ['-eu', '-o', 'pipefail', '-c', noted + command.replaceAll(writtenUrl, this.url)],
      { cwd: this.folder, env: { ...process.env, HEADS: heads }, encoding: 'utf8', maxBuffer: 1 << 28 });
    const path = command.match(/127\.0\.0\.1:8080(\/[^\s'"?]*)/)?.[1];
    const method = /--data|--json| -d /.test(command) ? 'POST' : 'GET';
    const answers = readdirSync(heads).map((file) => ({ ...head(readFileSync(join(heads, file), 'latin1')), method, path }));
    const files = readdirSync(this.folder).filter((file) => !before.has(file) && /\.gl(b|tf)$/.test(file));
    return { code, stdout, stderr, answers, files: files.map((file) => join(this.folder, file)) };
  }
}

// The last head counts: 100 Continue may come before it.
function head(text) {
  const last = text.trim().split('\r\n\r\n').at(-1);
  return { status: Number(last.split(' ')[1]), type: last.match(/^content-type: *(.*?)\r?$/im)?.[1] ?? '' };
}

// Exit code and output of Khronos' validator.
export function validateGltf(files) {
  const { status, stdout } = spawnSync(process.execPath, [join(root, 'tests/e2e/validate_gltf.mjs'), ...files], { encoding: 'utf8' });
  return { valid: status === 0, report: stdout };
}
