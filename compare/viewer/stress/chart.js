// Charts along a parameter: wrong pixels, and what the truth costs. Both axes are logarithmic, with a
// place of its own for zero.

const valueWords = (value) => (value === 0 ? '0' : printed(value, 3));

/** x of a parameter's values; 0 stands to the left of all others. */
function valueScale(values, left, right) {
  const above = values.filter((value) => value > 0);
  const from = values.includes(0) ? left + 46 : left;
  const scale = logScale(Math.min(...above), Math.max(...above), from, right);
  return (value) => (value === 0 ? left : scale(value));
}

/** y of a share in percent; 0 stands below all others. */
function shareScale(shares, top, bottom) {
  const above = shares.filter((share) => share > 0);
  if (above.length === 0) return () => bottom;
  const low = Math.min(...above) / 1.5;
  const scale = logScale(low, Math.max(...above) * 1.5, bottom - 26, top);
  return (share) => (share === 0 ? bottom : scale(share));
}

/** Ticks that leave room for their words. */
function roomy(values, at, room) {
  let last = -Infinity;
  return [...values].sort((a, b) => at(a) - at(b)).filter((value) => {
    if (at(value) - last < room) return false;
    last = at(value);
    return true;
  });
}

/**
 * Lines of shares in percent along a parameter. `series`: { name, group, points: [{ value, share }],
 * breaks: values of breaking points, derived: those that are worked out }. `own`: the scene's own
 * value.
 */
function shareChart(title, series, values, own, ink, width) {
  const box = { left: 74, right: width - 230, top: 40,
                bottom: 40 + Math.max(150, 13 * series.length) };
  const height = box.bottom + 26;
  const x = valueScale(values, box.left, box.right);
  const shares = series.flatMap(({ points }) => points.map(({ share }) => share));
  const y = shareScale(shares, box.top, box.bottom);
  const above = shares.filter((share) => share > 0);
  const quiet = { fill: ink.quiet };
  const grid = { stroke: ink.line };
  const parts = [];
  for (const value of roomy(values, x, 54))
    parts.push(line([[x(value), box.top], [x(value), box.bottom]], grid),
               words(x(value), box.bottom + 17, valueWords(value), { ...quiet, 'text-anchor': 'middle' }));
  parts.push(line([[x(own), box.top - 4], [x(own), box.bottom]],
                  { stroke: ink.ink, 'stroke-dasharray': '2 3', class: 'own' }),
             words(x(own), box.top - 7, 'as it is', { ...quiet, 'text-anchor': 'middle' }),
             words(box.left - 8, box.bottom + 4, '0', { ...quiet, 'text-anchor': 'end' }));
  for (const share of above.length > 0 ? roundValues(Math.min(...above), Math.max(...above)) : [])
    parts.push(line([[box.left, y(share)], [box.right, y(share)]], grid),
               words(box.left - 8, y(share) + 4, `${shortNumber(share)} %`,
                     { ...quiet, 'text-anchor': 'end' }));
  const ends = series.map(({ points }) => [x(points.at(-1).value), y(points.at(-1).share)]);
  const heights = spreadOut(ends.map(([, at]) => at), 13, box.top, box.bottom);
  const dashes = ['none', '7 3', '2 3', '9 3 2 3', '5 2', '12 4'];
  series.forEach(({ name, group, points, breaks, derived }, i) => {
    const color = inkOf(group, ink);
    const places = points.map(({ value, share }) => [x(value), y(share)]);
    parts.push(line(places, { stroke: color, 'stroke-width': 1.5,
                              'stroke-dasharray': dashes[i % dashes.length] }),
               ...points.filter(({ share }) => share > 0)
                 .map(({ value, share }) => mark(group, x(value), y(share), ink)),
               line([ends[i], [box.right + 14, heights[i]]],
                    { stroke: ink.quiet, 'stroke-width': 0.7, 'stroke-dasharray': '1 2' }),
               words(box.right + 18, heights[i] + 4, name,
                     { 'font-family': mono, fill: ink.ink, 'font-size': 10.5 }));
    for (const value of breaks)
      parts.push(svgElement('path', { class: 'breaking', fill: 'none', stroke: color,
        'stroke-width': 2, d: `M${x(value).toFixed(1)} ${box.bottom - 9}v18` },
        svgElement('title', {}, `${name} breaks at ${valueWords(value)}`)));
    for (const value of derived)
      parts.push(svgElement('path', { class: 'derived', fill: 'none', stroke: color,
        'stroke-width': 2, 'stroke-dasharray': '2 2',
        d: `M${x(value).toFixed(1)} ${box.bottom - 9}v18` },
        svgElement('title', {}, `${name} is derived to break at ${valueWords(value)}`)));
  });
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                             width, height, role: 'img', 'aria-label': title },
    svgElement('rect', { width, height, fill: ink.paper }),
    words(16, 20, title, { fill: ink.ink, 'font-size': 13, 'font-weight': 700 }), ...parts);
}

/** What truth costs along a parameter, in times of what it costs on the scene as it is. */
function truthSeries(points) {
  const own = points.find((point) => point.own);
  const group = groupOf({ technique: 'truth' });
  const times = points.map((point) =>
    ({ value: point.value, share: 100 * point.ms.median / own.ms.median }));
  const exact = points.map((point) =>
    ({ value: point.value, share: point.rays > 0 ? 100 * point.exact_decisions / point.rays : 0 }));
  return [{ name: 'time, of its own', group, points: times, breaks: [], derived: [] },
          { name: 'exact decisions a ray', group: markGroups[2], points: exact, breaks: [], derived: [] }];
}
