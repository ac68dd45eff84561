// What the words of the report mean, on a page of its own.

const fieldTerms = [
  ['truth', 'What ray tracing with exact arithmetic says of a pixel: lit, shadowed, or background where nothing is seen. A sign decides, never a rounded number.'],
  ['claim', 'What a technique, or another renderer’s picture, says of the same pixel.'],
  ['cell', 'One technique on one scene under one light: its pictures, its wrong pixels and its verdict.'],
  ['cause', 'Why a pixel differs: the limitation that must be lifted for the technique to show the truth there. Where several must be, all are named, and the first counts.'],
  ['verdict', 'What all differing pixels of a cell come to.'],
  ['gate', 'The rule by which a verdict or a pixel fails a run: --gate and --allow.'],
  ['baseline', 'An earlier run, against which pixels are new, gone or of another cause.'],
  ['family', 'Techniques of one kind of evidence: shadow volumes (stencil), shadow maps (map), rays traced in float (traced), pictures of another renderer (picture).'],
  ['evidence', 'What was read back beside the picture and must agree with what was predicted: a counter, a depth map, a ray.'],
  ['caster', 'A mesh that keeps light from others, or from parts of itself.'],
  ['shadow volume', 'The space that a caster keeps the light from: its sides start at the silhouette and lead away from the light.'],
  ['silhouette', 'Edges between a face that is turned to the light and one that is not.'],
  ['light cap', 'The end of a shadow volume at the caster, facing the light.'],
  ['dark cap', 'The far end of a shadow volume. At infinity under a directional light it is one point.'],
  ['z-pass', 'Counts the faces of shadow volumes in front of the surface seen: one more at an entry, one less at an exit.'],
  ['z-fail', 'Counts those behind the surface instead, so that neither eye nor near plane can miss one. It needs both caps.'],
  ['counter', 'The value that was counted at a pixel, in the stencil buffer. Other than zero: shadowed.'],
  ['ledger', 'Every face of a volume that the pixel’s ray crosses, in order, with what each was predicted to count.'],
  ['volume fragments', 'How many pixels the faces of all volumes cover, hidden or not: what drawing them costs.'],
  ['plan', 'What a scene does not need and the technique therefore leaves out, with the reason.'],
  ['exact decision', 'A sign that floating point, with its error bound, could not tell, so that integers of any length did.'],
  ['degenerate', 'A pixel of which some sign was exactly zero: its ray meets an edge, or the light lies in a triangle’s plane. All such ties are broken by the same rule; a triangle with the light in its plane is shadowed.'],
  ['bias', 'By how much a shadow map’s comparison is moved towards the light, so that a surface does not shadow itself.'],
];

/** Where a cause is explained. */
const causeLink = (name) =>
  element('a', { class: 'term', href: routeText('terms', { at: `cause-${name}` }) }, name);

/** A word may be both a cause and a verdict, or a term of the field: ids are of one kind. */
const definitions = (kind, rows) =>
  element('dl', { class: 'terms' }, rows.map(([word, meaning]) =>
    element('div', { id: `${kind}-${word.replaceAll(' ', '-')}` },
            element('dt', {}, word), element('dd', {}, meaning))));

function termSections(results) {
  const techniques = new Map(allCells(results).map(({ cell }) => [cell.name, cell.summary]));
  return [
    ['Words of the report', 'term', fieldTerms],
    ['Verdicts', 'verdict', verdictNames.map((name) => [verdicts[name].words, verdicts[name].meaning])],
    ['Causes', 'cause', received.legend.causes.map(({ name, meaning }) => [name, meaning])],
    ['Techniques', 'technique', [...techniques].filter(([, summary]) => summary)],
  ].filter(([, , rows]) => rows.length > 0);
}

function showTerms(results, params) {
  document.title = 'shadowproof: terms';
  found('main').replaceChildren(
    element('nav', { 'aria-label': 'Terms' }, element('a', { href: '#' }, '← Overview')),
    element('h1', {}, 'Terms'),
    ...termSections(results).map(([title, kind, rows]) =>
      element('section', {}, element('h2', {}, title), definitions(kind, rows))));
  const asked = found(params.get('at'));
  asked?.classList.add('asked');
  asked?.scrollIntoView({ block: 'center' });
}
