// Loads the data of the report's scripts on demand: a page from disk cannot read files, but it can
// run scripts. Missing or damaged data is an Error that names it.

const received = { legend: null, results: null, files: new Map() };

window.shadowproof = {
  legend: (legend) => { received.legend = legend; },
  results: (results) => { received.results = results; },
  scene: (folder, scene) => { received.files.set(`${folder}/scene.js`, scene); },
  cell: (id, cell) => { received.files.set(`${id}/cell.js`, cell); },
};

/** What a script of the folder, "near_plane/scene.js", hands over; read once. */
function handedOver(path) {
  return new Promise((resolve, reject) => {
    if (received.files.has(path)) {
      resolve(received.files.get(path));
      return;
    }
    const script = element('script', { src: path });
    script.onerror = () => {
      script.remove();
      reject(new Error(`${path} is missing`));
    };
    script.onload = () => {
      script.remove();
      if (received.files.has(path)) resolve(received.files.get(path));
      else reject(new Error(`${path} is damaged`));
    };
    document.head.append(script);
  });
}

const blockTypes = {
  u8: Uint8Array, i8: Int8Array, i32: Int32Array, u32: Uint32Array, f32: Float32Array,
};

/** The bytes of a base64 text that holds a zlib stream. */
async function inflated(text) {
  if (typeof DecompressionStream === 'undefined')
    throw new Error('this browser cannot inflate; Chrome 80, Firefox 113 or Safari 16.4 can');
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; ++i) bytes[i] = packed.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** A block as a typed array of `length` elements (its own length where not given). */
async function decodedBlock(block, length = block?.length) {
  const Type = block && blockTypes[block.type];
  if (!Type || typeof block.data !== 'string') throw new Error('is missing');
  if (block.length !== length)
    throw new Error(`is damaged: ${block.length} elements where ${length} belong`);
  let bytes;
  try {
    bytes = await inflated(block.data);
  } catch (error) {
    throw new Error(/inflate;/.test(error.message) ? error.message
                                                   : 'is damaged: it does not decode');
  }
  if (bytes.byteLength !== length * Type.BYTES_PER_ELEMENT)
    throw new Error(`is damaged: ${bytes.byteLength} bytes where ` +
                    `${length * Type.BYTES_PER_ELEMENT} belong`);
  return new Type(bytes); // little endian, like every machine with a browser
}

/** Decodes named blocks; those that cannot be decoded are null, and named in `problems`. */
async function decodedBlocks(file, blocks, lengths, problems) {
  const arrays = {};
  await Promise.all(Object.entries(lengths).map(async ([name, length]) => {
    try {
      arrays[name] = await decodedBlock(blocks?.[name], length ?? undefined);
    } catch (error) {
      arrays[name] = null;
      problems.push(`${file}: block ${name} ${error.message}`);
    }
  }));
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
