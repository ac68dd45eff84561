// The shapes that the drawing of one pixel is made of, as SVG text. Colours are attributes, so that
// the picture stands alone; the report's style sheet overrides them by class. ECMAScript 5, as the
// command runs it too.
var cutawaySvg = (function () {
  'use strict';

  var colors = { paper: '#ffffff', ink: '#1b1b1f', quiet: '#55555e', line: '#b4b4be',
                 shade: '#3d5a96', light: '#b86e00', bad: '#a33c00' };

  function escaped(text) {
    return String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;')
      .replace(/"/g, '&quot;');
  }
  function px(value) { return String(Math.round(value * 10) / 10); }

  function tag(name, attributes, content) {
    var text = '<' + name, key, value;
    for (key in attributes) {
      value = attributes[key];
      if (value === null || value === undefined) continue;
      text += ' ' + key + '="' + escaped(typeof value === 'number' ? px(value) : value) + '"';
    }
    return text + (content === undefined ? '/>' : '>' + content + '</' + name + '>');
  }
  function line(a, b, color, width, extra) {
    var attributes = { x1: a[0], y1: a[1], x2: b[0], y2: b[1], 'class': 'cut-stroke-' + color,
                       stroke: colors[color], 'stroke-width': String(width) }, key;
    for (key in extra || {}) attributes[key] = extra[key];
    return tag('line', attributes);
  }
  function words(at, text, color, size, anchor, extra) {
    var attributes = { x: at[0], y: at[1], 'class': 'cut-fill-' + color, fill: colors[color],
                       'font-size': String(size), 'text-anchor': anchor || 'middle' }, key;
    for (key in extra || {}) attributes[key] = extra[key];
    return tag('text', attributes, escaped(text));
  }
  function polygon(points, color, opacity) {
    return tag('polygon', {
      points: points.map(function (p) { return px(p[0]) + ',' + px(p[1]); }).join(' '),
      'class': 'cut-fill-' + color, fill: colors[color], 'fill-opacity': String(opacity) });
  }

  /**
   * Lost crossings and those that do not count are struck through in different colours. A technique that
   * counts no volumes has no status of them.
   */
  function struck(status, at, x, y) {
    if (!status || status === 'counted') return '';
    return line([at[0] - x, at[1] + y], [at[0] + x, at[1] - y],
                status === 'beyond' ? 'quiet' : 'bad', 1.8);
  }

  return { colors: colors, escaped: escaped, px: px, tag: tag, line: line, words: words,
           polygon: polygon, struck: struck };
}());
