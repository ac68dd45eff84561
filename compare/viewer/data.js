// Loads the data of the report's scripts on demand: a page from disk cannot read files, but it can
// run scripts. Missing or damaged data is an Error that names it.

const received = { legend: null, results: null, files: new Map() };

window.shadowproof = {
  legend: (legend) => { received.legend = legend; },
  results: (results) => { received.results = results; },
  scene: (folder, scene) => { received.files.set(`${folder}/scene.js`, scene); },
  cell: (id, cell) => { received.files.set(`${id}.cell.js`, cell); },
};

/** A scene of the results; packed, it is base64 of a zlib stream. Throws where it is damaged. */
async function unpackedScene(scene) {
  if (typeof scene !== 'string') return scene;
  const bytes = Uint8Array.from(atob(scene), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return JSON.parse(await new Response(stream).text());
}

/** What results.js handed over, with its scenes unpacked. Throws where it is missing or damaged. */
async function unpackedResults() {
  const { results } = received;
  if (!results || !Array.isArray(results.scenes)) throw new Error('no results');
  return { ...results, scenes: await Promise.all(results.scenes.map(unpackedScene)) };
}

/** What a script of the folder, "near_plane/scene.js", hands over; read once. */
function handedOver(path) {
  return new Promise((resolve, reject) => {
    if (received.files.has(path)) {
      resolve(received.files.get(path));
      return;
    }
    const run = () => {
      if (received.files.has(path)) resolve(received.files.get(path));
      else reject(new Error(`${path} is damaged`));
    };
    const missing = () => reject(new Error(`${path} is missing`));
    if (location.protocol === 'file:') runFromDisk(path, run, missing);
    else runFromServer(path).then(run, missing);
  });
}

// Read as x-user-defined, every byte of a script's blocks is one character.
function runFromDisk(path, run, missing) {
  const script = element('script', { src: path, charset: 'x-user-defined' });
  script.onerror = () => { script.remove(); missing(); };
  script.onload = () => { script.remove(); run(); };
  document.head.append(script);
}

// The encoding that a server names would count for more than the script's own.
async function runFromServer(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(answer.statusText);
  const script = element('script', {});
  script.textContent = new TextDecoder('x-user-defined').decode(await answer.arrayBuffer());
  document.head.append(script);
  script.remove();
}

const blockTypes = {
  u8: Uint8Array, i8: Int8Array, i32: Int32Array, u32: Uint32Array, f32: Float32Array,
};

/**
 * A block as a typed array of `length` elements (its own length where not given). `guides`:
 * lists by name that it may be coded with; `differing`: 1 for each pixel that differs.
 */
function decodedBlock(block, { length = block?.length, guides, differing }) {
  const Type = block && blockTypes[block.type];
  if (!Type || typeof block.data !== 'string' || !(block.as in codedReaders))
    throw new Error('is missing');
  if (block.length !== length)
    throw new Error(`is damaged: ${block.length} elements where ${length} belong`);
  const guide = block.guide ? guides[block.guide] : null;
  if (block.guide && !guide) throw new Error(`cannot be decoded without ${block.guide}`);
  if (block.of && !differing) throw new Error('cannot be decoded without the cause map');
  const values = codedNumbers(block, length, { guide, mask: block.of ? differing : null });
  if (Type === Uint32Array) return values;
  if (Type === Float32Array) return new Float32Array(values.buffer);
  return Type.from(values);
}

/**
 * Decodes named blocks, in this order; those that cannot be decoded are null, and named in
 * `problems`. `how`: as decodedBlock takes it; what is decoded is a guide to the later ones.
 */
function decodedBlocks(file, blocks, lengths, problems, how = {}) {
  const arrays = {};
  for (const [name, length] of Object.entries(lengths))
    try {
      arrays[name] = decodedBlock(blocks?.[name], {
        ...how, length: length ?? undefined, guides: { ...how.guides, ...arrays } });
    } catch (error) {
      arrays[name] = null;
      problems.push(`${file}: block ${name} ${error.message}`);
    }
  return arrays;
}

/** An Error's words, or null in place of what could not be had. */
async function orProblem(promise, problems) {
  try {
    return await promise;
  } catch (error) {
    problems.push(error.message);
    return null;
  }
}
