// The drawing of one pixel: a side view in the plane of the eye ray and the light, after the
// cutaways of the shadow volume papers, and below it the ray's events in order, which stay legible
// where the picture to scale puts them onto one spot. ECMAScript 5 without a DOM, because the
// command runs these very files too. Colours are attributes, so that the picture stands alone; the
// report's style sheet overrides them by class.
var cutaway = (function () {
  'use strict';

  var geometry = cutawayGeometry, say = cutawayWords;
  var clamp = geometry.clamp, short = say.short, signed = say.signed, room = say.room;

  var font = 'system-ui, -apple-system, Segoe UI, DejaVu Sans, sans-serif';
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

  /** The volumes between an entry and its exit, darker where they overlap. */
  function shadowsDrawn(events, points, place) {
    var open = [], text = '', i;
    var start = geometry.crossingPoints(place, { light: [0, 1] }, null, 0);
    function wedge(a, b) {
      var outline = [a.on, b.on, b.away, a.away];
      if (a.side && b.side) outline = [a.caster, b.caster].concat([b.on, b.away, a.away, a.on]);
      text += polygon(outline, 'shade', 0.13);
    }
    for (i = 0; i < events[0].inside; ++i) open.push(start);
    events.forEach(function (event, k) {
      if (event.kind !== 'crossing') return;
      if (event.crossing.change > 0) open.push(points[k]);
      else if (open.length > 0) wedge(open.pop(), points[k]);
    });
    var end = geometry.crossingPoints(place, { light: [0, 1] }, null, 0);
    end.on = [place.right, place.ray];
    end.away = [place.right + (place.bottom - place.ray) / Math.max(place.ray - place.light[1], 1) *
                (place.right - place.light[0]), place.bottom];
    open.forEach(function (begin) { wedge(begin, end); });
    return text;
  }

  function sidesDrawn(events, points, place) {
    var many = events.length > 18, text = '';
    events.forEach(function (event, k) {
      if (event.kind !== 'crossing' || !points[k].side) return;
      var p = points[k], faint = event.status === 'counted' ? '0.95' : '0.55';
      if (many) faint = '0.35';
      text += line(place.light, p.caster, 'light', 1,
                   { 'stroke-dasharray': '2 4', 'stroke-opacity': many ? '0.3' : '0.75' });
      text += line(p.caster, p.away, 'shade', 1.3, { 'stroke-opacity': faint });
      text += tag('circle', { cx: p.caster[0], cy: p.caster[1], r: 2.4,
                              'class': 'cut-fill-ink', fill: colors.ink });
    });
    return text;
  }

  function capsDrawn(record, events, plane, place) {
    return events.map(function (event) {
      if (event.kind !== 'crossing' || event.crossing.kind !== 'light cap') return '';
      var ends = geometry.strokeOf(record, plane, place, event.crossing.from, event.depth, 9);
      return line(ends[0], ends[1], 'ink', 1.6, { 'stroke-opacity': '0.6' });
    }).join('');
  }

  function bandDrawn(events, place) {
    var text = '';
    events.forEach(function (event, k) {
      var begin = place.x(event.depth);
      var end = k + 1 < events.length ? place.x(events[k + 1].depth) : place.right;
      if (event.inside > 0 && Math.min(end, place.right) > begin)
        text += tag('rect', { x: begin, y: place.ray - 5,
                              width: Math.min(end, place.right) - begin, height: 10,
                              'class': 'cut-fill-shade', fill: colors.shade,
                              'fill-opacity': String(Math.min(0.2 + 0.2 * event.inside, 0.9)) });
    });
    return text;
  }

  /** What was lost is struck through in another colour than what nobody asked for. */
  function struck(status, at, x, y) {
    if (status === 'counted') return '';
    return line([at[0] - x, at[1] + y], [at[0] + x, at[1] - y],
                status === 'beyond' ? 'quiet' : 'bad', 1.8);
  }

  function dotsDrawn(events, place) {
    return events.map(function (event) {
      if (event.kind !== 'crossing') return '';
      var at = [place.x(event.depth), place.ray], enters = event.crossing.change > 0;
      return tag('circle', { cx: at[0], cy: at[1], r: 3.6, 'stroke-width': '1.6',
                             'class': 'cut-stroke-shade ' + (enters ? 'cut-fill-shade'
                                                                    : 'cut-fill-paper'),
                             stroke: colors.shade, fill: enters ? colors.shade : colors.paper }) +
        struck(event.status, at, 5, 5);
    }).join('');
  }

  function eyeDrawn(at) {
    var x = at[0] - 12, y = at[1];
    return tag('path', {
      d: 'M' + px(x - 11) + ' ' + px(y) + 'Q' + px(x) + ' ' + px(y - 13) + ' ' + px(x + 11) + ' ' +
         px(y) + 'Q' + px(x) + ' ' + px(y + 13) + ' ' + px(x - 11) + ' ' + px(y) + 'Z',
      'class': 'cut-stroke-ink cut-fill-paper', stroke: colors.ink, fill: colors.paper,
      'stroke-width': '1.6' }) +
      tag('circle', { cx: x + 3, cy: y, r: 3.6, 'class': 'cut-fill-ink', fill: colors.ink });
  }

  /** A directional light: where its rays go. */
  function arrowDrawn(arrow, label) {
    var tail = arrow[0], tip = arrow[1];
    var x = (tip[0] - tail[0]) / 26, y = (tip[1] - tail[1]) / 26; // of length 1
    return line(tail, [tip[0] - 5 * x, tip[1] - 5 * y], 'light', 2.2) +
      tag('polygon', {
        points: [tip, [tip[0] - 9 * x - 5 * y, tip[1] - 9 * y + 5 * x],
                 [tip[0] - 9 * x + 5 * y, tip[1] - 9 * y - 5 * x]]
          .map(function (p) { return px(p[0]) + ',' + px(p[1]); }).join(' '),
        'class': 'cut-fill-light', fill: colors.light }) +
      words([44, 34], label, 'light', 12, 'start');
  }

  function lightDrawn(record, place, width) {
    var at = place.light, name = record.light.name || 'light', text = '', k, angle;
    var label = /light/i.test(name) ? name : 'light ' + name;
    if (place.arrow) return arrowDrawn(place.arrow, label);
    if (!place.lightIn) return '';
    for (k = 0; k < 8; ++k) {
      angle = k * Math.PI / 4;
      text += line([at[0] + 8 * Math.cos(angle), at[1] + 8 * Math.sin(angle)],
                   [at[0] + 12 * Math.cos(angle), at[1] + 12 * Math.sin(angle)], 'light', 1.6);
    }
    text += tag('circle', { cx: at[0], cy: at[1], r: 5.5, 'class': 'cut-fill-light',
                            fill: colors.light });
    var onLeft = at[0] + 18 + room(label, 12) > width;
    return text + words([at[0] + (onLeft ? -18 : 18), at[1] + 4], label, 'light', 12,
                        onLeft ? 'end' : 'start');
  }

  function planesDrawn(events, place, width) {
    return events.map(function (event) {
      if (event.kind !== 'near' && event.kind !== 'far') return '';
      var x = Math.min(place.x(event.depth), width - 12);
      var outside = place.x(event.depth) > place.right + 1;
      if (outside) // an axis break
        return [0, 4].map(function (shift) {
          return line([width - 26 + shift, place.ray + 6], [width - 20 + shift, place.ray - 6],
                      'quiet', 1.3);
        }).join('');
      return line([x, place.ray - 34], [x, place.bottom], 'quiet', 1.2,
                  { 'stroke-dasharray': '7 3' });
    }).join('');
  }

  function surfaceDrawn(record, plane, place) {
    if (!record.seen) return '';
    var ends = geometry.strokeOf(record, plane, place, record.seen.corners, record.seen.depth, 15);
    return line(ends[0], ends[1], 'ink', 3.6, { 'stroke-linecap': 'round' });
  }

  function rayDrawn(record, place, width) {
    var eye = [place.x(0), place.ray], end = width - 8;
    var stop = record.seen ? place.x(record.seen.depth) : end;
    return line(eye, [stop, place.ray], 'ink', 1.8) +
      line([stop, place.ray], [end, place.ray], 'ink', 1.2, { 'stroke-dasharray': '1 3' }) +
      tag('path', { d: 'M' + px(end) + ' ' + px(place.ray) + 'l-7 -3.5v7z',
                    'class': 'cut-fill-ink', fill: colors.ink });
  }

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

  function mark(column, technique, at, counts) {
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

  /** Brackets under the strip: the fate of each run of crossings, in words that never overlap. */
  function fatesDrawn(columns, columnCentre, technique, at, step, width) {
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

  /** Names of what stands in the geometry, each where it hides no other. */
  function labelsDrawn(record, events, points, place, width) {
    var taken = [], text = '';
    if (place.lightIn) taken.push([place.light[0] - 100, place.light[1] - 14,
                                   place.light[0] + 100, place.light[1] + 14]);
    if (place.arrow) taken.push([0, 0, 54 + room(record.light.name || 'light', 12) + 40, 38]);
    taken.push([width - 300, 0, width, 18]);
    points.forEach(function (p) {
      if (p.side) taken.push([p.caster[0] - 3, p.caster[1] - 3, p.caster[0] + 3, p.caster[1] + 3]);
    });
    function put(at, label, size, color) {
      var half = room(label, size) / 2;
      var tries = [[0, 0], [0, -14], [0, 14], [half, -6], [-half, -6]];
      var box, k, free;
      for (k = 0; k < tries.length; ++k) {
        var x = clamp(at[0] + tries[k][0], half + 2, width - half - 2), y = at[1] + tries[k][1];
        box = [x - half - 3, y - size, x + half + 3, y + 4];
        free = taken.every(function (other) {
          return box[2] < other[0] || box[0] > other[2] || box[3] < other[1] || box[1] > other[3];
        });
        if (free && y > 16) {
          taken.push(box);
          text += words([x, y], label, color, size);
          return;
        }
      }
    }
    put([place.x(0) - 12, place.ray + 24], 'eye', 12, 'ink');
    put([place.x(record.near), place.ray - 40], 'near plane', 11.5, 'quiet');
    if (place.x(record.far) <= place.right) put([place.x(record.far), place.ray - 40], 'far plane',
                                                11.5, 'quiet');
    if (record.seen) put([place.x(record.seen.depth), place.ray - 24],
                         record.seen.mesh || 'surface', 12, 'ink');
    var said = {};
    events.forEach(function (event, k) {
      if (event.kind !== 'crossing' || !points[k].side || !event.crossing.caster) return;
      var name = event.crossing.caster.mesh;
      if (!name || said[name]) return;
      said[name] = true;
      put([points[k].caster[0], points[k].caster[1] - 8], name, 11.5, 'ink');
    });
    return text;
  }

  /** An SVG text of record.techniques[k]; `width` in pixels, 760 where it is not given. */
  function cutaway(record, k, width) {
    var technique = record.techniques[k];
    width = Math.max(320, width || 760);
    var plane = geometry.planeOf(record), events = geometry.eventsOf(record, technique);
    events.forEach(function (event, i) { event.index = i; });
    var columns = geometry.columnsOf(events, (width - 16) / 42);
    var step = (width - 16) / geometry.breadthOf(columns);
    var centres = [], spot = [], before = 8;
    columns.forEach(function (column) {
      var half = geometry.breadth(column) * step / 2;
      centres.push(before + half);
      column.forEach(function (event, j) {
        spot[event.index] = before + half +
          (column.length > 1 ? (j / (column.length - 1) - 0.5) * half * 1.4 : 0);
      });
      before += 2 * half;
    });
    function columnX(i) { return spot[i]; }
    function columnCentre(i) { return centres[i]; }

    var casters = events.map(function (event) {
      if (event.kind !== 'crossing' || event.crossing.kind !== 'side' || plane.degenerate ||
          !event.crossing.from) return null;
      return geometry.cutPoint(plane, record.eye, event.crossing.from[0], event.crossing.from[1]);
    });
    var place = geometry.layout(record, plane, events, casters, width, columnX);
    var points = events.map(function (event, i) {
      var p = geometry.crossingPoints(place, plane, casters[i], event.depth);
      p.side = casters[i] !== null;
      return p;
    });

    var crossings = record.crossings.length;
    var panel = (plane.degenerate ? '' : shadowsDrawn(events, points, place) +
                                         sidesDrawn(events, points, place)) +
      planesDrawn(events, place, width) + capsDrawn(record, events, plane, place) +
      bandDrawn(events, place) + rayDrawn(record, place, width) +
      surfaceDrawn(record, plane, place) + dotsDrawn(events, place);
    var fan = place.bottom, strip = fan + 30, marks = strip + 22;
    var text = tag('svg', { x: 0, y: 0, width: width, height: place.bottom }, panel) +
      eyeDrawn([place.x(0), place.ray]) + lightDrawn(record, place, width) +
      labelsDrawn(record, events, points, place, width) +
      words([width - 8, 13], say.scaleWords(place), 'quiet', 11.5, 'end') +
      leadersDrawn(columns, columnX, place, fan, strip + 4, width);

    columns.forEach(function (column, i) {
      var at = [columnCentre(i), marks], depth = column[0].depth;
      text += mark(column, technique, at, record.inside) +
        words([at[0], marks + 27], say.columnName(column), 'ink', 10.5) +
        (column[0].kind === 'crossing' ? '' :
          words([at[0], marks + 40], isFinite(depth) ? short(depth) : 'at infinity', 'quiet',
                10.5));
    });
    var steps = marks + 48;
    text += depthSteps(columns, columnCentre, steps, width);
    var fates = fatesDrawn(columns, columnCentre, technique, steps + 28, step, width);
    text += fates.text;

    var notes = [say.lightWords(plane, place)];
    var tests = technique.tests || [technique.test];
    var behind = tests.indexOf('depth_fail') >= 0;
    if (behind && tests.indexOf('depth_pass') >= 0)
      notes.push('Some casters are counted in front of the surface, others behind it.');
    else if (behind && crossings > 0)
      notes.push('Counted behind the surface, where an exit adds one and an entry takes one.');
    if (technique.test === 'depth_pass' && record.inside.eye !== 0)
      notes.push('The eye itself is inside ' + record.inside.eye +
                 (record.inside.eye === 1 ? ' volume' : ' volumes') +
                 ', whose entry lies behind it and is not counted.');
    if (crossings === 0) notes.push('No side or cap of a shadow volume meets this ray.');
    if (!record.seen) notes.push('The ray meets no surface: background.');
    if (!record.adds_up)
      notes.push('Rounding lost a crossing: those drawn do not add up to the exact counts.');
    var y = steps + 28 + fates.height + 22, most = Math.floor((width - 16) / 7.6);
    var sentence = say.sentenceOf(record, technique);
    say.wrapped(sentence, most).forEach(function (row) {
      text += words([8, y], row, 'ink', 13, 'start', { 'font-weight': '600' });
      y += 18;
    });
    notes.filter(Boolean).forEach(function (note) {
      say.wrapped(note, Math.floor(most * 1.08)).forEach(function (row) {
        text += words([8, y], row, 'quiet', 12, 'start');
        y += 16;
      });
    });
    var height = y - 2;
    var title = 'Pixel (' + record.x + ', ' + record.y + ') of ' + record.scene + ', ' +
      technique.name;
    var description = 'Side view along the eye ray, ' + say.scaleWords(place) + '. ' + crossings +
      (crossings === 1 ? ' crossing' : ' crossings') + ' of shadow volumes. ' + sentence;
    return '<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="0 0 ' + px(width) + ' ' +
      px(height) + '" width="' + px(width) + '" height="' + px(height) + '" font-family="' + font +
      '" class="cutaway">' + tag('title', {}, escaped(title)) +
      tag('desc', {}, escaped(description)) +
      tag('rect', { x: 0, y: 0, width: width, height: height, 'class': 'cut-fill-paper',
                    fill: colors.paper }) + text + '</svg>\n';
  }

  return cutaway;
}());
