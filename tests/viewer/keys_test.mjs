// Every action on the keyboard: the help names the keys, and each key does what the help says.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import { keepScreenshot, openReport, settledLink, shown, text, writeReport } from './browser.mjs';

let folder;
before(() => { folder = writeReport('report', ['near_plane', 'far_plane']); });

const start = '#near_plane/zpass?pixel=70,40';
const title = (page) => text(page, '.inspector h2');
const link = (page) => settledLink(page);
const focused = (page) => page.evaluate(() => document.activeElement.id);
const copied = (page) => text(page, '.toast');
const press = (page, ...keys) => keys.reduce((done, key) => done.then(() => page.keyboard.press(key)),
                                             Promise.resolve());

/** By the help's words: what the key does, from `start` on. The key itself comes from the help. */
const cellActions = {
  'Next differing pixel': async (page, key) => {
    await press(page, key);
    assert.match(await title(page), /Pixel \(71, 40\)/);
  },
  'Previous differing pixel': async (page, key) => {
    await press(page, key);
    assert.match(await title(page), /Pixel \(69, 40\)/);
  },
  'First differing pixel': async (page, key) => {
    await press(page, key);
    assert.notEqual(await title(page), 'Pixel (70, 40)');
    const first = await title(page);
    await page.locator('#first').click();
    assert.equal(await title(page), first);
  },
  'Step through the next cause only': async (page, key) => {
    await press(page, key);
    assert.match(await link(page), /cause=near_plane/);
  },
  'Inspect the pixel to the right': async (page, key) => {
    await press(page, key);
    assert.equal(await title(page), 'Pixel (71, 40)');
  },
  'Inspect the pixel to the left': async (page, key) => {
    await press(page, key);
    assert.equal(await title(page), 'Pixel (69, 40)');
  },
  'Inspect the pixel below': async (page, key) => {
    await press(page, key);
    assert.equal(await title(page), 'Pixel (70, 41)');
  },
  'Inspect the pixel above': async (page, key) => {
    await press(page, key);
    assert.equal(await title(page), 'Pixel (70, 39)');
  },
  'Go to a pixel by its numbers': async (page, key) => {
    await press(page, key);
    assert.equal(await focused(page), 'goto');
    await page.keyboard.type('12,34');
    await press(page, 'Enter');
    assert.equal(await title(page), 'Pixel (12, 34)');
  },
  'Go to the inspector': async (page, key) => {
    await press(page, key);
    assert.equal(await focused(page), 'inspector');
  },
  'Side by side': async (page, key) => {
    await page.locator('#view-blend').click();
    await press(page, key);
    assert.equal(await page.locator('canvas.pane').count(), 7);
  },
  Slide: async (page, key) => {
    await press(page, key);
    assert.match(await link(page), /view=slide/);
  },
  Blend: async (page, key) => {
    await press(page, key);
    assert.match(await link(page), /view=blend/);
  },
  Toggle: async (page, key) => {
    await press(page, key);
    assert.match(await link(page), /view=toggle/);
  },
  'Compare: another left picture': async (page, key) => {
    await page.locator('#view-slide').click();
    await press(page, key);
    assert.match(await link(page), /of=claim,claim/);
  },
  'Compare: another right picture': async (page, key) => {
    await page.locator('#view-slide').click();
    await press(page, key);
    assert.match(await link(page), /of=truth,difference/);
  },
  'Slide or blend to the left': async (page, key) => {
    await page.locator('#view-slide').click();
    await press(page, key);
    assert.match(await link(page), /at=0\.45/);
  },
  'Slide or blend to the right': async (page, key) => {
    await page.locator('#view-blend').click();
    await press(page, key);
    assert.match(await link(page), /at=0\.55/);
  },
  'Toggle: flip the pictures': async (page, key) => {
    await page.locator('#view-toggle').click();
    assert.equal(await text(page, '.stage figcaption'), 'Truth');
    await press(page, key);
    assert.equal(await text(page, '.stage figcaption'), 'Claim');
  },
  'Toggle: blink, or stop': async (page, key) => {
    await page.locator('#view-toggle').click();
    await press(page, key);
    await page.waitForFunction(() => document.querySelector('.stage figcaption').textContent === 'Claim');
    await page.waitForFunction(() => document.querySelector('.stage figcaption').textContent === 'Truth');
    await press(page, key);
    assert.equal(await text(page, '#blink'), 'Blink');
  },
  'Zoom in': async (page, key) => {
    await press(page, key, key);
    assert.match(await link(page), /zoom=3/);
  },
  'Zoom out': async (page, key) => {
    await press(page, 'z', key);
    assert.match(await link(page), /zoom=24/);
  },
  'Show the whole picture': async (page, key) => {
    await press(page, 'z', key);
    assert.doesNotMatch(await link(page), /zoom=/);
  },
  'Zoom to the inspected pixel': async (page, key) => {
    await press(page, key);
    assert.match(await link(page), /zoom=32&centre=70\.5,40\.5/);
  },
  'Pan right': (page, key) => pans(page, key, (x) => x > 70.5),
  'Pan left': (page, key) => pans(page, key, (x) => x < 70.5),
  'Pan down': (page, key) => pans(page, key, (x, y) => y > 40.5),
  'Pan up': (page, key) => pans(page, key, (x, y) => y < 40.5),
  'Copy a link to this view': async (page, key) => {
    await press(page, key);
    assert.equal(await copied(page), 'Copied the link');
  },
  'Copy the command that reproduces the cell': async (page, key) => {
    await press(page, key);
    assert.equal(await copied(page), 'Copied the command');
  },
  'Copy the command that explains the pixel': async (page, key) => {
    await press(page, key);
    assert.equal(await copied(page), 'Copied the command');
  },
  'Save the drawing': async (page, key) => {
    const saved = page.waitForEvent('download');
    await press(page, key);
    assert.equal((await saved).suggestedFilename(), 'near_plane-zpass-70-40.svg');
  },
  'Previous cell': async (page, key) => {
    await page.locator('#cell-after').click();
    await page.waitForFunction(() => !document.title.startsWith('near_plane / zpass'));
    await shown(page);
    await press(page, key);
    await page.waitForFunction(() => document.title.startsWith('near_plane / zpass'));
  },
  'Next cell': async (page, key) => {
    await press(page, key);
    await page.waitForFunction(() => document.title.startsWith('near_plane / zfail:'));
  },
  Overview: async (page, key) => {
    await press(page, key);
    await page.waitForSelector('.matrix');
  },
};

async function pans(page, key, isPanned) {
  await press(page, 'z', key);
  const [, x, y] = /centre=([\d.]+),([\d.]+)/.exec(await link(page)).map(Number);
  assert.ok(isPanned(x, y), `${x}, ${y}`);
}

const cellOfFocus = (page) => page.evaluate(() => document.activeElement.getAttribute('href'));
const movesFrom = (keys, target) => async (page, key) => {
  await press(page, 'ArrowRight', ...keys, key);
  assert.equal(await cellOfFocus(page), target);
};

const overviewActions = {
  'Find scenes, techniques and causes': async (page, key) => {
    await press(page, key);
    assert.equal(await focused(page), 'filter-find');
  },
  'Filter by cause': async (page, key) => {
    await press(page, key);
    assert.equal(await focused(page), 'filter-cause');
  },
  'Open the first cell that failed, else the first': async (page, key) => {
    await press(page, key);
    await page.waitForFunction(() => document.title.startsWith('near_plane / zpass'));
  },
  'Matrix: the next cell': movesFrom([], '#near_plane/zfail'),
  'Matrix: the cell before': movesFrom(['ArrowRight'], '#near_plane/zpass'),
  'Matrix: the scene below': movesFrom([], '#far_plane/zpass'),
  'Matrix: the scene above': movesFrom(['ArrowDown'], '#near_plane/zpass'),
};

const everywhereActions = {
  'Dark or light': async (page, key) => {
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const before = await paper();
    await press(page, key);
    assert.notEqual(await paper(), before);
    await press(page, key);
    assert.equal(await paper(), before);
  },
  'This help': async (page, key) => {
    await press(page, key);
    assert.equal(await page.locator('dialog[open]').count(), 1);
    await press(page, key);
    assert.equal(await page.locator('dialog[open]').count(), 0);
  },
  'Close this help, or leave a field': async (page, key) => {
    await press(page, '?', key);
    assert.equal(await page.locator('dialog[open]').count(), 0);
  },
};

const keysByName = { '→': 'ArrowRight', '←': 'ArrowLeft', '↓': 'ArrowDown', '↑': 'ArrowUp', Esc: 'Escape' };
const pressable = (name) => keysByName[name] ?? name.replace('Shift ', 'Shift+');

/** The help's sections: { title: [[words, [keys]]] }. */
async function helpOf(page) {
  await press(page, '?');
  await keepScreenshot(page, 'help');
  const sections = await page.locator('dialog section').evaluateAll((all) => all.map((section) => [
    section.querySelector('h3').textContent,
    [...section.querySelectorAll('dl.keys > div')].map((row) => [
      row.querySelector('dd').textContent,
      [...row.querySelectorAll('kbd')].map((key) => key.textContent)])]));
  await press(page, 'Escape');
  return Object.fromEntries(sections);
}

async function walk(page, open, hash, rows, actions) {
  assert.deepEqual(rows.map(([words]) => words).sort(), Object.keys(actions).sort());
  for (const [words, keys] of rows)
    for (const key of keys) {
      await open(hash);
      try {
        await actions[words](page, pressable(key));
      } catch (error) {
        error.message = `${key}, ${words}: ${error.message}`;
        throw error;
      }
    }
}

test('every key of the help does what the help says, on a cell', async () => {
  const { page, open, said } = await openReport(folder);
  await walk(page, open, start, (await helpOf(page))['On a cell'], cellActions);
  assert.deepEqual(said, []);
});

test('every key of the help does what the help says, on the overview and everywhere', async () => {
  const { page, open, said } = await openReport(folder);
  const help = await helpOf(page);
  await walk(page, open, '', help['On the overview'], overviewActions);
  for (const hash of ['', start]) await walk(page, open, hash, help.Everywhere, everywhereActions);
  assert.deepEqual(said, []);
});

test('what is typed into a field is no key', async () => {
  const { page } = await openReport(folder);
  await page.locator('#filter-find').fill('');
  await page.locator('#filter-find').pressSequentially('zfail?d');
  assert.equal(await page.locator('#filter-find').inputValue(), 'zfail?d');
  assert.equal(await page.locator('dialog[open]').count(), 0);
});

test('the Tab key comes to every control of a cell, and each shows that it has the focus', async () => {
  const { page } = await openReport(folder, { hash: start });
  const wanted = await page.locator('main button, main select, main input, main a').evaluateAll((all) =>
    all.filter((node) => node.checkVisibility()).length);
  const seen = new Set();
  for (let i = 0; i < wanted + 30; ++i) {
    await press(page, 'Tab');
    const at = await page.evaluate(() => {
      const node = document.activeElement;
      if (!node.closest('main') || !node.matches('button, select, input, a')) return null;
      const { outlineStyle, outlineWidth } = getComputedStyle(node);
      const index = [...document.querySelectorAll('main *')].indexOf(node);
      return { index, isOutlined: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 2 };
    });
    if (!at) continue;
    assert.ok(at.isOutlined, `element ${at.index} shows no focus`);
    seen.add(at.index);
  }
  assert.equal(seen.size, wanted);
});
