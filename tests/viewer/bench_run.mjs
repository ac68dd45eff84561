// Recorded runs of a benchmark, made by hand: no test of the plot measures anything.

/** The interval that the command states of up to eight samples: the least and the greatest. */
export function timeOf(samples) {
  const sorted = [...samples].sort((a, b) => a - b);
  const n = sorted.length;
  const median = (sorted[(n - 1) >> 1] + sorted[n >> 1]) / 2;
  const [low, high] = [sorted[0], sorted[n - 1]];
  return { median, low, high, interval: n >= 6,
           settled: n >= 6 && low >= 0.95 * median && high <= 1.05 * median, samples };
}

/** A point of 10,000 pixels; `wrong` of them, and two at edges. */
export function pointOf(technique, ms, wrong = 0, more = {}) {
  return { scene: 'ordinary', technique, family: technique === 'truth' ? 'truth' : 'stencil',
           settings: {}, ms: timeOf([1, 1.1, 0.9, 1, 1.05, 0.95].map((factor) => factor * ms)), pixels: 10000,
           causes: { edge: 2, ...(wrong > 0 ? { near_plane: wrong } : {}) }, differing: wrong + 2,
           falsely_lit: wrong, falsely_shadowed: 0,
           command: `shadowproof bench ordinary --technique ${technique}`, ...more };
}

const exponent = { value: 1, low: 1, high: 1 };

/** Points that are right, wrong, near each other and of every group; lines that grow. */
export const recordedRun = () => ({
  schema: 'shadowproof/bench/1', version: '0.1.0',
  gl: { version: '4.5', renderer: 'llvmpipe', subpixel_bits: 8, depth_bits: 24, stencil_bits: 8 },
  embree: '3.13.5', machine: { processor: 'a processor', cores: 2, system: 'Linux' },
  arguments: ['--size', '100x100'], finished: true,
  scenes: [{ name: 'ordinary', file: 'ordinary.gltf', digest: '0123456789abcdef', light: 'light',
             width: 100, height: 100, triangles: 12, finished: true }],
  points: [
    pointOf('truth', 12), pointOf('auto', 5), pointOf('zfail', 6), pointOf('zfail_float', 6.1),
    pointOf('zpass', 3, 700), pointOf('zp_plus', 4), pointOf('invert', 3.1, 690),
    pointOf('zfail_clamp', 3.2, 710), pointOf('zfail_saturate', 3.3, 720),
    pointOf('zfail_truncated', 3.2, 5),
    pointOf('cube_map_six_pass', 7, 30, { family: 'map', ms: timeOf([7, 8, 6]) }),
    pointOf('traced_epsilon', 11, 2, { family: 'traced' }),
    pointOf('bump_one_pass', 20, 1, { pictures: 'pictures/index.html#ordinary/bump_one_pass', stages: { volumes: { median: 2, samples: [2, 2, 2, 2, 2, 2] },
                                                lighting: { median: 18, samples: [18, 20, 16, 18, 20, 16] } },
                                      color: { rmse: 1.5, largest: 9, p999: 7 },
                                      own: { normalise: 'cube-map', bumps: 'normal-map' } }),
    pointOf('bump_one_pass', 25, 1, { settings: { bumps: 'indexed' },
                                      color: { rmse: 1.2, largest: 8, p999: 7 },
                                      own: { normalise: 'cube-map', bumps: 'indexed' } }),
  ],
  left_out: [{ scene: 'ordinary', technique: 'bump_one_pass', settings: { bumps: 'height-field' },
               why: 'there are no heights' }],
  scaling: ['zfail', 'zpass', 'auto'].map((technique, i) => ({
    axis: 'pixels', scene: 'ordinary', technique, command: 'shadowproof bench --scaling',
    points: [1000, 10000, 100000].map((size) =>
      ({ size, ms: timeOf([(1 + 0.02 * i) * size / 1000]) })),
    exponent })).concat([
    { axis: 'pixels', scene: 'ordinary', technique: 'cube_map_six_pass', family: 'map',
      command: 'shadowproof bench --scaling', // flat, and linear from 10,000 on
      points: [100, 1000, 10000, 100000, 1000000].map((size) =>
        ({ size, ms: timeOf([Math.max(5, size / 2000)]) })),
      exponent: { value: 0.5008583333333333, low: -0.04, high: 1.04 },
      break: { size: 10000, below: { value: 0, low: 0, high: 0 }, above: { value: 1, low: 1, high: 1 } } },
    { axis: 'pixels', scene: 'ordinary', technique: 'traced_epsilon', // of an older file: no family
      command: 'shadowproof bench --scaling', points: [1000, 10000].map((size) =>
        ({ size, ms: timeOf([size / 500]) })) }]),
});
