// Links: the part of the address after # names a page, a cell, its view and pixel, so that it can
// be pasted. "#near_plane/zpass?view=slide&pixel=212,340"

function parsedRoute(hash) {
  const text = decodeURIComponent(hash.replace(/^#/, ''));
  const [path, query = ''] = text.split('?');
  return { cell: path, params: new URLSearchParams(query) };
}

/** Commas and slashes are left readable. */
function routeText(cell, params) {
  const query = Object.entries(params)
    .filter(([, value]) => value !== null && value !== undefined && value !== '')
    .map(([name, value]) => `${name}=${encodeURIComponent(value).replace(/%2C/g, ',')}`);
  return `#${cell}${query.length ? `?${query.join('&')}` : ''}`;
}

let followed = '';      // the address that is shown, as far as we know
let pendingLink = null;

/** Updates the address to what is shown. Browsers limit how often that may be done. */
function rememberLink(text) {
  clearTimeout(pendingLink);
  pendingLink = setTimeout(() => {
    // Somebody has followed a link, and its hashchange is on its way.
    if (location.hash !== followed) return;
    if (followed !== text) history.replaceState(null, '', text);
    followed = location.hash;
  }, 150);
}

/** The address that is to be shown now. What was to be remembered of the last one is dropped. */
function followedLink() {
  clearTimeout(pendingLink);
  followed = location.hash;
  return followed;
}

const pairOf = (text) => {
  const pair = (text ?? '').split(',').map(Number);
  return pair.length === 2 && pair.every(Number.isFinite) ? pair : null;
};
