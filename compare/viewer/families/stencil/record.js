// The record of one pixel, as `shadowproof explain --json` writes it, decoded from the blocks. The
// arithmetic is that of the command, operation by operation, so that the numbers are the same bits.

const exactnessNames = ['filtered', 'exact', 'degenerate'];
const statusNames = ['counted', 'beyond', 'lost_near', 'lost_far', 'lost_cap'];

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0],
                         a[0] * b[1] - b[0] * a[1]];

/** Where the ray of a pixel starts, and its direction: one of both is the same for all. */
function rayOf({ width, height, camera }, x, y) {
  const across = camera.half_height * width / height * (2 * (x + 0.5) / width - 1);
  const upward = camera.half_height * (1 - 2 * (y + 0.5) / height);
  const aside = (centre) => [0, 1, 2].map((i) =>
    (centre[i] + across * camera.right[i]) + upward * camera.up[i]);
  return camera.orthographic ? { eye: aside(camera.eye), direction: camera.forward }
    : { eye: camera.eye, direction: aside(camera.forward) };
}

const isBefore = (a, b) =>
  (a[0] !== b[0] ? a[0] < b[0] : (a[1] !== b[1] ? a[1] < b[1] : a[2] < b[2]));

/** Depth at which the ray meets the plane through a triangle. */
function depthOnTriangle(eye, direction, [a, b, c]) {
  const plane = cross(minus(c, a), minus(b, a));
  return -dot(minus(eye, a), plane) / dot(direction, plane);
}

/** The light (l, w): its position and 1, or the direction to a directional one and 0. */
const homogeneous = ({ kind, position, direction }) =>
  (kind === 'directional' ? { l: direction.map((value) => -value), w: 0 } : { l: position, w: 1 });

/** Depth at which the ray meets the side of a volume over the edge p -> q. */
function depthOnSide(eye, direction, { l, w }, [p, q]) {
  const flipped = isBefore(q, p);
  const [a, b] = flipped ? [q, p] : [p, q];
  const side = cross(minus(a.map((value) => w * value), l), minus(b, a));
  const plane = flipped ? side.map((value) => -value) : side;
  return -dot(minus(eye, w === 1 ? l : a), plane) / dot(direction, plane);
}

/** Where each triangle stands in the block of triangles. */
function triangleRanks(opened) {
  if (!opened.triangleRanks) {
    opened.triangleRanks = new Map();
    const { triangle } = opened.blocks;
    for (let i = 0; i < triangle.length; i += 4) opened.triangleRanks.set(triangle[i], i);
  }
  return opened.triangleRanks;
}

/** Corners of a triangle that the blocks name. */
function cornersOf(opened, triangle) {
  const { triangle: triangles, vertex } = opened.blocks;
  const rank = triangleRanks(opened).get(triangle);
  if (rank === undefined)
    throw new Error(`${opened.id}.cell.js: block triangle lacks triangle ${triangle}`);
  return [1, 2, 3].map((k) => {
    const at = 3 * triangles[rank + k];
    return [vertex[at], vertex[at + 1], vertex[at + 2]];
  });
}

function meshOf({ sceneFile }, triangle) {
  const mesh = sceneFile.meshes.find(({ first, count }) =>
    triangle >= first && triangle < first + count);
  return mesh ? mesh.name : '';
}

const named = (opened, triangle) =>
  (triangle === noTriangle ? null : { triangle, mesh: meshOf(opened, triangle) });

/** Where each ledger begins in the block of crossings. */
function ledgerStarts(opened) {
  if (!opened.ledgerStarts) {
    const { crossing } = opened.blocks;
    opened.ledgerStarts = [0];
    for (let i = crossing.indexOf(0); i >= 0; i = crossing.indexOf(0, i + 1))
      opened.ledgerStarts.push(i + 1);
  }
  return opened.ledgerStarts;
}

/** The crossings of a ledger, in the order in which they lie on the ray. */
function listedCrossings(opened, ledger) {
  const { crossing, face } = opened.blocks;
  const start = ledgerStarts(opened);
  return Array.from(crossing.subarray(start[ledger], start[ledger + 1] - 1), (each) => {
    const number = each - 1;
    return { triangle: face[2 * (number >>> 4)], part: face[2 * (number >>> 4) + 1],
             change: number & 8 ? -1 : 1, status: statusNames[number & 7] };
  });
}

function crossingsOf(opened, listed, eye, direction, light) {
  return listed.map(({ triangle, part, change }) => {
    // Far ends of volumes are numbered after all triangles.
    const corners = cornersOf(opened, part === 4 ? triangle + opened.scene.triangles : triangle);
    const isCap = part >= 3;
    const from = isCap ? corners : [corners[part], corners[(part + 1) % 3]];
    return {
      depth: isCap ? depthOnTriangle(eye, direction, from)
                   : depthOnSide(eye, direction, light, from),
      change,
      kind: ['side', 'side', 'side', 'light cap', 'dark cap'][part],
      caster: named(opened, triangle),
      from,
    };
  });
}

/** What became of the dark caps, which lie at infinity. */
function darkCapStatus({ counting, depth }) {
  if (counting.test === 'depth_pass') return 'beyond';
  if (depth.projection.startsWith('finite') && !counting.depth_clamp) return 'lost_far';
  return counting.dark_cap ? 'counted' : 'lost_cap';
}

/** How each crossing is counted, where casters are not counted alike. */
function testsOf({ cellFile, sceneFile }, listed) {
  const { tests } = cellFile.counting;
  if (!tests) return undefined;
  return listed.map(({ triangle }) => tests[sceneFile.meshes.findIndex(({ first, count }) =>
    triangle >= first && triangle < first + count)]);
}

/** Dark caps at infinity: of the casters that are counted behind the surface. */
function darkCapCount(inside, crossings, tests) {
  if (!tests) return inside.infinity;
  return crossings.reduce((sum, { change }, i) =>
    (tests[i] === 'depth_fail' ? sum + change : sum), inside.eye);
}

/** Pixels to the nearest centre whose truth is of another class; null where there is none. */
function distanceToOtherClass({ visibility, width, height }, x, y) {
  const own = visibility[y * width + x];
  let nearest = Infinity;
  const look = (row) => {
    if (row < 0 || row >= height) return;
    const down = (row - y) ** 2;
    for (let column = 0; column < width; ++column) {
      const squared = down + (column - x) ** 2;
      if (squared < nearest && visibility[row * width + column] !== own) nearest = squared;
    }
  };
  look(y);
  for (let away = 1; away < height && away * away < nearest; ++away) {
    look(y - away);
    look(y + away);
  }
  return nearest === Infinity ? null : Math.sqrt(nearest);
}

function seenRecord(opened, triangle, eye, direction) {
  if (triangle === noTriangle) return null;
  const corners = cornersOf(opened, triangle);
  const depth = depthOnTriangle(eye, direction, corners);
  return { ...named(opened, triangle), depth, point: eye.map((e, i) => e + depth * direction[i]),
           corners };
}

/** Depth from the seen point to the nearest crossing, its own triangle's light cap not counted. */
function marginDepth(seen, crossings) {
  if (!seen) return null;
  const others = crossings.filter(({ kind, caster }) =>
    kind === 'side' || caster.triangle !== seen.triangle);
  if (others.length === 0) return null;
  return Math.min(...others.map(({ depth }) => Math.abs(seen.depth - depth)));
}

function insideOf({ blocks }, ledger, seen) {
  const [eye, near, surface, far, infinity, letThrough] =
    blocks.ledger_counts.subarray(6 * ledger, 6 * ledger + 6);
  return { eye, near, surface: seen ? surface : null, far, infinity, let_through: letThrough };
}

/** The record of a pixel that differs. */
function pixelRecord(opened, x, y) {
  const { scene, cell, sceneFile, cellFile, sceneBlocks, blocks, width } = opened;
  const pixel = y * width + x;
  const rank = rankOf(opened.differing, pixel);
  const { camera, light } = sceneFile;
  const { eye, direction } = rayOf(sceneFile, x, y);
  const ledger = blocks.ledger[rank];
  const seen = seenRecord(opened, sceneBlocks.seen[pixel], eye, direction);
  const listed = listedCrossings(opened, ledger);
  const crossings = crossingsOf(opened, listed, eye, direction, homogeneous(light));
  const inside = insideOf(opened, ledger, seen);
  const tests = testsOf(opened, listed);
  return {
    schema: 'shadowproof/pixel/1', scene: scene.name, x, y, width, height: opened.height,
    eye, direction, orthographic: camera.orthographic, near: camera.near, far: sceneFile.far, light,
    truth: visibilityNames[opened.visibility[pixel]],
    exactness: exactnessNames[sceneBlocks.exactness[pixel]],
    seen,
    margin: { depth: marginDepth(seen, crossings), pixels: distanceToOtherClass(opened, x, y) },
    inside, crossings, adds_up: blocks.ledger_exact[ledger] === 1,
    techniques: [{
      name: cell.name, test: cellFile.counting.test, tests,
      operation: cellFile.counting.operation,
      start: { zero: 0, eye: inside.eye, near_plane: inside.near }[cellFile.counting.start],
      predicted: blocks.ledger_predicted[ledger],
      stored: blocks.predicted[pixel], read_back: blocks.read_back[pixel],
      claim: visibilityNames[blocks.claim[pixel]],
      shown: named(opened, blocks.shown[rank]),
      cause: received.legend.causes[opened.causes[pixel]].name,
      statuses: listed.map(({ status }) => status),
      dark_cap: darkCapStatus(cellFile),
      dark_caps: darkCapCount(inside, crossings, tests),
    }],
  };
}
