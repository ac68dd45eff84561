// The page reads from blocks what compare/json writes into them: pictures of any width, with a
// guide and with a mask.
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import assert from 'node:assert/strict';
import { named } from './scripts.mjs';

const { codedNumbers } = named(['coded.js'], ['codedNumbers']);

const script = execFileSync(process.env.CODED_LISTS, { maxBuffer: 1 << 28 }).toString('latin1');
const lists = Function(`return ${script}`)();
const orNull = (list) => (list.length > 0 ? Uint32Array.from(list) : null);

test('every list is read as it was written', () => {
  assert.ok(lists.length > 800);
  for (const { values, guide, mask, block } of lists) {
    const read = codedNumbers(block, block.length, { guide: orNull(guide), mask: orNull(mask) });
    assert.deepEqual([...read], values, `${block.as}, ${block.width} wide`);
  }
});

test('pixels of one value are read from next to nothing', () => {
  const even = lists.filter(({ values, mask, block }) => block.as === 'areas' && mask.length === 0 &&
    values.length === 2000 && values.every((value) => value === 1));
  assert.ok(even.length >= 2);
  for (const { block } of even) assert.ok(block.data.length < 12, `${block.data.length} bytes`);
});

test('a width that no picture has is damage, too', () => {
  const { block } = lists.find(({ values, mask, guide, block: { as } }) =>
    as === 'areas' && mask.length === 0 && guide.length === 0 && values.some((value) => value > 0));
  for (const width of [0, -12, 1.5, null])
    assert.throws(() => codedNumbers({ ...block, width }, block.length, {}), /damaged/);
});

test('a block whose bytes were changed is refused', () => {
  const { guide, block } = lists.find(({ values, block: { as } }) => as === 'areas' && values.length > 500);
  const damaged = { ...block, data: `~~~~${block.data.slice(4)}` };
  assert.throws(() => codedNumbers(damaged, block.length, { guide: orNull(guide), mask: null }),
    /damaged/);
});
