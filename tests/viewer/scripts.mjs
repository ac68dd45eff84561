// The viewer's own scripts, without a browser.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = fileURLToPath(new URL('../../compare/viewer', import.meta.url));

export const source = (name) => readFileSync(join(folder, name), 'utf8');

/** Evaluates scripts together and gives what they name. */
export function named(files, names) {
  return new Function(`${files.map(source).join('\n')}\nreturn { ${names.join(', ')} };`)();
}
