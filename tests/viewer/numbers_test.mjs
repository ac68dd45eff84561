// Numbers are printed as the command prints them: the C library is the judge.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { randomNumbers, seed } from './random.mjs';
import { named } from './scripts.mjs';

const { printed, grouped, asCount } =
  named(['numbers.js', 'families/families.js', 'families/stencil/counters.js'],
        ['printed', 'grouped', 'asCount']);

/** awk reads a double and gives it to printf. 17 digits name every double. */
function byPrintf(values) {
  const run = spawnSync('awk', ['{ printf "%.9g\\n", $1 }'], {
    input: values.map((value) => value.toExponential(16)).join('\n') + '\n', encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  return run.stdout.trimEnd().split('\n');
}

function sameAsPrintf(values) {
  byPrintf(values).forEach((text, i) => assert.equal(printed(values[i]), text, `${values[i]}`));
}

test('ties go to the even digit, as C has it and JavaScript does not', () => {
  const ties = [1234567.125, 1234567.375, 12345678.25, 12345678.75, 123456789.5, 123456788.5,
                1.0000000005, 0.5 + 2 ** -10, 2 ** -40, 1073741824.5, 4294967295.5, 999999999.5];
  sameAsPrintf([...ties, ...ties.map((value) => -value)]);
  assert.equal(printed(1234567.125), '1234567.12');
  assert.equal(printed(1234567.375), '1234567.38');
});

test('both notations meet where C has them meet', () => {
  sameAsPrintf([0, 1, 100, 1e8, 123456789, 1e9, 999999999.9, 1e21, 1e-4, 9.99999999999e-5, 1e-5,
                0.0001234567891, 5e-324, 1.7976931348623157e308, 71.3, 0.1, -0.125, 1e100]);
  assert.equal(printed(-0), '-0');
  assert.equal(printed(Infinity), 'inf');
  assert.equal(printed(-Infinity), '-inf');
});

test(`twenty thousand doubles of every size (seed ${seed})`, () => {
  const random = randomNumbers();
  const bytes = new DataView(new ArrayBuffer(8));
  const values = [];
  while (values.length < 10000) {
    bytes.setUint32(0, random() * 2 ** 32);
    bytes.setUint32(4, random() * 2 ** 32);
    const value = bytes.getFloat64(0);
    if (Number.isFinite(value)) values.push(value);
  }
  for (let i = 0; i < 10000; ++i) values.push((random() - 0.5) * 10 ** Math.floor(random() * 12 - 4));
  sameAsPrintf(values);
});

test('counts are grouped, and a stored counter is the signed count it stands for', () => {
  assert.equal(grouped(1234567), '1,234,567');
  assert.equal(grouped(999), '999');
  assert.equal(asCount(255, 8), -1);
  assert.equal(asCount(127, 8), 127);
});
