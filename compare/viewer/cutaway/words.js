// The words of the drawing of one pixel. ECMAScript 5, as the command runs it too.
var cutawayWords = (function () {
  'use strict';

  function short(value) {
    var size = Math.abs(value);
    return size !== 0 && (size < 1e-3 || size >= 1e5)
      ? value.toExponential(2).replace(/\.?0*e\+?/, 'e') : String(parseFloat(value.toPrecision(4)));
  }
  function signed(value) { return value > 0 ? '+' + value : value < 0 ? '\u2212' + -value : '0'; }
  /** Room that a text takes in the widest of the fonts. */
  function room(text, size) { return 0.6 * size * text.length; }

  /** How a technique counts a crossing: behind the surface an exit adds and an entry subtracts. */
  function contribution(technique, crossing, i) {
    return testOf(technique, i) === 'depth_fail' ? -crossing.change : crossing.change;
  }

  /** Which crossings count: technique.tests says so if casters are not counted alike. */
  function testOf(technique, i) { return technique.tests ? technique.tests[i] : technique.test; }

  function fateWords(status, test) {
    if (status === 'beyond')
      return test === 'depth_pass' ? 'behind the surface: not asked for'
                                   : 'in front of the surface: not asked for';
    return { counted: 'counted', lost_near: 'lost: in front of the near plane',
             lost_far: 'lost: clipped at the far plane',
             lost_cap: 'lost: the cap is missing' }[status] || String(status);
  }

  /** "counted +1 -1 = 0; read back 0: claims lit". */
  function sentenceOf(record, technique) {
    if (!technique.statuses)
      return 'Counts no volumes; claims ' + technique.claim + '. The truth is ' + record.truth + '.';
    var terms = [], sum = technique.start || 0, up = 0, down = 0;
    record.crossings.forEach(function (crossing, i) {
      if (technique.statuses[i] !== 'counted') return;
      var value = contribution(technique, crossing, i);
      terms.push(signed(value));
      sum += value;
      if (value > 0) ++up; else ++down;
    });
    if (terms.length > 10) terms = [up + ' times +1, ' + down + ' times \u22121'];
    if (technique.test === 'depth_fail' && technique.dark_cap === 'counted' &&
        technique.dark_caps !== 0) {
      terms.push('dark caps ' + signed(technique.dark_caps));
      sum += technique.dark_caps;
    }
    if (technique.start) terms.unshift('from ' + technique.start + ':');
    var text = terms.length === 0 ? 'Counted nothing: 0' :
      'Counted ' + terms.join(' ') + (terms.length > 1 || sum > 1 || sum < -1 || up + down > 1
        ? ' = ' + signed(sum) : '');
    if (sum !== technique.predicted)
      text += technique.operation === 'saturate'
        ? '; step by step, never below 0 nor above 255, it is ' + signed(technique.predicted)
        : '; the exact count is ' + signed(technique.predicted);
    if (technique.operation === 'invert')
      text += ', which is ' + (technique.predicted % 2 ? 'odd' : 'even');
    if (technique.stored !== technique.predicted) text += ', stored as ' + technique.stored;
    text += '; read back ' + technique.read_back +
      (technique.read_back === technique.stored ? '' : ', not ' + technique.stored) +
      ': claims ' + technique.claim + '. The truth is ' + record.truth + '.';
    return text;
  }

  /** Where the light is, in words, when the drawing cannot hold it. */
  function lightWords(plane, place) {
    if (plane.degenerate)
      return 'The light lies on the line of the ray: the sides of the volumes run along it.';
    if (plane.directional)
      return 'The light is directional: its rays run along the arrow from infinitely far away.';
    if (place.lightIn) return null;
    return 'The light is outside the drawing, ' + short(Math.abs(plane.light[0])) +
      (plane.light[0] < 0 ? ' behind the eye' : ' along the ray') + ' and ' +
      short(plane.light[1]) + ' beside it.';
  }

  function columnName(column) {
    if (column[0].kind !== 'crossing') return column[0].kind;
    return short(column[0].depth) + (column.length > 1 ? '\u2026' : '');
  }

  /** How many letters a text is as wide as: signs are wider. */
  function letters(text) { return text.length + 0.4 * (text.match(/[+\u2212=]/g) || []).length; }

  /** Lines that are at most `most` letters wide. */
  function wrapped(text, most) {
    var lines = [''];
    text.split(' ').forEach(function (word) {
      var last = lines[lines.length - 1];
      if (last && letters(last) + letters(word) + 1 > most) lines.push(word);
      else lines[lines.length - 1] = last ? last + ' ' + word : word;
    });
    return lines;
  }

  function scaleWords(place) {
    if (place.ordinal) return 'not to scale: depths in their order only';
    if (Math.abs(place.scale - 1) < 0.01) return 'to scale';
    return 'not to scale: heights \u00d7 ' + short(place.scale);
  }

  return { short: short, signed: signed, room: room, fateWords: fateWords, sentenceOf: sentenceOf,
           lightWords: lightWords, columnName: columnName, wrapped: wrapped,
           scaleWords: scaleWords };
}());
