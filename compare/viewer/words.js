// Words and marks, so that nothing is shown by colour alone.

const verdicts = {
  unexplained: { mark: '?', words: 'unexplained', meaning: 'a difference that nothing predicts' },
  defect: { mark: '✕', words: 'defect', meaning: 'a cause that is not known of the technique, or precision where its numbers suffice' },
  timed_out: { mark: '…', words: 'timed out', meaning: 'given up after --timeout seconds' },
  error: { mark: '!', words: 'could not run', meaning: 'no result' },
  fails_as_predicted: { mark: '≈', words: 'fails as predicted',
                        meaning: 'only causes that technique and scene are known for' },
  agrees: { mark: '✓', words: 'agrees', meaning: 'no difference beyond edges' },
};
const verdictNames = Object.keys(verdicts);

const verdictOf = (cell) => cell.verdict ?? 'error';

/** By what a run, or a cell of a merged one, is judged. */
function gateWords(judged) {
  const gate = judged.gate === 'differences' ? 'any difference beyond edges'
                                             : 'defects and unexplained pixels';
  const allow = judged.allow?.length ? `; allowed: ${judged.allow.join(', ')}` : '';
  return `Fails on ${gate}${allow}.`;
}

/** A cell that could not run fails under every gate. */
const isFailing = (cell) => Boolean(cell.error) || cell.fails === true;

/** It agrees, and yet the rasterizer covered other pixels at outlines than the truth sees. */
const isButForEdges = (cell) => verdictOf(cell) === 'agrees' && cell.differing > 0;

const badge = (verdict) => element('span', { class: `badge ${verdict}` },
  element('span', { 'aria-hidden': 'true' }, `${verdicts[verdict].mark} `),
  verdicts[verdict].words);

const beyondEdges = (cell) => (cell.error ? 0 : cell.differing - (cell.causes.edge ?? 0));

/** Causes of a cell, [name, pixels], most pixels first but edges last. */
const causesOf = (cell) => Object.entries(cell.causes ?? {}).sort(([a, m], [b, n]) =>
  (a === 'edge') - (b === 'edge') || (b === 'unexplained') - (a === 'unexplained') || n - m);

const causeLegend = (name) =>
  received.legend.causes.find((cause) => cause.name === name) ??
  { name, meaning: 'not in this report’s legend', color: '#888888' };

/** "near_plane 67,769, edge 1". */
const causeCounts = (cell) =>
  causesOf(cell).map(([name, pixels]) => `${name} ${grouped(pixels)}`).join(', ');

/** Why a cell is as it is, in one sentence. */
function reasonOf(cell) {
  if (cell.error) return cell.error;
  const [worst] = causesOf(cell);
  const family = familyOf(cell);
  const said = family.faults(cell).filter(Boolean);
  const colors = cell.color?.unpredicted ?? 0;
  if (colors > 0)
    said.push(`The colour is not what the technique’s arithmetic predicts at ` +
              counted(colors, 'pixel'));
  if (worst && worst[0] !== 'edge')
    said.push(`${worst[0]} at ${counted(worst[1], 'pixel')}: ${causeLegend(worst[0]).meaning}`);
  said.push(...family.explained(cell));
  if (said.length === 0)
    said.push(cell.differing > 0 ? 'Only edge pixels differ, within the rasterizer’s error bound'
                                 : 'Every pixel agrees');
  return `${said.join('. ')}.`;
}

/** A word of a shell's command, with quoted parts. */
const shellWord = String.raw`(?:'[^']*'|\\.|[^\s'\\])+`;
const ofNoPixel = ['mask', 'unlit', 'unshadowed', 'renderer', 'name', 'gate', 'allow', 'baseline', 'junit', 'json', 'out'];

/**
 * The same settings and technique, for one pixel. Gates and files do not concern it, nor do a
 * renderer and its pictures.
 */
const explainCommand = (command, x, y) =>
  `${command.replace(/^(\S*shadowproof) verify /, '$1 explain ')
    .replace(new RegExp(`^(\\S*shadowproof) check (${shellWord})(?: (?!--)${shellWord})*`),
             '$1 explain $2')
    .replace(new RegExp(` --(?:${ofNoPixel.join('|')}) ${shellWord}`, 'g'), '')
    .replace(/ --no-alignment\b/, '')} --pixel ${x},${y}`;

const contradictionOf = (truth, claim) => {
  if (truth === claim) return -1;
  if (truth === 0 || claim === 0) return 2;
  if (claim === partlyLit) return 3;
  return claim === 255 ? 0 : 1;
};
