// Shards joined, and reports made again: as if one run had done it all, and refused by name where
// that cannot be.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, readFileSync, rmSync, truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { copyReport } from './copied_report.mjs';
import { assertSameReport, filesBelow, isForPointLights, scratch, shadowproof }
  from './shadowproof.mjs';

const size = ['--size', '64x64'];
const verify = (out, ...args) => {
  const run = shadowproof(['verify', ...args, '--out', out]);
  assert.ok([0, 1, 3].includes(run.code), run.err);
  return run.code;
};
const textOf = (...path) => readFileSync(join(scratch, ...path), 'utf8');
const resultsOf = (folder) => JSON.parse(textOf(folder, 'results.json'));

const techniques = JSON.parse(shadowproof(['list', '--json']).out).techniques
  .filter(isForPointLights).map(({ name }) => name);

before(() => {
  verify('whole', 'near_plane', 'ordinary', ...size);
  verify('near', 'near_plane', ...size);
  verify('ordinary', 'ordinary', ...size);
  verify('pass', 'near_plane', 'ordinary', '--technique', 'zpass', ...size);
  const others = techniques.filter((name) => name !== 'zpass').join(',');
  verify('fail', 'near_plane', 'ordinary', '--technique', others, ...size);
});

test('shards by scene make the report of one whole run', () => {
  const run = shadowproof(['merge', 'near', 'ordinary/results.json', '--out', 'by-scene', '--json',
                           'joined.json']);
  assert.equal(run.code, 0, run.out + run.err);
  assertSameReport('by-scene', 'whole');
  assert.equal(textOf('joined.json'), textOf('by-scene', 'results.json'));
});

test('shards by technique make the report of one whole run, in the order of the techniques', () => {
  const run = shadowproof(['merge', 'fail', 'pass', '--out', 'by-technique']);
  assert.equal(run.code, 0, run.out + run.err);
  assertSameReport('by-technique', 'whole');
});

test('times of the shards are added up', () => {
  const sum = resultsOf('near').ms + resultsOf('ordinary').ms;
  assert.ok(Math.abs(resultsOf('by-scene').ms - sum) < 1e-6);
});

test('a shard that failed fails the whole, one that could not run makes it incomplete', () => {
  verify('failed', 'far_plane', '--technique', 'zfail', '--gate', 'differences', ...size);
  verify('fine', 'ordinary', '--technique', 'zfail_reversed', '--gate', 'differences', ...size);
  assert.equal(shadowproof(['merge', 'failed', 'fine', '--out', 'm1']).code, 1);
  assert.equal(resultsOf('m1').passed, false);
  writeFileSync(join(scratch, 'torn.gltf'), '{');
  verify('unread', 'torn.gltf', ...size);
  assert.equal(shadowproof(['merge', 'near', 'unread', '--out', 'm2']).code, 3);
});

test('runs that do not belong together are refused by file and field', () => {
  verify('larger', 'ordinary', '--size', '65x64');
  const changed = (name, change) => {
    cpSync(join(scratch, 'ordinary'), join(scratch, name), { recursive: true });
    const results = resultsOf(name);
    change(results);
    writeFileSync(join(scratch, name, 'results.json'), JSON.stringify(results));
    return name;
  };
  for (const [other, field] of [
    ['larger', /arguments/],
    [changed('newer', (results) => { results.version = '9.9.9'; }), /version/],
    [changed('driver', (results) => { results.gl.renderer = 'other'; }), /renderer/],
    [changed('embree', (results) => { results.embree = '4.0.0'; }), /embree/],
  ]) {
    const run = shadowproof(['merge', 'near', other, '--out', 'refused']);
    assert.equal(run.code, 3, other);
    assert.match(run.err, field);
    assert.match(run.err, new RegExp(other));
  }
  const content = changed('content', (results) => { results.scenes[0].digest = '0'.repeat(16); });
  const run = shadowproof(['merge', 'ordinary', content, '--out', 'refused']);
  assert.equal(run.code, 3);
  assert.match(run.err, /digest/);
  const twice = shadowproof(['merge', 'near', 'near', '--out', 'refused']);
  assert.equal(twice.code, 3);
  assert.match(twice.err, /zpass/);
  assert.ok(!filesBelow(scratch).some((file) => file.startsWith('refused')));
});

test('each shard keeps its own gate, and a cell names it where the whole has another', () => {
  verify('strict', 'far_plane', '--technique', 'zfail', '--gate', 'differences', ...size);
  verify('lenient', 'near_plane', '--technique', 'zpass', '--gate', 'differences', '--allow',
         'near_plane', ...size);
  verify('usual', 'ordinary', '--technique', 'zpass', ...size);
  const joined = (...shards) => {
    const { code } = shadowproof(['merge', ...shards, '--out', 'gates', '--json', 'gates.json']);
    const results = resultsOf('gates');
    const gates = results.scenes.map(({ techniques: [{ fails, gate, allow }] }) =>
      ({ fails, gate, allow }));
    return { code, gates, whole: [results.gate, results.allow, results.arguments] };
  };
  const own = { gate: undefined, allow: undefined };
  assert.deepEqual(joined('usual', 'lenient'), {
    code: 0,
    gates: [{ fails: false, ...own },
            { fails: false, gate: 'differences', allow: ['near_plane'] }],
    whole: ['defects', [], size],
  });
  // What is joined can be joined again: only what has another gate than the new whole names it.
  cpSync(join(scratch, 'gates'), join(scratch, 'first'), { recursive: true });
  assert.deepEqual(joined('strict', 'first'), {
    code: 1,
    gates: [{ fails: true, ...own }, { fails: false, gate: 'defects', allow: [] },
            { fails: false, gate: 'differences', allow: ['near_plane'] }],
    whole: ['differences', [], size],
  });
});

test('a report made again has the bytes of the first', () => {
  const run = shadowproof(['report', '--from', 'whole/results.json', '--out', 'again']);
  assert.equal(run.code, 0, run.out + run.err);
  const files = filesBelow(join(scratch, 'whole'));
  assert.deepEqual(filesBelow(join(scratch, 'again')), files);
  for (const file of files)
    assert.deepEqual(readFileSync(join(scratch, 'again', file)),
                     readFileSync(join(scratch, 'whole', file)), file);
});

test('what is missing or damaged is named, and the report is made with it missing', () => {
  cpSync(join(scratch, 'whole'), join(scratch, 'hurt'), { recursive: true });
  rmSync(join(scratch, 'hurt/near_plane/zpass.claim.png'));
  truncateSync(join(scratch, 'hurt/ordinary/truth.png'), 120);
  truncateSync(join(scratch, 'hurt/ordinary/zfail.cell.js'), 200);
  cpSync(join(scratch, 'larger/ordinary/truth.png'), join(scratch, 'hurt/near_plane/truth.png'));
  const run = shadowproof(['report', '--from', 'hurt', '--out', 'mended']);
  assert.equal(run.code, 0, run.err);
  for (const line of [/near_plane\/zpass\.claim\.png is missing/, /ordinary\/truth\.png is damaged/,
                      /ordinary\/zfail\.cell\.js is damaged/,
                      /near_plane\/truth\.png is 65x64, but the results say 64x64/])
    assert.match(run.out, line);
  assert.ok(!filesBelow(join(scratch, 'mended')).includes('near_plane/zpass.claim.png'));
});

test('results that are damaged are refused by pointer, whatever is wrong with them', () => {
  const whole = textOf('whole', 'results.json');
  const refused = (text, why) => {
    writeFileSync(join(scratch, 'bad.json'), text);
    const run = shadowproof(['report', '--from', 'bad.json', '--out', 'bad']);
    assert.equal(run.code, 3, run.out + run.err);
    assert.match(run.err, /bad\.json/);
    if (why) assert.match(run.err, why);
  };
  for (const part of [0, 1, 0.2, 0.5, 0.9]) refused(whole.slice(0, Math.floor(part * (whole.length - 3))));
  const with_ = (change) => {
    const results = JSON.parse(whole);
    change(results);
    return JSON.stringify(results);
  };
  refused(with_((r) => { delete r.gl; }), /gl/);
  refused(with_((r) => { r.schema = 'mine'; }), /schema/);
  refused(with_((r) => { r.format = 99; }), /format/);
  refused(with_((r) => { r.scenes[0].folder = '../up'; }), /\/scenes\/0\/folder/);
  refused(with_((r) => { r.scenes[1].techniques[2].images.claim = '/etc/passwd'; }),
          /\/scenes\/1\/techniques\/2\/images\/claim/);
  refused(with_((r) => { r.scenes[0].techniques[0].causes.moon = 1; }), /moon/);
  refused(with_((r) => { r.scenes[0].width = -4; }), /\/scenes\/0\/width/);
  const baseline = { file: 'base.json', passed: true, notes: [] };
  refused(with_((r) => { r.baseline = { ...baseline, notes: 3 }; }), /\/baseline\/notes/);
  refused(with_((r) => { r.baseline = { ...baseline, notes: [3] }; }), /\/baseline\/notes\/0/);
  refused(with_((r) => { r.baseline = { ...baseline, passed: 'yes' }; }), /\/baseline\/passed/);
});

test('every member of results, taken away or of another type, is refused or harmless', () => {
  const whole = JSON.parse(textOf('near', 'results.json'));
  const places = [];
  const walk = (value, path) => {
    if (value === null || typeof value !== 'object') return;
    for (const key of Object.keys(value)) {
      places.push([...path, key]);
      walk(value[key], [...path, key]);
    }
  };
  walk(whole, []);
  const seed = 20261121;
  let state = seed;
  const random = (below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state % below;
  };
  for (let i = 0; i < 60; ++i) {
    const place = places[random(places.length)];
    const copy = structuredClone(whole);
    const owner = place.slice(0, -1).reduce((at, key) => at[key], copy);
    const last = place.at(-1);
    if (random(3) === 0) delete owner[last];
    else owner[last] = [null, -1, 'x', [], {}, 1e300, true][random(7)];
    writeFileSync(join(scratch, 'mutant.json'), JSON.stringify(copy));
    const run = shadowproof(['report', '--from', 'mutant.json', '--out', 'mutant']);
    assert.ok([0, 1, 3].includes(run.code), `seed ${seed}, ${place.join('/')}: ${run.signal} ${run.err}`);
    if (run.code === 3 && run.err) assert.match(run.err, /mutant\.json/);
  }
});

test('a report is never made over the results that it is made from, unless whole', () => {
  cpSync(join(scratch, 'near'), join(scratch, 'in-place'), { recursive: true });
  const run = shadowproof(['report', '--from', 'in-place', '--out', 'in-place']);
  assert.equal(run.code, 0, run.err);
  assert.deepEqual(filesBelow(join(scratch, 'in-place')), filesBelow(join(scratch, 'near')));
});

test('the results are not written among the files that are read, nor under names of a report’s own', () => {
  for (const [file, words] of [['near/near_plane/truth.png', /lies in a report that is read/],
                               ['near/results.json', /lies in a report that is read/],
                               ['apart/near_plane/truth.png', /own pictures and data/]]) {
    const before = filesBelow(join(scratch, 'near'));
    const run = shadowproof(['merge', 'near', 'ordinary', '--out', 'apart', '--json', file]);
    assert.equal(run.code, 3, file);
    assert.match(run.err, words);
    assert.deepEqual(filesBelow(join(scratch, 'near')), before);
  }
});

test('more reports are joined than a process may open files', () => {
  verify('one', 'near_plane', '--technique', 'zpass', ...size);
  for (let i = 0; i < 60; ++i) copyReport(join(scratch, 'one'), join(scratch, `many/${i}`), `r${i}-`);
  const run = spawnSync('bash', ['-c', `ulimit -n 40 && exec "$SHADOWPROOF" merge ${Array.from({ length: 60 },
    (_, i) => `many/${i}`).join(' ')} --out many-joined -q`], { cwd: scratch, encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  assert.equal(resultsOf('many-joined').scenes.length, 60);
});
