// Numbers as the command prints them.

/** Whether the decimal expansion of `magnitude` ends in exactly a 5 after `digits` digits. */
function halfway(magnitude, digits) {
  // No double comes nearer than some 1e-34 to a short decimal that it does not equal, so that
  // 40 more digits tell a tie from a near miss.
  const more = magnitude.toExponential(digits + 39).split('e')[0].replace('.', '');
  return /^50*$/.test(more.slice(digits)) ? more.slice(0, digits) : null;
}

/** [digits, exponent] of a positive number, ties to even as C has it; JavaScript takes them up. */
function roundedDigits(magnitude, digits) {
  const [mantissa, exponent] = magnitude.toExponential(digits - 1).split('e');
  const down = halfway(magnitude, digits);
  if (down !== null && Number(down[digits - 1]) % 2 === 0)
    return [down, Number(magnitude.toExponential(digits + 39).split('e')[1])];
  return [mantissa.replace('.', ''), Number(exponent)];
}

const withoutZeros = (text) => text.includes('.') ? text.replace(/\.?0*$/, '') : text;

/** The text of printf("%.9g"), which is that of C++ {:.9g}. */
function printed(value, digits = 9) {
  if (Number.isNaN(value)) return 'nan';
  const sign = value < 0 || Object.is(value, -0) ? '-' : '';
  if (!Number.isFinite(value)) return `${sign}inf`;
  if (value === 0) return `${sign}0`;
  const [all, exponent] = roundedDigits(Math.abs(value), digits);
  if (exponent < -4 || exponent >= digits) {
    const power = (exponent < 0 ? '-' : '+') + String(Math.abs(exponent)).padStart(2, '0');
    return `${sign}${withoutZeros(`${all[0]}.${all.slice(1)}`)}e${power}`;
  }
  if (exponent < 0) return sign + withoutZeros(`0.${'0'.repeat(-exponent - 1)}${all}`);
  return sign + withoutZeros(`${all.slice(0, exponent + 1)}.${all.slice(exponent + 1)}`);
}

const printedPoint = (point) => `(${point.map((value) => printed(value)).join(', ')})`;

/** 12345 as "12,345". */
const grouped = (count) => String(count).replace(/\B(?=(\d{3})+(?!\d))/g, ',');

const counted = (count, one, many = `${one}s`) => `${grouped(count)} ${count === 1 ? one : many}`;

/** "+1", "-1" with a hyphen as the command has it, "0". */
const signed = (value) => (value > 0 ? `+${value}` : String(value));

const milliseconds = (ms) => `${ms.toFixed(1)} ms`;

/** 1, 2, 5, 10, ... within a range. */
function roundValues(low, high) {
  const values = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
    for (const digit of [1, 2, 5]) values.push(digit * 10 ** power);
  const inside = values.filter((value) => value >= low * 0.999 && value <= high * 1.001);
  return inside.length > 8 ? inside.filter((value) => /^1/.test(value.toPrecision(1))) : inside;
}
