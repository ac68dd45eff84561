// The upper part of the drawing of one pixel: the side view, with the eye ray, the surface, the light
// and the shadow volumes that the ray meets. ECMAScript 5, as the command runs it too.
var cutawaySide = (function () {
  'use strict';

  var geometry = cutawayGeometry, clamp = geometry.clamp, room = cutawayWords.room;
  var svg = cutawaySvg, colors = svg.colors, px = svg.px, tag = svg.tag, line = svg.line;
  var words = svg.words, polygon = svg.polygon, struck = svg.struck;

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

  /**
   * The part of a line in the drawing and a little around it, or null: dashes of a line that is
   * millions of pixels long take a browser seconds (Liang and Barsky, "A new concept and method for
   * line clipping", 1984).
   */
  function partInside(a, b, place) {
    var margin = 100, high = [place.right + margin, place.bottom + margin];
    var begin = 0, end = 1; // of the line
    [0, 1].forEach(function (axis) {
      var along = b[axis] - a[axis];
      var ends = [-margin, high[axis]].map(function (side) { return (side - a[axis]) / along; });
      if (along === 0) {
        if (a[axis] < -margin || a[axis] > high[axis]) end = -1;
        return;
      }
      begin = Math.max(begin, Math.min(ends[0], ends[1]));
      end = Math.min(end, Math.max(ends[0], ends[1]));
    });
    function at(t) { return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]; }
    return begin < end ? [begin === 0 ? a : at(begin), end === 1 ? b : at(end)] : null;
  }

  function sidesDrawn(events, points, place) {
    var many = events.length > 18, text = '';
    events.forEach(function (event, k) {
      if (event.kind !== 'crossing' || !points[k].side) return;
      var p = points[k], faint = !event.status || event.status === 'counted' ? '0.95' : '0.55';
      if (many) faint = '0.35';
      var toCaster = partInside(place.light, p.caster, place);
      if (toCaster)
        text += line(toCaster[0], toCaster[1], 'light', 1,
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

  function rayDrawn(record, events, place, width) {
    var eye = [place.x(events[0].depth), place.ray], end = width - 8;
    var stop = record.seen ? place.x(record.seen.depth) : end;
    return line(eye, [stop, place.ray], 'ink', 1.8) +
      line([stop, place.ray], [end, place.ray], 'ink', 1.2, { 'stroke-dasharray': '1 3' }) +
      tag('path', { d: 'M' + px(end) + ' ' + px(place.ray) + 'l-7 -3.5v7z',
                    'class': 'cut-fill-ink', fill: colors.ink });
  }

  /** Labels of what is drawn, each where it hides no other. */
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
    put([place.x(events[0].depth) - 12, place.ray + 24], 'eye', 12, 'ink');
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

  /** `points`: geometry.crossingPoints of each event, with `side` where it is the side of a volume. */
  function sideView(record, events, points, plane, place, width) {
    var panel = (plane.degenerate ? '' : shadowsDrawn(events, points, place) +
                                         sidesDrawn(events, points, place)) +
      planesDrawn(events, place, width) + capsDrawn(record, events, plane, place) +
      bandDrawn(events, place) + rayDrawn(record, events, place, width) +
      surfaceDrawn(record, plane, place) + dotsDrawn(events, place);
    return tag('svg', { x: 0, y: 0, width: width, height: place.bottom }, panel) +
      eyeDrawn([place.x(events[0].depth), place.ray]) + lightDrawn(record, place, width) +
      labelsDrawn(record, events, points, place, width) +
      words([width - 8, 13], cutawayWords.scaleWords(place), 'quiet', 11.5, 'end');
  }

  return sideView;
}());
