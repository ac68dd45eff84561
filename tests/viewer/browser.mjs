// A report and the browser that opens it. What the page says on its console and asks of the
// network is kept, so that each test can insist on silence.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { scratch, shadowproof } from '../command/shadowproof.mjs';

export const size = '160x160';

/** Writes a report of the bundled scenes into a new folder of the scratch, and gives its path. */
/** Some techniques, that pages stay small: those of every failing, and auto. */
const someTechniques = ['zpass', 'zfail', 'zfail_clamp', 'zfail_infinite', 'zfail_reversed', 'auto'];

export function writeReport(name, scenes = ['near_plane', 'far_plane', 'eye_inside', 'ordinary'],
                            pixels = size, techniques = someTechniques) {
  const run = shadowproof(['verify', ...scenes, '--size', pixels, '--out', name, '-q',
                           ...(techniques ? ['--technique', techniques.join(',')] : [])]);
  assert.ok([0, 1].includes(run.code), run.out + run.err);
  return join(scratch, name);
}

export function copyOfReport(folder, name) {
  const copy = join(scratch, name);
  cpSync(folder, copy, { recursive: true });
  return copy;
}

export const resultsOf = (folder) => JSON.parse(readFileSync(join(folder, 'results.json'), 'utf8'));

/** Every cell of the results that ran, as { id, scene, cell }. */
export const cellsOf = (results) => results.scenes.flatMap((scene) =>
  (scene.techniques ?? []).filter((cell) => !cell.error)
    .map((cell) => ({ id: `${scene.folder}/${cell.name}`, scene, cell })));

let browser;
after(() => browser?.close());

/** Started once a test file; as root only without its sandbox. */
async function startedBrowser() {
  browser ??= await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: process.getuid?.() === 0 ? ['--no-sandbox'] : [],
  });
  return browser;
}

/**
 * A page without a network: { page, open(hash), said, asked }. `said` holds what came on the
 * console, `asked` the addresses that were not files.
 */
export async function openReport(folder, { hash = '', theme = 'light', width = 1280,
                                           height = 800 } = {}) {
  const context = await (await startedBrowser()).newContext({
    viewport: { width, height }, colorScheme: theme, offline: true, acceptDownloads: true });
  const page = await context.newPage();
  const said = [];
  const asked = [];
  page.on('console', (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => said.push(error.stack));
  page.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) asked.push(request.url());
  });
  const url = pathToFileURL(join(folder, 'index.html')).href;
  const open = async (to) => {
    await page.goto('about:blank');
    await page.goto(url + to);
    await shown(page);
  };
  await open(hash);
  return { page, open, said, asked, url };
}

/** Waits until the page that the address names stands. */
export async function shown(page) {
  await page.waitForFunction(() => document.querySelector('main h1') &&
    !/^Loading/.test(document.querySelector('main').lastElementChild?.textContent ?? ''));
  // Two frames: panes are painted at the next one.
  await page.evaluate(() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The link that the page keeps in its address, once it has settled. */
export async function settledLink(page) {
  let link;
  for (let before = null; link !== before || before === null;) {
    before = link ?? null;
    await page.waitForTimeout(250);
    link = await page.evaluate(() => location.hash);
  }
  return link;
}

/** Pictures for people, where somebody asked for them. */
export async function keepScreenshot(page, name, options = {}) {
  const folder = process.env.SHADOWPROOF_SCREENSHOTS;
  if (!folder) return;
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), ...options });
}

export const text = (page, selector) => page.locator(selector).innerText();

/** A page of its own for what is no report. */
export async function emptyPage() {
  const page = await (await startedBrowser()).newPage({ viewport: { width: 1180, height: 760 } });
  await page.setContent('<!doctype html><body style="margin:0"></body>');
  return page;
}
