// Everything that the README shows is run, and what it lists is compared with the daemon's own description.
//
// A block marked `sh` that calls curl is a command; a block marked `json` right after it is its answer, word for
// word.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { validateGltf, Workshop } from './commands.mjs';
import { Contract } from './contract.mjs';
import { root, startDaemon } from './daemon.mjs';

const readme = readFileSync(join(root, 'README.md'), 'utf8');
const blocks = [...readme.matchAll(/^```(\w*)\n([\s\S]*?)^```$/gm)].map(([, language, text]) => ({ language, text: text.trim() }));
const commands = blocks.map((block, index) => ({ ...block, next: blocks[index + 1] }))
  .filter(({ language, text }) => language === 'sh' && text.includes('curl'))
  .map(({ text, next }) => ({ text, answer: next?.language === 'json' ? next.text : undefined }));
const pasted = readFileSync(join(root, 'tests/e2e/curl_lines.txt'), 'utf8').split('\n').filter(Boolean);

let daemon, contract, workshop;
before(async () => {
  daemon = await startDaemon();
  contract = await Contract.of(daemon.url);
  workshop = new Workshop(daemon.url);
});
after(async () => {
  workshop.remove();
  await daemon.stop();
});

function check(command, expected) {
  const { code, stdout, stderr, answers, files } = workshop.run(command);
  assert.equal(code, 0, stderr);
  assert.ok(answers.length > 0, 'curl did not talk to the daemon');
  const wanted = expected === undefined ? undefined : JSON.parse(expected);
  for (const answer of answers) {
    assert.equal(answer.status, wanted?.status ?? 200, stdout);
    assert.deepEqual(contract.faults({ ...answer, body: stdout }), []);
  }
  if (wanted !== undefined) assert.deepEqual(JSON.parse(stdout), wanted);
  if (files.length > 0) {
    const { valid, report } = validateGltf(files);
    assert.ok(valid, report);
  }
}

test('the README shows commands, answers and a GLB', () => {
  assert.ok(commands.length >= 5);
  assert.ok(commands.filter(({ answer }) => answer !== undefined).length >= 2);
  assert.ok(commands.some(({ text }) => text.includes('sample.glb')));
});

for (const { text, answer } of commands)
  test(`README: ${text.split('\n')[0].slice(0, 90)}`, () => check(text, answer));

for (const line of pasted) test(`what ./dev run prints: ${line.slice(0, 90)}`, () => check(line));

test('one line that ./dev run prints stands in the README', () => {
  assert.ok(pasted.some((line) => readme.includes(line)));
});

// Rows of the table under a heading, cells without backquotes.
function tableUnder(heading) {
  const section = readme.split(new RegExp(`^## ${heading}$`, 'm'))[1]?.split(/^## /m)[0] ?? '';
  return section.split('\n').filter((line) => line.startsWith('| `'))
    .map((line) => line.split('|').slice(1, -1).map((cell) => cell.trim().replaceAll('`', '')));
}

test('the table of options is that of the OpenAPI document', () => {
  const described = contract.document.paths['/v1/refine'].post.parameters
    .map((parameter) => (parameter.$ref ? contract.document.components.parameters[parameter.$ref.split('/').at(-1)] : parameter))
    .map(({ name, schema }) => [name, schema.enum ? schema.enum.join(' ') : schema.type, schema.default === undefined ? '' : String(schema.default)]);
  const listed = tableUnder('Options').map(([name, values, fallback]) => [name, values, fallback]);
  // An option without a default in the document has one that depends on the request: a text in brackets.
  assert.deepEqual(listed.map(([name, values, fallback]) => [name, values.startsWith('integer') ? 'integer' : values, fallback.startsWith('(') ? '' : fallback]), described);
});

test('the table of endpoints is that of the OpenAPI document', () => {
  const described = Object.entries(contract.document.paths)
    .flatMap(([path, operations]) => Object.keys(operations).map((method) => `${method.toUpperCase()} ${path}`));
  assert.deepEqual(tableUnder('Endpoints').map(([endpoint]) => endpoint).sort(), described.sort());
});
