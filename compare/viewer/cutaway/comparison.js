// The drawing of a comparison with a texel of a shadow map, along the ray from the light: what the
// texel stores, the same with the bias, and the pixel's own point. ECMAScript 5 without a DOM,
// because the command runs these files too.
var cutawayComparison = (function () {
  'use strict';

  var svg = cutawaySvg, line = svg.line, tag = svg.tag, words = svg.words;
  var height = 100;

  /** As many digits as a float has without its last. */
  function short(length) {
    return isNumber(length) ? String(Number(length.toPrecision(6))) : 'no number';
  }
  /** JSON has no NaN, and null in its place. */
  function isNumber(length) { return typeof length === 'number' && isFinite(length); }

  /** How far along the ray a texel's footprint reaches, for each unit that it reaches across it. */
  function steepness(record) {
    var most = Math.max(record.foot[0], record.foot[1]) / record.width;
    return Math.sqrt(Math.max(most * most - 1, 0));
  }

  /**
   * The light on the left, far off; what the texel stores, the same with the bias, and the pixel's
   * point, as close as they are. The texel's own rays cut its footprint out of the surface, which
   * is as steep as the surface is to them. `record`: lengths stored, bias, own, width and foot (of
   * the footprint's two sides).
   */
  function draw(record, top, width) {
    var axis = top + 50, half = 20;
    if (!isNumber(record.stored) || !isNumber(record.own))
      return words([8, axis], 'What the texel stores is no number.', 'bad', 12, 'start');
    var least = Math.min(record.stored, record.stored + record.bias, record.own);
    var most = Math.max(record.stored, record.stored + record.bias, record.own);
    var room = Math.max(most - least, 1e-6 * most, 1e-30);
    function place(length) { return 160 + (width - 250) * (length - least) / room; }
    var own = place(record.own), stored = place(record.stored);
    var biased = place(record.stored + record.bias);
    var texel = 'texel ' + short(record.stored), point = 'own point ' + short(record.own);
    function within(x, text) {
      var half = cutawayWords.room(text, 12) / 2 + 4;
      return Math.max(half, Math.min(x, width - half));
    }
    var lean = Math.min(half * steepness(record), 55);
    return line([40, axis], [own - lean, axis - half], 'quiet', 1) +
      line([40, axis], [own + lean, axis + half], 'quiet', 1) +
      line([40, axis], [120, axis], 'line', 2, { 'stroke-dasharray': '2 6' }) +
      line([120, axis], [width - 20, axis], 'line', 2) +
      line([stored, axis], [biased, axis], 'light', 8, { 'stroke-opacity': '0.6' }) +
      line([own - lean, axis - half], [own + lean, axis + half], 'shade', 4) +
      tag('circle', { cx: 40, cy: axis, r: 6, fill: svg.colors.light, 'class': 'cut-fill-light' }) +
      words([40, axis + 22], 'light', 'quiet', 12) +
      line([stored, axis - 26], [stored, axis], 'ink', 2) +
      words([within(stored, texel), axis - 32], texel, 'ink', 12) +
      line([own, axis], [own, axis + 26], 'ink', 2, { 'stroke-dasharray': '4 3' }) +
      words([within(own, point), axis + 42], point, 'ink', 12);
  }

  /** The step of a ramp of 256 in which a depth lies. */
  function stepOfRamp(record, depth) {
    var place = Math.floor(256 * (depth - record.near) / (record.far - record.near));
    return Math.max(0, Math.min(255, place));
  }

  /** The comparison as the technique makes it: of steps where the map is a ramp. */
  function sentence(record) {
    var ramp = record.format === 'ramp8';
    var stored = ramp ? stepOfRamp(record, record.stored) : record.stored + record.bias;
    var own = ramp ? stepOfRamp(record, record.own - record.bias) : record.own;
    var left = ramp ? 'Step ' + stored + ' of the ramp'
                    : short(record.stored) + ' + ' + short(record.bias);
    var right = ramp ? 'step ' + own + ', in which ' + short(record.own) + ' \u2212 ' +
                       short(record.bias) + ' lies' : short(record.own);
    return left + ' is ' + (stored < own ? 'less than ' + right + ': shadowed.'
                                         : 'not less than ' + right + ': lit.');
  }

  /** What the block of texels around the point's own one says; empty where there is none. */
  function averaged(record) {
    if (!record.filter) return '';
    var beyond = { clamped: ', repeating the border of its face',
                   seamless: ', across the edges of its face' }[record.edges] || '';
    var block = 'Of its own texel. The claim averages ' + record.filter + ' \u00d7 ' + record.filter +
      ' texels' + beyond;
    return record.average === 'values'
      ? block + ': their values, which are compared once.'
      : block + ': ' + record.lit + ' of ' + record.filter * record.filter +
        ' comparisons find light.';
  }

  return { height: height, short: short, draw: draw, sentence: sentence, averaged: averaged };
}());
