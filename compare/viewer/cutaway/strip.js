// The lower part of the drawing of one pixel: the ray's events in order, one column per event or
// run of events. They stay legible where the drawing to scale puts them onto one spot. ECMAScript
// 5, as the command runs it too.
var cutawayStrip = (function () {
  'use strict';

  var clamp = cutawayGeometry.clamp, say = cutawayWords;
  var short = say.short, signed = say.signed, room = say.room;
  var svg = cutawaySvg, colors = svg.colors, tag = svg.tag, line = svg.line, words = svg.words;
  var struck = svg.struck;

  /** Thin lines from the places along the ray to the columns that name them. */
  function leadersDrawn(columns, columnX, place, begin, end, width) {
    return columns.map(function (column) {
      var first = column[0], last = column[column.length - 1];
      return [first].concat(last === first ? [] : [last]).map(function (event) {
        var x = Math.min(place.x(event.depth), width - 8), to = columnX(event.index);
        return line([x, place.ray + 7], [x, begin], 'line', 0.9, { 'stroke-opacity': '0.8' }) +
          line([x, begin], [to, end], 'line', 0.9);
      }).join('');
    }).join('');
  }

  function mark(column, at, counts) {
    var event = column[0], entries = 0, exits = 0, text, half;
    if (event.kind === 'dark caps')
      return words([at[0], at[1] + 4], signed(counts.infinity), 'ink', 13, 'middle',
                   { 'font-weight': '700' }) +
        struck(event.status, at, 9, 9);
    if (event.kind !== 'crossing')
      return tag('rect', { x: at[0] - 1.2, y: at[1] - 10, width: 2.4, height: 20, rx: 1,
                           'class': 'cut-fill-ink', fill: colors.ink });
    column.forEach(function (each) { if (each.crossing.change > 0) ++entries; else ++exits; });
    if (column.length === 1) {
      text = signed(event.crossing.change);
      return tag('circle', { cx: at[0], cy: at[1], r: 12, 'stroke-width': '1.6',
                             'class': 'cut-stroke-shade ' + (entries ? 'cut-fill-shade'
                                                                     : 'cut-fill-paper'),
                             stroke: colors.shade, fill: entries ? colors.shade : colors.paper }) +
        words([at[0], at[1] + 4.5], text, entries ? 'paper' : 'ink', 12.5, 'middle',
              { 'font-weight': '700' }) +
        struck(event.status, at, 13, 13);
    }
    text = [entries ? entries + '\u00d7+1' : '', exits ? exits + '\u00d7\u22121' : '']
      .filter(Boolean);
    half = Math.max(room(text[0], 10), room(text[text.length - 1], 10)) / 2 + 4;
    return tag('rect', { x: at[0] - half, y: at[1] - 14, width: 2 * half, height: 28, rx: 8,
                         'stroke-width': '1.4', 'class': 'cut-stroke-shade cut-fill-paper',
                         stroke: colors.shade, fill: colors.paper }) +
      text.map(function (row, i) {
        return words([at[0], at[1] + (text.length === 1 ? 4 : i === 0 ? -2 : 10)], row, 'ink', 10);
      }).join('') + struck(event.status, at, half, 12);
  }

  /** Steps of the shadow depth between the columns: how many volumes the ray is inside of. */
  function depthSteps(columns, columnCentre, at, width) {
    var text = '';
    columns.forEach(function (column, i) {
      var inside = column[column.length - 1].inside;
      var begin = columnCentre(i);
      var end = i + 1 < columns.length ? columnCentre(i + 1) : width - 8;
      if (end - begin < 6) return;
      text += tag('rect', { x: begin, y: at, width: end - begin, height: 16,
                            'class': inside > 0 ? 'cut-fill-shade' : 'cut-fill-line',
                            fill: inside > 0 ? colors.shade : colors.line,
                            'fill-opacity': String(inside > 0 ? Math.min(0.1 + 0.1 * inside, 0.4)
                                                              : 0.12) }) +
        words([(begin + end) / 2, at + 12], String(inside), 'ink', 11);
    });
    return text;
  }

  /** Brackets under the strip: the outcome of each run of crossings, in words without overlap. */
  function fatesDrawn(columns, columnCentre, at, step, width) {
    var runs = [], text = '', rows = [], lowest = 0;
    columns.forEach(function (column, i) {
      if (!column[0].status) return;
      var last = runs[runs.length - 1];
      if (last && last.status === column[0].status && last.test === column[0].test) last.end = i;
      else runs.push({ status: column[0].status, test: column[0].test, begin: i, end: i });
    });
    runs.forEach(function (run) {
      var begin = columnCentre(run.begin) - step * 0.42, end = columnCentre(run.end) + step * 0.42;
      var good = run.status === 'counted', label = say.fateWords(run.status, run.test);
      var color = good ? 'ink' : run.status === 'beyond' ? 'quiet' : 'bad';
      var half = room(label, 11.5) / 2;
      var middle = clamp((begin + end) / 2, half + 6, width - half - 6), row = 0;
      while (rows[row] !== undefined && middle - half < rows[row] + 8) ++row;
      rows[row] = middle + half;
      lowest = Math.max(lowest, row);
      text += line([begin, at], [end, at], color, good ? 2.4 : 1.6) +
        line([begin, at - 4], [begin, at], color, 1.4) +
        line([end, at - 4], [end, at], color, 1.4) +
        (row > 0 ? line([clamp((begin + end) / 2, middle - half, middle + half), at],
                        [clamp((begin + end) / 2, middle - half, middle + half), at + 4 + 15 * row],
                        color, 0.8) : '') +
        words([middle, at + 15 + 15 * row], label, color, 11.5);
    });
    return { text: text, height: runs.length ? 22 + 15 * lowest : 0 };
  }

  /** Below the side view: { text, bottom }; `bottom` is the least y that is free. */
  function strip(record, columns, columnX, columnCentre, step, place, width) {
    var fan = place.bottom, top = fan + 30, marks = top + 22, steps = marks + 48;
    var text = leadersDrawn(columns, columnX, place, fan, top + 4, width);
    columns.forEach(function (column, i) {
      var at = [columnCentre(i), marks], depth = column[0].depth;
      text += mark(column, at, record.inside) +
        words([at[0], marks + 27], say.columnName(column), 'ink', 10.5) +
        (column[0].kind === 'crossing' ? '' :
          words([at[0], marks + 40], isFinite(depth) ? short(depth) : 'at infinity', 'quiet',
                10.5));
    });
    text += depthSteps(columns, columnCentre, steps, width);
    var fates = fatesDrawn(columns, columnCentre, steps + 28, step, width);
    return { text: text + fates.text, bottom: steps + 28 + fates.height };
  }

  return strip;
}());
