// Numbers by chance that a seed brings back: mulberry32, public domain, by Tommy Ettinger.
export const seed = Number(process.env.SEED ?? 20260107);

export function randomNumbers(from = seed) {
  let state = from >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}
