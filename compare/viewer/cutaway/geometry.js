// The geometry of the drawing of one pixel: the plane through eye ray and light, what lies along
// the ray in order, and where all of it is drawn. ECMAScript 5, as the command runs it.
var cutawayGeometry = (function () {
  'use strict';

  function clamp(value, low, high) { return Math.max(low, Math.min(high, value)); }

  function minus(a, b) { return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]; }
  function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  function cross(a, b) {
    return [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]];
  }

  /** A vector from the eye to the light; a directional one is drawn far beyond all depths. */
  function towardsLight(record) {
    if (record.light.kind !== 'directional') return minus(record.light.position, record.eye);
    var d = record.light.direction, length = Math.sqrt(dot(d, d)), farthest = record.near;
    record.crossings.forEach(function (crossing) {
      if (isFinite(crossing.depth)) farthest = Math.max(farthest, crossing.depth);
    });
    if (record.seen) farthest = Math.max(farthest, record.seen.depth);
    var rayLength = Math.sqrt(dot(record.direction, record.direction));
    return d.map(function (value) { return -1e4 * farthest * rayLength / length * value; });
  }

  /**
   * The plane of the drawing: `at(point)` is [depth, height towards the light in units of depth],
   * `normal` is its normal. With a light on the ray's line there is no plane: `degenerate`.
   */
  function planeOf(record) {
    var d = record.direction, length = Math.sqrt(dot(d, d));
    var toLight = towardsLight(record);
    var along = dot(toLight, d) / dot(d, d);
    var up = [0, 1, 2].map(function (i) { return toLight[i] - along * d[i]; });
    var height = Math.sqrt(dot(up, up));
    var degenerate = !(height > 1e-6 * Math.sqrt(dot(toLight, toLight)));
    if (!degenerate) up = up.map(function (value) { return value / height; });
    return {
      degenerate: degenerate,
      directional: record.light.kind === 'directional',
      light: [along, height / length],
      normal: cross(d, up),
      at: function (point) {
        var relative = minus(point, record.eye);
        return [dot(relative, d) / dot(d, d), dot(relative, up) / length];
      }
    };
  }

  /** Where segment p q meets the plane of the drawing; if it just misses it, the nearer end. */
  function cutPoint(plane, eye, p, q) {
    var side = dot(plane.normal, minus(p, eye)), other = dot(plane.normal, minus(q, eye));
    var along = side === other ? 0.5 : clamp(side / (side - other), 0, 1);
    return plane.at([0, 1, 2].map(function (i) { return p[i] + along * (q[i] - p[i]); }));
  }

  /** The stretch of a triangle in the plane of the drawing, or null. */
  function cutTriangle(plane, eye, corners) {
    var ends = [], k, p, q;
    for (k = 0; k < 3; ++k) {
      p = corners[k];
      q = corners[(k + 1) % 3];
      if ((dot(plane.normal, minus(p, eye)) > 0) !== (dot(plane.normal, minus(q, eye)) > 0))
        ends.push(cutPoint(plane, eye, p, q));
    }
    return ends.length === 2 ? ends : null;
  }

  /** What lies along the ray, by depth; of equal depths the surface stands before a crossing. */
  function eventsOf(record, technique) {
    var events = record.crossings.map(function (crossing, i) {
      return { kind: 'crossing', depth: crossing.depth, rank: 2, crossing: crossing,
               status: technique.statuses && technique.statuses[i],
               test: technique.tests ? technique.tests[i] : technique.test };
    });
    events.push({ kind: 'near', depth: record.near, rank: 0 });
    if (record.seen) events.push({ kind: 'surface', depth: record.seen.depth, rank: 1 });
    if (record.far !== null && isFinite(record.far))
      events.push({ kind: 'far', depth: record.far, rank: 3 });
    events = events.map(function (event, i) { event.order = i; return event; })
      .sort(function (a, b) { return a.depth - b.depth || a.rank - b.rank || a.order - b.order; });
    // An orthographic camera's rays come from infinity.
    events.unshift({ kind: 'eye', depth: record.orthographic ? -Infinity : 0 });
    if (technique.test === 'depth_fail' && technique.dark_caps !== 0)
      events.push({ kind: 'dark caps', depth: Infinity, status: technique.dark_cap,
                    test: technique.test });
    var inside = record.inside.eye;
    events.forEach(function (event) {
      if (event.kind === 'crossing') inside += event.crossing.change;
      event.inside = inside; // after it
    });
    return events;
  }

  /** Room of a column of the strip, in columns of one event. */
  function breadth(column) { return column.length > 1 ? 1.4 : 1; }
  function breadthOf(columns) {
    return columns.reduce(function (sum, column) { return sum + breadth(column); }, 0);
  }

  /** The longest run of columns of crossings with one outcome: [begin, end), or null. */
  function longestRun(columns) {
    var best = null, begin = 0, end;
    while (begin < columns.length) {
      end = begin + 1;
      while (end < columns.length && columns[begin][0].kind === 'crossing' &&
             columns[end][0].kind === 'crossing' &&
             columns[end][0].status === columns[begin][0].status) ++end;
      if (end - begin > 1 && (!best || end - begin > best[1] - best[0])) best = [begin, end];
      begin = end;
    }
    return best;
  }

  /** Columns of the strip: one per event, or per run of one outcome if there are many. */
  function columnsOf(events, most) {
    var columns = events.map(function (event) { return [event]; });
    var run = longestRun(columns), keep, grouped;
    while (run && breadthOf(columns) > most) {
      // The ends of a run stay if there is room: they lie beside the events that decide.
      keep = run[1] - run[0] > 4 && breadthOf(columns) - (run[1] - run[0]) + 3.4 <= most ? 1 : 0;
      grouped = [].concat.apply([], columns.slice(run[0] + keep, run[1] - keep));
      columns.splice(run[0] + keep, run[1] - run[0] - 2 * keep, grouped);
      run = longestRun(columns);
    }
    return columns;
  }

  /**
   * Maps depths and heights into a panel `width` wide: to scale where that is readable; else
   * heights are compressed, or depths are placed by their order alone, at `columnX`.
   */
  function layout(record, plane, events, casters, width, columnX) {
    var left = 34, right = 18, most = 250, least = 96, top = 26;
    var depths = events.filter(function (event) {
      return isFinite(event.depth) && event.kind !== 'far';
    }).map(function (event) { return event.depth; });
    var last = Math.max.apply(null, depths) * 1.06 || 1;
    if (isFinite(record.far) && record.far !== null && record.far <= 1.4 * last)
      last = Math.max(last, record.far * 1.03);
    var first = Math.min.apply(null, [0].concat(depths)), light = plane.light;
    if (depths.length <= (record.orthographic ? 1 : 2)) // only eye and near
      last = Math.max(last, 8 * record.near, plane.directional ? 0 : light[0]);
    var lightIn = !plane.degenerate && !plane.directional && light[0] > -0.6 * last &&
      light[0] < 1.7 * last && light[1] < 3 * last;
    if (lightIn) {
      first = Math.min(first, light[0] - 0.02 * last);
      last = Math.max(last, light[0] * 1.02);
    }
    var highest = casters.reduce(function (height, caster) {
      return caster ? Math.max(height, caster[1]) : height;
    }, 0) * 1.2;
    var reach = lightIn ? light[1] : highest > 0 ? Math.min(highest, 3 * last) : 0.06 * last;
    var scaleX = (width - left - right) / (last - first);
    var shrunk = Math.min(1, most / (reach * scaleX));
    if (shrunk >= 0.6) scaleX *= shrunk;
    var tall = clamp(reach * scaleX, least, most);
    var scaleY = reach * scaleX < 40 || reach * scaleX > most * 1.001 ? tall / reach : scaleX;
    var margin = left + (width - left - right - (last - first) * scaleX) / 2;
    var ray = top + tall;
    function linear(depth) { return margin + (depth - first) * scaleX; }
    var gaps = 0, close = 0;
    depths.forEach(function (depth, i) {
      if (i === 0) return;
      ++gaps;
      if (linear(depth) - linear(depths[i - 1]) < 4) ++close;
    });
    var ordinal = gaps > 2 && close > 0.5 * gaps || linear(record.near) - linear(0) < 1.5 &&
      gaps > 3 && close > 1;
    var between = ordinal ? interpolation(events, columnX) : linear;
    var lightAt = [between(light[0]), ray - light[1] * scaleY];
    if (ordinal) {
      lightAt = [clamp(between(light[0]), left + 20, width - 60), top + 14];
      lightIn = !plane.degenerate && !plane.directional;
      tall = 190;
      ray = top + tall;
      if (plane.directional) // as far away in the drawing as among the depths
        lightAt = [0, 1].map(function (i) {
          var size = Math.sqrt(light[0] * light[0] + light[1] * light[1]);
          return (i ? ray : 0) + (i ? -1 : 1) * 1e4 * tall * light[i] / size;
        });
    }
    return {
      ray: ray, bottom: ray + 62, ordinal: ordinal, lightIn: lightIn, light: lightAt,
      arrow: plane.directional && !plane.degenerate
        ? arrowAlong(ordinal ? [-light[0], light[1]] : [-light[0] * scaleX, light[1] * scaleY])
        : null,
      scale: ordinal ? null : scaleY / scaleX, top: top,
      right: ordinal ? width - right : linear(last),
      x: function (depth) {
        if (depth === -Infinity) return ordinal ? columnX(0) : linear(first);
        return isFinite(depth) ? between(depth) : width - right;
      },
      point: function (at) { return [between(at[0]), ray - at[1] * scaleY]; }
    };
  }

  /** A directional light's direction in the drawing, at the upper border: [tail, tip]. */
  function arrowAlong(way) {
    var length = Math.sqrt(way[0] * way[0] + way[1] * way[1]), x = way[0] / length * 13,
        y = way[1] / length * 13;
    return [[24 - x, 18 - y], [24 + x, 18 + y]];
  }

  /** Depth to x by the places of the columns, linear in between. */
  function interpolation(events, columnX) {
    var knots = events.map(function (event, i) { return [event.depth, columnX(i)]; })
      .filter(function (knot) { return isFinite(knot[0]); });
    return function (depth) {
      var i = 1, a, b;
      while (i < knots.length - 1 && knots[i][0] < depth) ++i;
      a = knots[i - 1];
      b = knots[i];
      return b[0] === a[0] ? b[1] : a[1] + (depth - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
    };
  }

  /** Points of the drawing for one crossing: on the ray, at the caster, and how far beyond. */
  function crossingPoints(place, plane, caster, depth) {
    var on = [place.x(depth), place.ray];
    var along = 0.5;
    if (caster) {
      var whole = Math.sqrt(Math.pow(depth - plane.light[0], 2) + Math.pow(plane.light[1], 2));
      var part = Math.sqrt(Math.pow(caster[0] - plane.light[0], 2) +
                           Math.pow(caster[1] - plane.light[1], 2));
      along = whole > 0 ? clamp(part / whole, 0, 1) : 0.5;
    }
    var from = place.light;
    var beyond = (place.bottom - on[1]) / Math.max(on[1] - from[1], 1e-6);
    return { on: on,
             caster: [from[0] + along * (on[0] - from[0]), from[1] + along * (on[1] - from[1])],
             away: [on[0] + beyond * (on[0] - from[0]), place.bottom] };
  }

  /** A short stroke where a triangle meets the plane of the drawing, through the ray. */
  function strokeOf(record, plane, place, corners, depth, least) {
    var on = [place.x(depth), place.ray];
    var ends = plane.degenerate || place.ordinal ? null : cutTriangle(plane, record.eye, corners);
    if (!ends) return [[on[0] - 5, on[1] - least], [on[0] + 5, on[1] + least]];
    return ends.map(place.point).map(function (end) {
      var x = end[0] - on[0], y = end[1] - on[1], far = Math.sqrt(x * x + y * y);
      if (far >= least) return end;
      return far < 0.01 ? on : [on[0] + x / far * least, on[1] + y / far * least];
    });
  }

  return { clamp: clamp, planeOf: planeOf, cutPoint: cutPoint, eventsOf: eventsOf,
           columnsOf: columnsOf, breadth: breadth, breadthOf: breadthOf, layout: layout,
           crossingPoints: crossingPoints, strokeOf: strokeOf };
}());
