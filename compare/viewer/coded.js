// Reads what compare/json/coded_lists.h writes: pictures and lists whose values are guessed from
// those before them, so that little had to be written. The arithmetic is the same, in integers.

/** Chances that bits are 1, learned from those that were read with them, by number. */
const newChances = (count) =>
  ({ ofOne: new Int32Array(count).fill(1 << 21), met: new Uint8Array(count) });

/** Reads the bits of a range coder from bytes; behind them it reads 0. */
class BitReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
    this.low = 0;
    this.high = 0xffffffff;
    this.code = 0;
    for (let i = 0; i < 4; ++i) this.code = (this.code << 8 | this.next()) >>> 0;
  }

  next() {
    return this.at < this.bytes.length ? this.bytes[this.at++] : 0;
  }

  bit({ ofOne, met }, k) {
    const share = ofOne[k] >> 6;
    const range = this.high - this.low;
    const middle = this.low + (range >>> 16) * share + ((range & 0xffff) * share >>> 16);
    const bit = this.code <= middle;
    if (bit) this.high = middle;
    else this.low = middle + 1;
    ofOne[k] += 2 * ((bit ? (1 << 22) - 1 : 1) - ofOne[k]) / (2 * met[k] + 3) | 0;
    if (met[k] < 60) ++met[k];
    while (((this.low ^ this.high) & 0xff000000) === 0) {
      this.low = this.low << 8 >>> 0;
      this.high = (this.high << 8 | 0xff) >>> 0;
      this.code = (this.code << 8 | this.next()) >>> 0;
    }
    return bit;
  }
}

/** Reads whole numbers: how many bits each has, then those behind its first. */
class NumberReader {
  constructor() {
    this.widths = newChances(33);
    this.first = newChances(4 * 33);
    this.others = newChances(33);
  }

  number(reader) {
    let width = 0;
    while (width < 32 && reader.bit(this.widths, width)) ++width;
    let value = width > 0 ? 1 : 0;
    for (let i = 1; i < width; ++i) {
      const bit = i < 3 ? reader.bit(this.first, 4 * width + value)
                        : reader.bit(this.others, width - i);
      value = 2 * value + (bit ? 1 : 0);
    }
    return value;
  }
}

/** -1 of 1, 1 of 2, -2 of 3, ... */
const unfolded = (value) => value >>> 1 ^ -(value & 1);

const spanLength = 16;
const chancesOfSpans = (5 << 11) + 1;

/** Whether `count` values from `first` are all `value`. */
function allAre(values, first, count, value) {
  for (let i = first; i < first + count; ++i)
    if (values[i] !== value) return false;
  return true;
}

/**
 * Of the span of pixels that begins at `i`, in column `x`: the number of its chance, or -1 where not
 * all that touches it has one value.
 */
function evenSpan(coded, guide, width, i, x, length) {
  const above = i - width;
  if (above < 0) return -1;
  const value = coded[above];
  const before = x > 0 ? 1 : 0;
  const behind = x + length < width ? 1 : 0;
  if (before > 0 && coded[i - 1] !== value) return -1;
  if (!allAre(coded, above - before, before + length + behind, value)) return -1;
  if (!guide) return chancesOfSpans;
  if (!allAre(guide, i, length, guide[i]) || !allAre(guide, above, length, guide[i])) return -1;
  return chancesOfSpans + (guide[i] === value ? 1 : 2);
}

/** A picture of areas into `values`; `guide` and `mask` may be null. */
function readAreas(reader, values, { width }, { guide, mask }) {
  if (!(Number.isInteger(width) && width > 0)) return; // damaged: the sum will say so
  const pixels = mask ? mask.length : values.length;
  const coded = mask ? new Uint32Array(pixels) : values;
  const has = mask ?? new Uint8Array(pixels).fill(1);
  const chances = newChances(6 << 11);
  const steps = new NumberReader();
  const guesses = [0, 0, 0, 0, 0];
  let last = 0;
  let largest = 0;
  let next = 0;
  for (let i = 0, x = 0; i < pixels; ++i, x = x + 1 < width ? x + 1 : 0) {
    if (has[i] === 0) continue;
    const above = i - width;
    if (!mask && x % spanLength === 0) {
      const length = Math.min(spanLength, width - x, pixels - i);
      const chance = evenSpan(coded, guide, width, i, x, length);
      if (chance >= 0 && reader.bit(chances, chance)) {
        last = coded[above];
        coded.fill(last, i, i + length);
        i += length - 1;
        x += length - 1;
        continue;
      }
    }
    const west = x > 0 && has[i - 1] ? coded[i - 1] : last;
    const north = above >= 0 && has[above] ? coded[above] : last;
    const northWest = x > 0 && above >= 0 && has[above - 1] ? coded[above - 1] : last;
    const northEast = x + 1 < width && above >= 0 && has[above + 1] ? coded[above + 1] : last;
    const farWest = x > 1 && has[i - 2] ? coded[i - 2] : last;
    const farNorth = above >= width && has[above - width] ? coded[above - width] : last;
    let context = (north === west ? 1 : 0) | (northWest === west ? 2 : 0) |
      (northWest === north ? 4 : 0) | (northEast === north ? 8 : 0) |
      (farWest === west ? 16 : 0) | (farNorth === north ? 32 : 0);
    let k = 0;
    if (guide) {
      const own = guide[i];
      const guideWest = x > 0 ? guide[i - 1] : own;
      const guideNorth = above >= 0 ? guide[above] : own;
      context |= (own === guideWest ? 64 : 0) | (own === guideNorth ? 128 : 0) |
        (west === guideWest ? 256 : 0) | (north === guideNorth ? 512 : 0) | 1024;
      guesses[k++] = own;
    }
    guesses[k++] = west;
    guesses[k++] = north;
    guesses[k++] = northEast;
    guesses[k++] = northWest;
    let value = guesses[0]; // not taken apart, which takes long
    let found = reader.bit(chances, context);
    for (let tried = 1; tried < k && !found; ++tried) {
      if (guesses.indexOf(guesses[tried]) < tried) continue;
      found = reader.bit(chances, tried << 11 | context);
      value = guesses[tried];
    }
    if (!found) {
      const isSlope = west !== north && west !== northWest && north !== northWest;
      value = reader.bit(chances, 5 << 11) ? largest + 1 >>> 0
        : (isSlope ? west + north - northWest : west) + unfolded(steps.number(reader)) >>> 0;
    }
    if (value > largest) largest = value;
    coded[i] = value;
    last = value;
    if (mask) values[next++] = value;
  }
}

/** What continues the plane through three neighbours, or at an edge the nearer of two. */
const continuedShade = (west, north, northWest) =>
  (northWest >= Math.max(west, north) ? Math.min(west, north)
    : northWest <= Math.min(west, north) ? Math.max(west, north) : west + north - northWest);

const missLevels = 12;
const missLevel = (sum) => (sum < 6 ? sum : Math.min(missLevels - 1, 35 - Math.clz32(sum)));
const signNumber = (value) => (value < 0 ? 2 : value > 0 ? 1 : 0);

/** A picture of shades into `values`; `guide` may be null. */
function readShades(reader, values, { width, channels }, { guide }) {
  if (!(channels === 1 || channels === 3)) return; // damaged: the sum will say so
  const row = width * channels;
  const rest = new Int32Array(values.length); // beyond the guide
  const misses = new Int32Array(values.length);
  const isZero = newChances(missLevels * missLevels * 4 * channels);
  const isMore = newChances(missLevels * 4 * channels * 8);
  const signs = newChances(9 * channels);
  const others = Array.from({ length: channels }, () => new NumberReader());
  for (let i = 0; i < values.length; ++i) {
    const channel = i % channels;
    const hasWest = i % row >= channels;
    const hasNorth = i >= row;
    const west = hasWest ? rest[i - channels] : 0;
    const north = hasNorth ? rest[i - row] : 0;
    const guess = !hasNorth ? west
      : continuedShade(west, north, hasWest ? rest[i - row - channels] : 0);
    const missWest = hasWest ? misses[i - channels] : 0;
    const before = channel > 0 ? misses[i - 1] : 0;
    const around = missLevel(Math.abs(missWest) + (hasNorth ? Math.abs(misses[i - row]) : 0) +
      (hasNorth && hasWest ? Math.abs(misses[i - row - channels]) : 0) +
      (hasNorth && i % row < row - channels ? Math.abs(misses[i - row + channels]) : 0));
    const beside = Math.min(3, Math.abs(before));
    const level = around * missLevels + missLevel(Math.abs(west) + Math.abs(north));
    let missed = 0;
    if (!reader.bit(isZero, (level * 4 + beside) * channels + channel)) {
      const isNegative = reader.bit(signs,
        (3 * signNumber(before) + signNumber(missWest)) * channels + channel);
      const first = ((around * 4 + beside) * channels + channel) * 8;
      let size = 1;
      while (size <= 8 && reader.bit(isMore, first + size - 1)) ++size;
      if (size > 8) size += others[channel].number(reader);
      missed = isNegative ? -size : size;
    }
    misses[i] = missed;
    rest[i] = guess + missed;
    values[i] = rest[i] + (guide ? guide[i] : 0);
  }
}

/** Of a hash, for a list of so many numbers. */
const hashBits = (numbers) => Math.min(18, Math.max(8, 32 - Math.clz32(numbers)));

/** What is known of the numbers of one column of a list: what followed others, by their hash. */
function newColumn(numbers) {
  const bits = hashBits(numbers);
  return { afterTwo: new Uint32Array(1 << bits), afterOne: new Uint32Array(1 << bits),
           shift: 32 - bits, byTwo: newChances(32), byOne: newChances(32), isNew: newChances(32),
           steps: new NumberReader(), largest: 0, hits: 0 };
}

/** The number behind `two` and `one`; `otherwise` is guessed where `one` is met first. */
function readNext(reader, column, two, one, otherwise) {
  const byOneAt = Math.imul(one, 0x9e3779b1) >>> column.shift;
  const byTwoAt = Math.imul(Math.imul(two, 0x9e3779b1) + one, 0x9e3779b1) >>> column.shift;
  const afterOne = column.afterOne[byOneAt] || otherwise;
  const afterTwo = column.afterTwo[byTwoAt] || afterOne;
  const context = column.hits & 15 | (afterTwo === afterOne ? 16 : 0);
  let value = afterTwo;
  const byTwo = reader.bit(column.byTwo, context);
  if (!byTwo) {
    value = afterOne;
    if (afterOne === afterTwo || !reader.bit(column.byOne, context))
      value = reader.bit(column.isNew, context) ? column.largest + 1 >>> 0
        : afterOne + unfolded(column.steps.number(reader)) >>> 0;
  }
  column.hits = column.hits << 1 | (byTwo ? 1 : 0);
  if (value > column.largest) column.largest = value;
  column.afterTwo[byTwoAt] = value;
  column.afterOne[byOneAt] = value;
  return value;
}

/** Rows of `columns` numbers each into `values`. */
function readSequence(reader, values, { columns }) {
  const all = Array.from({ length: columns }, () => newColumn(values.length));
  for (let i = 0; i < values.length; ++i)
    values[i] = readNext(reader, all[i % columns], i >= 2 ? values[i - 2] : 0,
                         i >= 1 ? values[i - 1] : 0, i >= columns ? values[i - columns] : 0);
}

const rememberedEach = 4;

/** The numbers that stood for others last, by their hash and the last first. */
function newReplacements(numbers) {
  const bits = hashBits(numbers);
  return { last: new Uint32Array(rememberedEach << bits), shift: 32 - bits,
           chances: newChances(4 * rememberedEach) };
}

/** The place in `last` of what stands for `number`, which is 0 there if it is none of those known. */
function readReplacement(reader, { last, shift, chances }, number, kind) {
  const first = rememberedEach * (Math.imul(4 * number + kind, 0x9e3779b1) >>> shift);
  let k = 0;
  let found = false;
  while (k < rememberedEach && last[first + k] !== 0 && !found) {
    found = reader.bit(chances, rememberedEach * kind + k);
    ++k;
  }
  const value = found ? last[first + k - 1] : 0;
  const moved = found ? k - 1 : rememberedEach - 1;
  last.copyWithin(first + 1, first, first + moved);
  last[first] = value;
  return first;
}

/** Rows with a 0 behind each into `values`. */
function readRows(reader, values) {
  const column = newColumn(values.length);
  const replacements = newReplacements(values.length);
  const [counts, gaps, removals] = [new NumberReader(), new NumberReader(), new NumberReader()];
  const additions = Array.from({ length: 8 }, () => new NumberReader());
  let before = 0; // where the row before begins, and ends
  let endBefore = 0;
  for (let row = 0; row < values.length;) {
    let at = row;
    for (let edits = counts.number(reader); edits > 0; --edits) {
      const gap = gaps.number(reader);
      const removed = removals.number(reader);
      const added = additions[Math.min(removed, 7)].number(reader);
      if (before + gap + removed > endBefore || at + gap + added >= values.length ||
          removed + added === 0) return;
      values.copyWithin(at, before, before + gap);
      at += gap;
      before += gap;
      for (let k = 0; k < added; ++k, ++at) {
        const one = at > row ? values[at - 1] : 0;
        const replaces = k < removed;
        const inserts = removed === 0 && k === 0 && before < endBefore;
        const kind = replaces ? (k === 0 ? 0 : 1) : inserts ? 2 : 3;
        const place = readReplacement(reader, replacements,
                                      replaces || inserts ? values[before + k] : one, kind);
        if (replacements.last[place] === 0)
          replacements.last[place] =
            readNext(reader, column, at > row + 1 ? values[at - 2] : 0, one, one);
        values[at] = replacements.last[place];
      }
      before += removed;
    }
    if (at + endBefore - before >= values.length) return;
    values.copyWithin(at, before, endBefore);
    at += endBefore - before;
    [before, endBefore] = [row, at];
    row = at + 1;
  }
}

const codedReaders = { areas: readAreas, shades: readShades, sequence: readSequence, rows: readRows };

/** FNV-1a of numbers of 32 bits. */
function sumOf(values) {
  let sum = 2166136261;
  for (let i = 0; i < values.length; ++i) sum = Math.imul(sum ^ values[i], 16777619);
  return sum >>> 0;
}

/** The characters of a script that is read as x-user-defined, as bytes. */
function bytesOf(text) {
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The numbers of a block: `length` of 32 bits each; `how`: its guide and mask. Throws an Error where they are damaged. */
function codedNumbers(block, length, how) {
  const values = new Uint32Array(length);
  codedReaders[block.as](new BitReader(bytesOf(block.data)), values, block, how);
  if (sumOf(values) !== block.sum) throw new Error('is damaged: it does not decode');
  return values;
}
