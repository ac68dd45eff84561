// The manual page and the completion in bash have every command and every option of --help.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from '../shadowproof.mjs';

const helpOf = (command) => shadowproof([command, '--help'].filter(Boolean)).out;
const page = shadowproof(['--man-page']);
const script = shadowproof(['--completion']);
writeFileSync(join(scratch, 'completion.bash'), script.out);

const commands = [...helpOf('').match(/\nSubcommands:\n([^]*?)\n\n/)[1].matchAll(/^ {2}(\S+)/gm)]
  .map(([, name]) => name);
/** Short and long, as --help has them. */
const optionsOf = (command) => [...helpOf(command).matchAll(/^ {2}(-\S+)/gm)]
  .flatMap(([, names]) => names.split(','));

/** What bash offers for the last of the words. */
function offered(...words) {
  const program = 'source completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _shadowproof; ' +
                  '((${#COMPREPLY[@]} == 0)) || printf "%s\\n" "${COMPREPLY[@]}"';
  const run = spawnSync('bash', ['-c', program, 'bash', 'shadowproof', ...words],
                        { cwd: scratch, encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  assert.equal(run.stderr, '');
  return run.stdout.split('\n').filter(Boolean);
}

test('help has commands and options to compare with', () => {
  assert.ok(commands.length >= 12, commands);
  assert.ok(commands.includes('verify') && commands.includes('normal-map'));
  assert.ok(optionsOf('verify').length > 40);
});

test('the manual page has every command, with each of its options and examples', () => {
  assert.equal(page.code, 0, page.err);
  const text = page.out.replaceAll('\\-', '-').replaceAll('\\e', '\\');
  const sections = Object.fromEntries(text.split(/^\.SS /m).slice(1)
    .map((section) => [section.split('\n')[0], section.split(/^\.SH /m)[0]]));
  assert.deepEqual(Object.keys(sections), commands);
  for (const command of ['', ...commands]) {
    const section = command === '' ? text.split('.SH COMMANDS')[0] : sections[command];
    const named = [...section.matchAll(/\\fB(--?[^\\]+)\\fR/g)].map(([, name]) => name);
    assert.deepEqual(named, optionsOf(command), command);
    const examples = helpOf(command).match(/\nExamples:\n([^]*?)(\n\n|\n?$)/)[1];
    for (const [, line] of examples.matchAll(/^ {2}(shadowproof.*)$/gm))
      assert.ok(text.includes(`\\fB${line}\\fR`), line);
  }
});

test('roff has no complaint of the manual page', (t) => {
  const run = spawnSync('groff', ['-man', '-Tutf8', '-ww', '-z'], { input: page.out, encoding: 'utf8' });
  if (run.error) return t.skip('groff is not installed');
  assert.equal(run.status, 0);
  assert.equal(run.stderr, '');
});

test('bash completes every command and every option', () => {
  assert.equal(script.code, 0, script.err);
  assert.deepEqual(offered(''), commands);
  for (const command of ['', ...commands])
    assert.deepEqual(offered(...[command].filter(Boolean), '-'), optionsOf(command), command);
});

test('bash completes names, choices and files, and nothing where it knows nothing', () => {
  const { scenes, techniques, causes } = JSON.parse(shadowproof(['list', '--json']).out);
  const names = (all) => all.map(({ name }) => name);
  assert.deepEqual(offered('verify', '--technique', ''), names(techniques));
  assert.deepEqual(offered('verify', '--technique', 'auto,zpass_e'), ['auto,zpass_eye_count']);
  assert.deepEqual(offered('verify', '--technique', '=', 'zfail_sat'), ['zfail_saturate']);
  assert.deepEqual(offered('verify', '--allow', ''), names(causes));
  assert.deepEqual(offered('accept', '--reason', 'ac'), ['acne=']);
  assert.deepEqual(offered('verify', '--gl', '='), ['osmesa', 'egl']);
  assert.deepEqual(offered('export-view', '--engine', 'three,u'), ['three,unity', 'three,unreal']);
  assert.deepEqual(offered('stress', '--parameter', 'denorm'), ['denormal']);
  assert.deepEqual(offered('verify', '--size', ''), []);
  assert.deepEqual(offered('list', ''), []);
  for (const command of ['verify', 'check', 'render', 'explain', 'stress', 'bench', 'export-view']) {
    const all = offered(command, '');
    assert.deepEqual(names(scenes).filter((name) => !all.includes(name)), [], command);
  }
  writeFileSync(join(scratch, 'nearer.glb'), '');
  writeFileSync(join(scratch, 'nearer.txt'), '');
  assert.ok(offered('verify', 'near').includes('nearer.glb'));
  assert.ok(!offered('verify', 'near').includes('nearer.txt'));
  assert.deepEqual(offered('verify', '--baseline', 'nearer'), ['nearer.glb', 'nearer.txt']);
});

test('each example of --help is of its command, and has its options alone', () => {
  for (const command of commands) {
    const lines = [...helpOf(command).matchAll(/^ {2}shadowproof (\S+) ?(.*)$/gm)];
    assert.ok(lines.length > 0, command);
    for (const [, first, rest] of lines) {
      assert.equal(first, command);
      for (const [flag] of rest.matchAll(/(?<=^| )-\S+/g))
        assert.ok(optionsOf(command).includes(flag), `${command} ${flag}`);
    }
  }
});
