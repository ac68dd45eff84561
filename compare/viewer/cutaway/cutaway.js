// The drawing of one pixel: a side view in the plane of the eye ray and the light, after the
// cutaways of the shadow volume papers, below it the ray's events in order, and their result in
// words. ECMAScript 5 without a DOM, because the command runs these files too.
var cutaway = (function () {
  'use strict';

  var geometry = cutawayGeometry, say = cutawayWords;
  var svg = cutawaySvg, escaped = svg.escaped, px = svg.px, tag = svg.tag, words = svg.words;

  var font = 'system-ui, -apple-system, Segoe UI, DejaVu Sans, sans-serif';

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

    var below = cutawayStrip(record, columns, columnX, columnCentre, step, place, width);
    var evidence = cutawayEvidence.draw(technique, below.bottom, width);
    var text = cutawaySide(record, events, points, plane, place, width) + below.text +
      evidence.text;

    var crossings = record.crossings.length;
    var notes = evidence.notes.concat([say.lightWords(plane, place)]);
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
    var y = evidence.bottom + 22, most = Math.floor((width - 16) / 7.6);
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
                    fill: svg.colors.paper }) + text + '</svg>\n';
  }

  return cutaway;
}());
