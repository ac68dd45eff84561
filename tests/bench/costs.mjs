// What each bundled scene costs to verify, for cutting runs into shards (--shard):
//   build/release/shadowproof verify --out report && node tests/bench/costs.mjs report
// writes scenes/bundled/costs.json. To be made anew where a scene or a technique is new, or where
// shard_bench.mjs finds shards that are no longer alike.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const [report] = process.argv.slice(2);
if (!report) {
  console.error('usage: node tests/bench/costs.mjs REPORT');
  process.exit(2);
}
const { version, scenes } = JSON.parse(readFileSync(join(report, 'results.json')));
const round = (ms) => Number(ms.toPrecision(3));
const lines = scenes.map(({ name, triangles, spent_ms, techniques }) => JSON.stringify({
  name, triangles, spent_ms: round(spent_ms),
  techniques: techniques.map((cell) => ({ name: cell.name, spent_ms: round(cell.spent_ms) })),
}));
const text = `{"schema":"shadowproof/costs/1","version":"${version}","scenes":[\n${lines.join(',\n')}\n]}\n`;
JSON.parse(text);
writeFileSync(new URL('../../scenes/bundled/costs.json', import.meta.url), text);
