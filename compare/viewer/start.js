// Shows the page that the address names, and follows it.

function storedTheme() {
  try {
    return localStorage.getItem('shadowproof-theme');
  } catch {
    return null; // a browser may forbid it for pages from disk
  }
}

function setTheme(theme) {
  if (theme) document.documentElement.dataset.theme = theme;
  try {
    if (theme) localStorage.setItem('shadowproof-theme', theme);
  } catch {
    // kept for this page only
  }
}

function switchTheme() {
  const now = document.documentElement.dataset.theme ??
    (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
  setTheme(now === 'dark' ? 'light' : 'dark');
  announce(now === 'dark' ? 'Light' : 'Dark');
}

/** The cell that an address names: { scene, cell }, or null. */
function cellOf(results, path) {
  const [folder, technique] = path.split('/');
  const scene = results.scenes.find((each) => each.folder === folder);
  const cell = scene?.techniques?.find((each) => each.name === technique);
  return cell ? { scene, cell } : null;
}

async function follow(results) {
  leaveCell();
  const { cell: path, params } = parsedRoute(followedLink());
  const target = path ? cellOf(results, path) : null;
  scrollTo(0, 0);
  if (target) {
    await showCell(results, target.scene, target.cell, params);
    return;
  }
  if (path === 'terms') {
    showTerms(results, params);
    return;
  }
  showOverview(results, params);
  if (path && path !== 'main')
    found('main').prepend(alertLine(`This report has no cell “${path}”.`));
}

function sayUnreadable() {
  document.title = 'shadowproof: damaged report';
  found('main').replaceChildren(element('h1', {}, 'This report cannot be shown'), alertLine(
    typeof DecompressionStream === 'undefined'
      ? 'This browser is too old to unpack it: use one of 2023 or later.'
      : 'results.js, which lies beside index.html, is missing or damaged. Make the report again.'));
}

async function start() {
  setTheme(storedTheme());
  found('theme').addEventListener('click', switchTheme);
  found('help').addEventListener('click', toggleHelp);
  document.querySelector('.skip').addEventListener('click', (event) => {
    event.preventDefault();
    found('main').focus();
  });
  found('main').replaceChildren(element('p', { class: 'quiet' }, 'Reading the results …'));
  let results;
  try {
    results = await unpackedResults();
  } catch {
    sayUnreadable();
    return;
  }
  document.addEventListener('keydown', handleKey);
  found('version').textContent = results.version;
  addEventListener('hashchange', () => follow(results));
  follow(results);
}

document.addEventListener('DOMContentLoaded', start);
