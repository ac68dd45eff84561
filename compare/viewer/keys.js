// Every action on the keyboard. The table is also the help.

const pressed = (id) => () => found(id)?.click();
const focusOn = (id) => () => { found(id)?.focus(); found(id)?.select?.(); };
const on = (act) => () => { if (openPage) act(openPage); };

/** { keys, words, act }: `keys` as KeyboardEvent.key has them, Shift named where it matters. */
const overviewKeys = [
  { keys: ['/'], words: 'Find scenes, techniques and causes', act: focusOn('filter-find') },
  { keys: ['c'], words: 'Filter by cause', act: focusOn('filter-cause') },
  { keys: ['f'], words: 'Open the first cell that failed, else the first', act: openFirstCell },
  { keys: ['ArrowRight'], words: 'Matrix: the next cell', act: () => moveInMatrix(0, 1) },
  { keys: ['ArrowLeft'], words: 'Matrix: the cell before', act: () => moveInMatrix(0, -1) },
  { keys: ['ArrowDown'], words: 'Matrix: the scene below', act: () => moveInMatrix(1, 0) },
  { keys: ['ArrowUp'], words: 'Matrix: the scene above', act: () => moveInMatrix(-1, 0) },
];

const cellKeys = [
  { keys: ['n'], words: 'Next differing pixel', act: on((p) => p.step(1)) },
  { keys: ['p'], words: 'Previous differing pixel', act: on((p) => p.step(-1)) },
  { keys: ['f'], words: 'First differing pixel', act: on((p) => p.stepToFirst()) },
  { keys: ['c'], words: 'Step through the next cause only', act: on((p) => p.nextCause()) },
  { keys: ['ArrowRight'], words: 'Inspect the pixel to the right', act: on((p) => p.moveBy(1, 0)) },
  { keys: ['ArrowLeft'], words: 'Inspect the pixel to the left', act: on((p) => p.moveBy(-1, 0)) },
  { keys: ['ArrowDown'], words: 'Inspect the pixel below', act: on((p) => p.moveBy(0, 1)) },
  { keys: ['ArrowUp'], words: 'Inspect the pixel above', act: on((p) => p.moveBy(0, -1)) },
  { keys: ['g'], words: 'Go to a pixel by its numbers', act: focusOn('goto') },
  { keys: ['i'], words: 'Go to the inspector', act: focusOn('inspector') },
  { keys: ['1'], words: 'Side by side', act: on((p) => p.setView('side')) },
  { keys: ['2'], words: 'Slide', act: on((p) => p.setView('slide')) },
  { keys: ['3'], words: 'Blend', act: on((p) => p.setView('blend')) },
  { keys: ['4'], words: 'Toggle', act: on((p) => p.setView('toggle')) },
  { keys: ['a'], words: 'Compare: another left picture', act: on((p) => p.choose(0)) },
  { keys: ['b'], words: 'Compare: another right picture', act: on((p) => p.choose(1)) },
  { keys: [','], words: 'Slide or blend to the left', act: on((p) => p.shift(-0.05)) },
  { keys: ['.'], words: 'Slide or blend to the right', act: on((p) => p.shift(0.05)) },
  { keys: ['x'], words: 'Toggle: flip the pictures', act: on((p) => p.flip()) },
  { keys: ['y'], words: 'Toggle: blink, or stop', act: on((p) => p.blink()) },
  { keys: ['+', '='], words: 'Zoom in', act: on((p) => p.zoom(1)) },
  { keys: ['-'], words: 'Zoom out', act: on((p) => p.zoom(-1)) },
  { keys: ['0'], words: 'Show the whole picture', act: on((p) => p.fit()) },
  { keys: ['z'], words: 'Zoom to the inspected pixel', act: on((p) => p.zoomOnPixel()) },
  { keys: ['L'], words: 'Pan right', act: on((p) => p.pan(1, 0)) },
  { keys: ['H'], words: 'Pan left', act: on((p) => p.pan(-1, 0)) },
  { keys: ['J'], words: 'Pan down', act: on((p) => p.pan(0, 1)) },
  { keys: ['K'], words: 'Pan up', act: on((p) => p.pan(0, -1)) },
  { keys: ['l'], words: 'Copy a link to this view', act: pressed('copy-link') },
  { keys: ['r'], words: 'Copy the command that reproduces the cell', act: pressed('copy-command') },
  { keys: ['e'], words: 'Copy the command that explains the pixel', act: pressed('copy-explain') },
  { keys: ['s'], words: 'Save the drawing', act: pressed('save-drawing') },
  { keys: ['['], words: 'Previous cell', act: pressed('cell-before') },
  { keys: [']'], words: 'Next cell', act: pressed('cell-after') },
  { keys: ['o'], words: 'Overview', act: pressed('to-overview') },
];

const everywhereKeys = [
  { keys: ['d'], words: 'Dark or light', act: pressed('theme') },
  { keys: ['?'], words: 'This help', act: toggleHelp },
  { keys: ['Escape'], words: 'Close this help, or leave a field', act: leaveField },
];

const keyNames = { ArrowRight: '→', ArrowLeft: '←', ArrowDown: '↓', ArrowUp: '↑', Escape: 'Esc' };
const keyName = (key) =>
  keyNames[key] ?? (/^[A-Z]$/.test(key) ? `Shift ${key}` : key);

function leaveField() {
  if (found('keys').open) found('keys').close();
  else document.activeElement?.blur();
}

function keyTable(title, rows) {
  return element('section', {}, element('h3', {}, title), element('dl', { class: 'keys' },
    rows.map(({ keys, words }) => element('div', {},
      element('dt', {}, keys.map((key) => element('kbd', {}, keyName(key)))),
      element('dd', {}, words)))));
}

function toggleHelp() {
  const dialog = found('keys');
  if (dialog.open) {
    dialog.close();
    return;
  }
  dialog.replaceChildren(
    element('div', { class: 'dialog-head' }, element('h2', { id: 'keys-title' }, 'Keys'),
            button('close-keys', 'Close', () => dialog.close())),
    element('div', { class: 'key-columns', tabindex: '0', role: 'region',
                     'aria-label': 'All keys' },
            keyTable('On a cell', cellKeys), keyTable('On the overview', overviewKeys),
            keyTable('Everywhere', everywhereKeys),
            element('section', {}, element('h3', {}, 'Pointer'),
                    element('p', {}, 'Click a pixel to inspect it. Turn the wheel or pinch to ' +
                                     'zoom, drag to pan; all pictures follow.'))));
  dialog.showModal();
}

function openFirstCell() {
  const link = document.querySelector('.failure h3 a') ?? document.querySelector('.matrix td a');
  link?.click();
}

/** Moves the focus from link to link of the matrix. */
function moveInMatrix(down, right) {
  const rows = [...document.querySelectorAll('.matrix tbody tr')];
  const linkAt = (row, column) => rows[row]?.children[column]?.querySelector('a');
  const cell = document.activeElement?.closest('.matrix td');
  if (!cell) {
    document.querySelector('.matrix td a')?.focus();
    return;
  }
  let row = rows.indexOf(cell.parentElement);
  let column = cell.cellIndex;
  do {
    row += down;
    column += right;
    if (linkAt(row, column)) {
      linkAt(row, column).focus();
      return;
    }
  } while (row >= 0 && row < rows.length && column > 0 && column < rows[row].children.length);
}

const isTextField = (node) => node?.matches?.('input:not([type=range]), textarea, select');

function handleKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const field = isTextField(event.target);
  const inDialog = found('keys').open;
  const table = [...everywhereKeys, ...(inDialog ? [] : openPage ? cellKeys : overviewKeys)];
  const entry = table.find(({ keys }) => keys.includes(event.key));
  if (!entry || (field && event.key !== 'Escape')) return;
  if (event.key.startsWith('Arrow') && event.target.matches?.('input[type=range]')) return;
  event.preventDefault();
  entry.act();
}
