// What a technique that counts no volumes asked instead, drawn below the side view: a texel of its
// map, or a float tracer's shadow ray. ECMAScript 5 without a DOM, as the command runs it.
var cutawayEvidence = (function () {
  'use strict';

  var comparison = cutawayComparison, floatRay = cutawayFloatRay, short = comparison.short;

  function ofMap(map, top, width) {
    var foot = map.footprint.map(function (side) { return side === null ? Infinity : side; });
    var record = { stored: map.stored, bias: map.bias, own: map.own, width: map.width, foot: foot,
                   format: map.format, near: map.near, far: map.far, filter: map.filter,
                   average: map.average, edges: map.edges, lit: map.lit };
    return { text: comparison.draw(record, top, width), bottom: top + comparison.height,
             notes: [comparison.sentence(record), comparison.averaged(record),
                     'Texel (' + map.texel.join(', ') + ') of face ' + map.face + ', ' + map.size +
                     ' a side; it shows ' +
                     (map.shows === null ? 'nothing.' : 'triangle ' + map.shows + '.')] };
  }

  function ofRay(technique, top, width) {
    var shot = technique.shadow_ray, first = shot.hits[0] || null;
    var ray = { near: shot.near, far: shot.far === null ? Infinity : shot.far,
                leaves: shot.leaves_plane_at, first: first, passed: shot.passed_over };
    return { text: floatRay.draw(ray, top, width, short), bottom: top + floatRay.heightOf(ray),
             notes: ['The shadow ray as the float tracer shot it, distances in logarithms. Embree: ' +
                     (shot.stopped_by === null ? 'nothing in the way'
                                               : 'stopped by triangle ' + shot.stopped_by) +
                     '; traced exactly, it meets ' +
                     (first ? 'triangle ' + first.triangle + ' first.' : 'nothing.')] };
  }

  /** { text, bottom, notes }: `bottom` is `top` where there is nothing to draw. */
  function draw(technique, top, width) {
    if (technique.map) return ofMap(technique.map, top + 8, width);
    if (technique.shadow_ray) return ofRay(technique, top + 8, width);
    return { text: '', bottom: top,
             notes: [technique.map === null ? 'The map is not asked at this pixel.' : ''] };
  }

  return { draw: draw };
}());
