// One cell with all that the report holds of its pixels. What could not be loaded is null and named
// in `problems`; the pages say so, and never take it for agreement.

const noDifference = 255;
const noTriangle = 0xffffffff;
const partlyLit = 160;
const visibilityNames = { 0: 'background', 64: 'shadowed', [partlyLit]: 'partly lit', 255: 'lit' };

/** Indices of the pixels that differ, in rows from the top. */
function differingPixels(causes) {
  const found = [];
  causes.forEach((cause, pixel) => { if (cause !== noDifference) found.push(pixel); });
  return Uint32Array.from(found);
}

/** Where a sorted array holds a value, or -1. */
function rankOf(sorted, value) {
  let low = 0;
  let high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return sorted[low] === value ? low : -1;
}

/** How often each value of 0..255 stands in an array. */
function tallied(values) {
  const counts = new Uint32Array(256);
  for (const value of values) ++counts[value];
  return counts;
}

/** How often each value stands in an array, of whatever size it is. */
function talliedAll(values) {
  const counts = new Map();
  for (const value of values) counts.set(value, (counts.get(value) ?? 0) + 1);
  return counts;
}

function checkTruth(opened) {
  const { scene, visibility, problems } = opened;
  const counts = tallied(visibility);
  const said = scene.reference;
  if (counts[255] !== said.lit || counts[64] !== said.shadowed || counts[0] !== said.background)
    problems.push(`${scene.folder}/scene.js does not belong to results.js: ` +
                  `${grouped(counts[255])} pixels are lit, the results have ${grouped(said.lit)}`);
}

/** Checks that the files are of one run. */
function checkCell(opened) {
  const { cell, id, causes, claim, visibility, problems } = opened;
  const counts = tallied(causes);
  if (received.legend.causes.some(({ name }, i) => counts[i] !== (cell.causes[name] ?? 0)))
    problems.push(`${id}.cell.js: block cause does not hold the pixels that results.js counts`);
  if (claim && visibility &&
      causes.some((cause, i) => cause === noDifference && claim[i] !== visibility[i]))
    problems.push(`${id}.cell.js does not belong to results.js: ` +
                  'pixels differ that have no cause there');
}

/** noDifference where the claim has the truth's visibility, else 0; null where one is unknown. */
const differenceOf = (visibility, claim) =>
  (visibility && claim ? claim.map((value, i) => (value === visibility[i] ? noDifference : 0)) : null);

/** Besides claim and cause, which others are decoded by. */
const lengthsOfCell = (cell, pixels) =>
  ({ ...(cell.partly_lit === undefined ? {} : { share: pixels }),
     ...familyOf(cell).blocks(pixels, cell.differing) });

/** What is claimed at a pixel: "lit", "partly lit (68.8 %)". */
function claimWords({ claim, share }, pixel) {
  const words = visibilityNames[claim[pixel]];
  return claim[pixel] === partlyLit && share ? `${words} (${printed(100 * share[pixel], 3)} %)`
                                             : words;
}

/** The blocks of a cell's colours, if it has some. Damaged ones do not affect the evidence. */
function openColors({ scene, cell, id, sceneFile, cellFile, own, blocks, problems }) {
  if (!cell.color) return {};
  const pixels = scene.width * scene.height;
  // Of what filters, the right colours are means over the pixels, which are told against the others.
  const lengths = { color: 3 * pixels, ...(cell.color.filter ? { mean_color: 3 * pixels } : {}) };
  const truth = sceneFile && decodedBlocks(`${scene.folder}/scene.js`, sceneFile.blocks, lengths,
                                           problems);
  const right = cell.color.filter ? truth?.mean_color : truth?.color;
  const claim = cellFile && decodedBlocks(
    `${id}.cell.js`, own, { color: 3 * pixels, color_verdict: pixels }, problems,
    { guides: { true_color: right, claim: blocks?.claim } });
  return { trueColor: right ?? null, claimedColor: claim?.color ?? null,
           colorVerdict: claim?.color_verdict ?? null };
}

/** The blocks of a cell's file; those that stand in another cell's are taken from there. */
async function ownBlocks(scene, cellFile, problems) {
  const blocks = { ...cellFile?.blocks };
  const others = new Map();
  for (const [name, block] of Object.entries(blocks)) {
    if (!block?.from) continue;
    const [technique, other] = block.from.split('/');
    const path = `${scene.folder}/${technique}.cell.js`;
    if (!others.has(path)) others.set(path, orProblem(handedOver(path), problems));
    blocks[name] = (await others.get(path))?.blocks?.[other];
  }
  return blocks;
}

async function openCell(scene, cell) {
  const problems = [];
  const id = `${scene.folder}/${cell.name}`;
  const pixels = scene.width * scene.height;
  const [sceneFile, cellFile] = await Promise.all([
    orProblem(handedOver(`${scene.folder}/scene.js`), problems),
    orProblem(handedOver(`${id}.cell.js`), problems)]);
  const truth = sceneFile && decodedBlocks(
    `${scene.folder}/scene.js`, sceneFile.blocks,
    { visibility: pixels, ...familyOf(cell).sceneBlocks(pixels) }, problems);
  const own = await ownBlocks(scene, cellFile, problems);
  const decoded = (lengths, how) =>
    cellFile && decodedBlocks(`${id}.cell.js`, own, lengths, problems, how);
  const { claim = null } = decoded({ claim: pixels }, { guides: truth }) ?? {};
  const { cause: causes = null } = decoded(
    { cause: pixels }, { guides: { difference: differenceOf(truth?.visibility, claim) } }) ?? {};
  const blocks = cellFile && { claim, ...decoded(lengthsOfCell(cell, pixels), {
    guides: { ...truth, claim },
    differing: causes?.map((cause) => (cause === noDifference ? 0 : 1)) }) };
  const opened = {
    scene, cell, id, problems, sceneFile, cellFile, causes,
    width: scene.width, height: scene.height,
    differing: causes ? differingPixels(causes) : new Uint32Array(0),
    visibility: truth?.visibility ?? null,
    claim,
    share: blocks?.share ?? null,
    sceneBlocks: truth,
    blocks,
    ...openColors({ scene, cell, id, sceneFile, cellFile, own, blocks, problems }),
  };
  if (opened.visibility) checkTruth(opened);
  if (causes) checkCell(opened);
  if (opened.colorVerdict) checkColors(opened);
  return opened;
}
