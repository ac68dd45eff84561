// Blocks of a report's data files, read and changed.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { named } from './scripts.mjs';

const { codedNumbers, newChances, sumOf } =
  named(['coded.js'], ['codedNumbers', 'newChances', 'sumOf']);

/** A block of that name: its members up to its data, and those. */
const blockNamed = (name) =>
  new RegExp(`("${name}":\\{"type"[^}]*?"data":")((?:[^"\\\\]|\\\\.)*)"`, 's');

const unquoted = (text) => text.replace(/\\(.)/g, (_, c) => ({ n: '\n', r: '\r' }[c] ?? c));
const quoted = (text) => text.replace(/["\\\n\r]/g, (c) => `\\${{ '\n': 'n', '\r': 'r' }[c] ?? c}`);

/** Text of a script whose characters are bytes, rewritten. */
export function rewriteBytes(path, change) {
  const old = readFileSync(path, 'latin1');
  const changed = change(old);
  if (changed === old) throw new Error(`${path} is as it was`);
  writeFileSync(path, changed, 'latin1');
}

/** Changes the first bytes of a block. */
export const damageBlock = (path, name) => rewriteBytes(path, (old) =>
  old.replace(blockNamed(name), (_, before, data) =>
    `${before}${data[0] === '\\' ? '~~~~' : 'AAAA'}${data.slice(4).replace(/^\\*/, '')}"`));

const scriptOf = (report, scene, technique) =>
  readFileSync(join(report, scene, `${technique}.cell.js`), 'latin1');

/** The numbers of a block of a cell, or of its scene's file; `guides`: those that it may be guessed from. */
function numbersIn(report, scene, technique, name, guides) {
  const script = technique ? scriptOf(report, scene, technique)
    : readFileSync(join(report, scene, 'scene.js'), 'latin1');
  const elsewhere = new RegExp(`"${name}":\\{"from":"(\\w+)/(\\w+)"`).exec(script);
  if (elsewhere) return numbersIn(report, scene, elsewhere[1], elsewhere[2], guides);
  const [, before, data] = blockNamed(name).exec(script);
  const block = JSON.parse(`{${before}"}}`)[name];
  block.data = unquoted(data);
  return codedNumbers(block, block.length, { guide: block.guide ? guides[block.guide] : null });
}

/** Bits as BitReader reads them. */
class BitWriter {
  constructor() {
    this.low = 0n;
    this.high = 0xffffffffn;
    this.bytes = [];
  }

  bit(bit, { ofOne, met }, k) {
    const middle = this.low + ((this.high - this.low) * BigInt(ofOne[k] >> 6) >> 16n);
    if (bit) this.high = middle;
    else this.low = middle + 1n;
    ofOne[k] += Math.trunc(2 * ((bit ? (1 << 22) - 1 : 1) - ofOne[k]) / (2 * met[k] + 3));
    if (met[k] < 60) ++met[k];
    while ((this.low ^ this.high) >> 24n === 0n) {
      this.bytes.push(Number(this.high >> 24n));
      this.low = this.low << 8n & 0xffffffffn;
      this.high = (this.high << 8n | 0xffn) & 0xffffffffn;
    }
  }

  number(value, { widths, first, others }) {
    const width = value === 0 ? 0 : 32 - Math.clz32(value);
    for (let i = 0; i < width; ++i) this.bit(true, widths, i);
    if (width < 32) this.bit(false, widths, width);
    let above = 1;
    for (let i = 1; i < width; ++i) {
      const bit = (value >>> width - 1 - i & 1) === 1;
      this.bit(bit, i < 3 ? first : others, i < 3 ? 4 * width + above : width - i);
      above = 2 * above + (bit ? 1 : 0);
    }
  }

  end() {
    if (this.low > 0n) this.bytes.push(Number(this.low >> 24n) + 1);
    return String.fromCharCode(...this.bytes);
  }
}

/** A list of bytes as a sequence of one column, with one chance for what is new and no guess kept. */
function sequenceOf(values) {
  const writer = new BitWriter();
  const chances = { byTwo: newChances(32), byOne: newChances(32), isNew: newChances(32) };
  const steps = { widths: newChances(33), first: newChances(4 * 33), others: newChances(33) };
  const bits = Math.min(18, Math.max(8, 32 - Math.clz32(values.length)));
  const hash = (number) => Math.imul(number, 0x9e3779b1) >>> 32 - bits;
  const [afterTwo, afterOne] = [new Uint32Array(1 << bits), new Uint32Array(1 << bits)];
  let [largest, hits] = [0, 0];
  values.forEach((value, i) => {
    const one = i >= 1 ? values[i - 1] : 0;
    const key = hash(Math.imul(i >= 2 ? values[i - 2] : 0, 0x9e3779b1) + one);
    const byOne = afterOne[hash(one)] || one;
    const byTwo = afterTwo[key] || byOne;
    const context = hits & 15 | (byTwo === byOne ? 16 : 0);
    writer.bit(value === byTwo, chances.byTwo, context);
    if (value !== byTwo) {
      if (byOne !== byTwo) writer.bit(value === byOne, chances.byOne, context);
      if (byOne === byTwo || value !== byOne) {
        writer.bit(value === largest + 1, chances.isNew, context);
        const step = value - byOne;
        if (value !== largest + 1) writer.number((step << 1 ^ step >> 31) >>> 0, steps);
      }
    }
    hits = hits << 1 | (value === byTwo ? 1 : 0);
    largest = Math.max(largest, value);
    afterTwo[key] = value;
    afterOne[hash(one)] = value;
  });
  return writer.end();
}

/** Changes the bytes of a block of a cell that is guessed from its claim. */
export function changeBlock(report, scene, technique, name, change) {
  const visibility = numbersIn(report, scene, null, 'visibility', {});
  const claim = numbersIn(report, scene, technique, 'claim', { visibility });
  const values = numbersIn(report, scene, technique, name, { claim });
  change(values);
  const block = `{"type":"u8","length":${values.length},"as":"sequence","columns":1,` +
    `"sum":${sumOf(values)},"data":"${quoted(sequenceOf([...values]))}"`;
  const elsewhere = new RegExp(`"${name}":\\{"from":"[^"]*"`);
  rewriteBytes(join(report, scene, `${technique}.cell.js`), (old) =>
    old.replace(elsewhere.test(old) ? elsewhere : blockNamed(name), () => `"${name}":${block}`));
}
