// Writes the page docs/stress-claims.md from what stress found:
//   shadowproof stress ordinary --no-pictures --json stress.json --technique \
//       zfail_reversed,traced_epsilon,traced_offset,traced_skip,cube_map_six_pass
//   node docs/stress_claims.mjs stress.json > docs/stress-claims.md
import { readFileSync } from 'node:fs';

const run = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const [scene] = run.scenes;
const points = run.points.filter((point) => point.scene === scene.name && !point.searched);
const techniques = [...new Set(points.map(({ technique }) => technique))]
  .filter((name) => name !== 'truth');

const grouped = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, ',');
const printed = (value) => (value > 0 && value < 1e-2 ? value.toExponential()
  : String(Number(value.toPrecision(3))));

/** Pixels that are wrong: those at edges may be drawn either way. */
const wrong = (point) => (point.refused ? 'refused'
  : grouped(point.differing - (point.causes.edge ?? 0)));

function rowOf(truth) {
  const found = (technique) => points.find((point) => point.technique === technique &&
    point.parameter === truth.parameter && point.value === truth.value);
  return techniques.map(found).map((point) => (point ? wrong(point) : ''));
}

const truths = points.filter(({ technique, refused }) => technique === 'truth' && !refused);
const asItIs = rowOf(truths.find(({ own }) => own));

/** Values of one parameter, next to each other, at which all techniques get as many wrong. */
const runs = [];
for (const truth of truths.filter(({ own }) => !own)) {
  const row = rowOf(truth);
  const last = runs.at(-1);
  if (last?.parameter === truth.parameter && last.row.join() === row.join())
    last.values.push(truth.value);
  else
    runs.push({ parameter: truth.parameter, values: [truth.value], row });
}
const valuesOf = ({ values }) => (values.length === 1 ? printed(values[0])
  : `${printed(values[0])} to ${printed(values.at(-1))}`);
const told = runs.filter(({ row }) => row.join() !== asItIs.join());
const alike = runs.filter(({ row }) => row.join() === asItIs.join());
const line = (cells) => `| ${cells.join(' | ')} |`;
const command = `shadowproof stress ${scene.name} --no-pictures --json stress.json --technique \\
    ${techniques.join(',')}`;

console.log(`# Rays and maps under stress

Customary recipes of ray tracers, and a shadow map, on the scene \`${scene.name}\` at
${scene.width}x${scene.height} as it becomes extreme: how many of ${grouped(scene.width * scene.height)} pixels
each gets wrong. Rays are Embree's, in float. \`traced_epsilon\` begins shadow rays a little further on,
\`traced_offset\` moves their origins along the normal, \`traced_skip\` ignores the triangle that was hit
([how](techniques.md)). \`zfail_reversed\` stands for shadow volumes. All use their own settings; pixels
at edges, where either answer is right, do not count. A blank: the parameter is a setting that the
technique does not have. What the parameters mean, see [Stress](stress.md#parameters).

${line(['parameter', 'value', ...techniques.map((name) => `\`${name}\``)])}
${line(['---', '--:', ...techniques.map(() => '--:')])}
${line(['as it is', '', ...asItIs])}
${told.map((each) => line([`\`${each.parameter}\``, valuesOf(each), ...each.row])).join('\n')}

As many as on the scene as it is, each technique gets wrong at
${alike.map((each) => `\`${each.parameter}\` ${valuesOf(each)}`).join(', ')}.

Embree's floats differ a little from processor to processor; these are of Embree ${run.embree},
the map of ${run.gl.renderer}, and the page is made by

\`\`\`
${command}
node docs/stress_claims.mjs stress.json > docs/stress-claims.md
\`\`\``);
