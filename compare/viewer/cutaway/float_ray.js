// The drawing of a float tracer's shadow ray, from its start to the light, with what it met.
// ECMAScript 5 without a DOM, because the command runs these files too.
var cutawayFloatRay = (function () {
  'use strict';

  var svg = cutawaySvg, line = svg.line, tag = svg.tag, words = svg.words;
  var lineHeight = 20;

  /**
   * What lies along the ray, by distance. `ray`: near and far; `leaves`, where it leaves its
   * receiver's plane, or null; `first`, the triangle that it meets if it is traced exactly, and
   * `passed`, one that it should have met, each { triangle, t } or null.
   */
  function marks(ray) {
    var all = [{ t: 0, words: 'start', color: 'ink' }];
    function mark(t, text, color) { all.push({ t: t, words: text, color: color }); }
    if (ray.near > 0) mark(ray.near, 'epsilon: hits count beyond', 'quiet');
    if (ray.leaves !== null) mark(ray.leaves, 'leaves its receiver\u2019s plane', 'shade');
    if (ray.passed) mark(ray.passed.t, 'passes over triangle ' + ray.passed.triangle, 'bad');
    if (ray.first) mark(ray.first.t, 'meets triangle ' + ray.first.triangle, 'bad');
    if (isFinite(ray.far)) mark(ray.far, 'light', 'light');
    return all.sort(function (a, b) { return a.t - b.t; });
  }

  function heightOf(ray) { return 34 + lineHeight * marks(ray).length; }

  /**
   * The ray from left to right, a line of words for each mark. Distances are in logarithms from a
   * half of the smallest, as they range from rounding errors to the size of the scene. `printed`
   * writes a distance.
   */
  function draw(ray, top, width, printed) {
    var all = marks(ray), axis = top + 16, least = 1, most = 1e-9;
    all.forEach(function (mark) { if (mark.t > 0) least = Math.min(least, mark.t); });
    least /= 2;
    function scale(t) { return Math.log(1 + t / least); }
    all.forEach(function (mark) { most = Math.max(most, scale(mark.t)); });
    function x(t) {
      return 14 + (width - 28) * (scale(t) / most) * (isFinite(ray.far) ? 1 : 0.85);
    }
    var text = line([x(0), axis], [width - 6, axis], 'line', 2);
    all.forEach(function (mark, i) {
      var y = top + 40 + lineHeight * i, right = x(mark.t) > width / 2;
      var said = mark.words + ', ' + printed(mark.t), beside = right ? x(mark.t) : width - x(mark.t);
      var fits = cutawayWords.room(said, 12) < beside - 8;
      text += line([x(mark.t), axis], [x(mark.t), y - 4], mark.color, 1) +
        tag('circle', { cx: x(mark.t), cy: axis, r: 4, fill: svg.colors[mark.color],
                        'class': 'cut-fill-' + mark.color }) +
        words([fits ? x(mark.t) + (right ? -5 : 5) : width / 2, y], said, mark.color, 12,
              fits ? (right ? 'end' : 'start') : 'middle');
    });
    return text;
  }

  return { heightOf: heightOf, draw: draw };
}());
