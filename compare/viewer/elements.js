// Small helpers for the page: elements, announcements, copying. Text always goes in as text, so
// that no name in a results file can become markup.

/** element('a', { href: '#', class: 'x', onclick: f }, 'text', child, [more]). */
function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? '' : value);
  }
  node.append(...children.flat(3).filter((child) => child !== null && child !== undefined));
  return node;
}

/** The same for SVG; no attribute is a listener. */
function svgElement(tag, attributes, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

const found = (id) => document.getElementById(id);

/** Announces something to screen readers only. */
function announce(text) {
  found('said').textContent = text;
}

/** A mark of a colour; the words beside it carry the meaning. */
const swatchShapes = ['square', 'disc', 'diamond', 'ring'];
const swatch = (color, shape = 'square') =>
  element('span', { class: `swatch ${shape}`, style: `--color:${color}`, 'aria-hidden': 'true' });

const alertLine = (text) => element('p', { class: 'alert', role: 'alert' }, text);

/** Rows of [term, value]; those without a value are left out. */
const facts = (rows) =>
  element('dl', { class: 'facts' }, rows
    .filter(([, value]) => value !== null && value !== undefined && value !== '')
    .map(([term, value]) => element('div', {}, element('dt', {}, term),
                                    element('dd', {}, value))));

/** Some browsers have no navigator.clipboard for pages from disk. */
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = element('textarea', { class: 'unseen', 'aria-hidden': 'true' });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
}

async function copyAndSay(text, what) {
  await copyText(text);
  announce(`Copied ${what}.`);
  const note = element('p', { class: 'toast', 'aria-hidden': 'true' }, `Copied ${what}`);
  document.body.append(note);
  setTimeout(() => note.remove(), 1600);
}

/** A command with its copy button; `id` lets a key press that button. */
function commandLine(id, label, command) {
  return element('div', { class: 'command' },
    element('p', { class: 'label', id: `${id}-label` }, label),
    element('div', { class: 'copied' },
      element('pre', { tabindex: '0', role: 'region', 'aria-labelledby': `${id}-label` },
        element('code', { id: `${id}-text` }, command)),
      element('button', { type: 'button', id, 'aria-label': `Copy: ${label}`,
                          onclick: () => copyAndSay(command, 'the command') }, 'Copy')));
}
