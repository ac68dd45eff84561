// Copies of sources with faults in them, each behind a switch:
//   node patch.mjs files SOURCE        the C++ files that the catalogue changes
//   node patch.mjs write SOURCE OUT    writes their copies, and catalogue.cpp
// A fault names a text of a file, which must be there once, and what stands in its place. Texts of
// several faults may be equal, but not overlap.
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [what, source, out] = process.argv.slice(2);
const folder = join(dirname(fileURLToPath(import.meta.url)), 'catalogue');
const faults = [];
for (const file of readdirSync(folder).filter((name) => name.endsWith('.mjs')).sort())
  faults.push(...(await import(pathToFileURL(join(folder, file)))).faults);

// Those that differ in what most faults touch; lighting is tried with those that light bumps.
const usual = 'zpass,zfail,zfail_clamp,zfail_reversed,zfail_half_edge,zfail_truncated,zpass_capped,zfail_float,auto';
const lights = 'bump_three_pass,bump_three_pass_per_pixel,bump_one_pass,bump_eye_space,bump_tangent_space,bump_tangent_space_per_vertex,bump_reflective,bump_three_pass+zpass,bump_tangent_space+zfail';
const lightingTables = /normalisation_cube|bump_forms|relief|plane_equations|texel_sides|raster.lighting|glsl.lighting/;
const maps = 'cube_map_six_pass,cube_map_geometry_shader,spot_map';
const ofMaps = /maps\//;
for (const fault of faults)
  fault.techniques ??= ofMaps.test(fault.file) ? maps : lightingTables.test(fault.file) ? lights : usual;

const isShader = (file) => file.startsWith('raster/glsl/');
// Through which shaders get their faults.
const hook = { file: 'raster/gl/shader.cpp', right: 'return {name, glsl_source(name)};',
               always: 'return {name, faults::shader(glsl_source(name))};' };
const files = [...new Set([hook, ...faults].map(({ file }) => file))].filter((file) => !isShader(file));

const textOf = (file) => readFileSync(join(source, file), 'utf8');
function placeOf(text, { name, file, right }) {
  const first = text.indexOf(right);
  if (first < 0) throw new Error(`fault ${name}: ${file} has no text\n${right}`);
  if (text.indexOf(right, first + 1) >= 0) throw new Error(`fault ${name}: ${file} has it more than once:\n${right}`);
  return first;
}

const wrongOf = (n) => faults[n].wrong.replaceAll('AMOUNT', '::shadowproof::faults::amount.load()');

/** What stands for the right text: a choice between it and its faults. */
function choice(right, numbers) {
  const isStatement = /[;}]$/.test(right.trim());
  if (!isStatement)
    return `(${numbers.map((n) => `::shadowproof::faults::is(${n}) ? (${wrongOf(n)}) : `).join('')}(${right}))`;
  return `${numbers.map((n) => `if (::shadowproof::faults::is(${n})) { ${wrongOf(n)} } else `).join('')}{ ${right} }`;
}

function patched(file) {
  const text = textOf(file);
  const places = new Map(); // by the right text: where, and the numbers of its faults
  faults.forEach((fault, number) => {
    if (fault.file !== file) return;
    const known = places.get(fault.right) ?? { at: placeOf(text, fault), numbers: [] };
    known.numbers.push(number);
    places.set(fault.right, known);
  });
  const changes = [...places].map(([right, { at, numbers }]) => ({ at, right, text: choice(right, numbers) }));
  if (file === hook.file) changes.push({ at: placeOf(text, hook), right: hook.right, text: hook.always });
  changes.sort((a, b) => a.at - b.at);
  let done = `#include "tests/sensitivity/faults.h"\n#line 1 "${join(source, file)}"\n`;
  let end = 0;
  for (const change of changes) {
    if (change.at < end) throw new Error(`${file}: faults overlap at\n${change.right}`);
    done += text.slice(end, change.at) + change.text;
    end = change.at + change.right.length;
  }
  return done + text.slice(end);
}

const quoted = (text) => JSON.stringify(text ?? '');

if (what === 'files') {
  console.log(files.join(';'));
} else {
  for (const fault of faults)
    if (isShader(fault.file)) placeOf(textOf(fault.file), fault);
  for (const file of files) {
    const to = join(out, file);
    mkdirSync(dirname(to), { recursive: true });
    writeFileSync(to, patched(file));
  }
  const rows = faults.map((f) => `    {${[f.name, f.kind, f.techniques, f.file, f.right, f.wrong, f.why].map(quoted).join(', ')}, ` +
    `Scope::${f.scope ?? 'claim'}, ${quoted(f.scenes)}, ${f.largest ?? 0}, ${f.aim ?? 0}, ` +
    `${quoted(f.unit)}, ${quoted(f.own)}},\n`);
  writeFileSync(join(out, 'catalogue.cpp'),
    '#include "tests/sensitivity/faults.h"\n\nnamespace shadowproof::faults {\n\nnamespace {\n' +
    `const Fault catalogue[] = {\n${rows.join('')}};\n} // namespace\n\n` +
    'std::span<const Fault> all_faults() {\n    return catalogue;\n}\n\n} // namespace shadowproof::faults\n');
}
