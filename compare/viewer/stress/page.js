// The page of stress: for each parameter of a scene the charts, and a table whose entries lead to
// pictures.

const state = { run: null, scene: null, technique: 'all' };

const isDark = () => {
  const theme = document.documentElement.dataset.theme;
  return theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
};

const chartWidth = () => Math.max(760, Math.min(1300, document.documentElement.clientWidth - 70));

const hasFailed = (point) =>
  Boolean(point.refused) || wrongPixels(point) > 0 || point.verdict === 'unexplained';

/** "refused", or what it was lost by: "crashed", "timed out". */
const refusal = ({ loss }) => (loss ?? 'refused').replaceAll('_', ' ');

const shareOf = (point) => ({ value: point.value, share: percent(wrongPixels(point), point) });

/** A parameter's entries of the chosen scene. */
const pointsAlong = (parameter) => state.run.points.filter((point) =>
  point.scene === state.scene.name && point.parameter === parameter.name);

const breaksOf = (technique, parameter) => state.run.breaking
  .filter((each) => each.scene === state.scene.name && each.parameter === parameter.name &&
                    each.technique === technique && each.measured !== null)
  .map(({ measured }) => measured);

const derivedOf = (technique, parameter) => state.run.breaking
  .filter((each) => each.scene === state.scene.name && each.parameter === parameter.name &&
                    each.technique === technique && each.derived !== null)
  .map(({ derived }) => derived);

const techniquesOf = (points) =>
  [...new Set(points.map(({ technique }) => technique))].filter((name) => name !== 'truth');

/** A line for each technique that is wrong somewhere; of one technique, for each of its causes. */
function wrongSeries(points, parameter) {
  const drawn = points.filter((point) => !point.refused && point.technique !== 'truth');
  if (state.technique === 'all')
    return techniquesOf(drawn).map((technique) => {
      const own = drawn.filter((point) => point.technique === technique);
      return { name: technique, group: groupOf(own[0]), points: own.map(shareOf),
               breaks: breaksOf(technique, parameter),
               derived: derivedOf(technique, parameter) };
    }).filter(({ points: all, derived }) =>
      derived.length > 0 || all.some(({ share }) => share > 0));
  const own = drawn.filter((point) => point.technique === state.technique);
  const causes = [...new Set(own.flatMap((point) => Object.keys(point.causes)))]
    .filter((cause) => cause !== 'edge');
  return causes.map((cause, i) => ({ name: cause, group: markGroups[(i + 1) % markGroups.length],
    points: own.map((point) => ({ value: point.value,
                                  share: percent(point.causes[cause] ?? 0, point) })),
    breaks: i === 0 ? breaksOf(state.technique, parameter) : [],
    derived: i === 0 ? derivedOf(state.technique, parameter) : [] }));
}

function chosenStory(point) {
  if (point.refused)
    return [element('h3', {}, `${point.technique}: ${refusal(point)}`), element('p', {}, point.refused)];
  const what = `${point.technique} at ${point.parameter}=${valueWords(point.value)}`;
  return [
    element('h3', {}, what),
    facts([['Error', errorWords(point)], ['Verdict', point.verdict.replaceAll('_', ' ')],
           ['Frame', milliseconds(point.ms.median)],
           ['Frame, judgement and report', milliseconds(point.judging_ms)]]),
    ...(point.pictures ? [element('p', {}, element('a', { class: 'pictures', href: point.pictures },
      'Its pictures, and why pixels are wrong'))] : []),
    commandLine(`again-${point.parameter}`, 'Shows it again', point.command)];
}

/** Truth at a value, in words. */
function truthWords(point) {
  if (point.refused) return point.refused;
  const { asked, undecided, disagreements } = point.witness;
  const { tried, changed, ties } = point.relations;
  return `${counted(point.triangles, 'triangle')}, truth in ${milliseconds(point.ms.median)}, ` +
    `${counted(point.exact_decisions, 'exact decision')}; the witness decided ` +
    `${counted(asked, 'pixel')} again, ${grouped(undecided)} of them undecided by filters: ` +
    (disagreements === 0 ? 'all agree' : `${grouped(disagreements)} disagree`) +
    `; told otherwise in ${counted(tried.length, 'way')}, ` +
    (changed === 0 ? 'it stays the same' : `${counted(changed, 'pixel')} changed`) +
    (ties === 0 ? '' : ` (and ${counted(ties, 'tie')})`);
}

function matrix(points, parameter, story) {
  const values = points.filter(({ technique }) => technique === 'truth');
  const entry = (point) => {
    const wrong = point.refused ? refusal(point) : grouped(wrongPixels(point));
    const verdict = point.verdict === 'unexplained' ? 'unexplained'
      : hasFailed(point) ? 'fails' : 'holds';
    const words = point.refused ? refusal(point) : errorWords(point);
    const button = element('button', { type: 'button', 'data-verdict': verdict, title: words,
      'aria-pressed': 'false',
      onclick: () => {
        for (const other of story.parentElement.querySelectorAll('button[aria-pressed]'))
          other.setAttribute('aria-pressed', String(other === button));
        story.replaceChildren(...chosenStory(point));
      } }, wrong);
    return button;
  };
  return element('div', { class: 'scroll', tabindex: '0', role: 'region',
                          'aria-label': `Every technique along ${parameter.name}` },
    element('table', { class: 'matrix' },
      element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'Wrong pixels at'),
        values.map((truth) => element('th', { scope: 'col', class: truth.own ? 'own' : null,
                                              title: truthWords(truth) }, valueWords(truth.value))))),
      element('tbody', {}, techniquesOf(points).map((technique) => element('tr', {},
        element('th', { scope: 'row' }, technique),
        values.map((truth) => {
          const point = points.find((each) =>
            each.technique === technique && each.value === truth.value);
          return element('td', {}, point ? entry(point) : '');
        }))))));
}

function breakingTable(parameter) {
  const broken = state.run.breaking.filter((each) => each.scene === state.scene.name &&
    each.parameter === parameter.name && (each.measured !== null || each.derived !== null));
  if (broken.length === 0) return element('p', {}, 'No technique that is right on the scene as it is breaks along this parameter.');
  return element('table', { class: 'numbers' },
    element('thead', {}, element('tr', {}, ['Technique', 'Holds at', 'Breaks at', 'Derived', 'Cause']
      .map((head) => element('th', { scope: 'col' }, head)))),
    element('tbody', {}, broken.map((each) => element('tr', {},
      element('th', { scope: 'row' }, each.technique), element('td', {}, valueWords(each.holds)),
      element('td', {}, each.measured === null ? 'never' : valueWords(each.measured)),
      element('td', {}, each.derived === null ? '' : valueWords(each.derived)),
      element('td', {}, each.cause ?? '')))));
}

function parameterSection(parameter) {
  const points = pointsAlong(parameter);
  const truths = points.filter(({ technique, refused }) => technique === 'truth' && !refused);
  const values = truths.map(({ value }) => value);
  const own = points.find((point) => point.own);
  const ink = isDark() ? darkInk : lightInk;
  const series = wrongSeries(points, parameter);
  const story = element('section', { 'aria-live': 'polite', class: 'story',
                                     'aria-label': `Chosen along ${parameter.name}` });
  const frame = (label, chart) => element('div', { class: 'chart', tabindex: '0', role: 'region',
                                                   'aria-label': label }, chart);
  const title = state.technique === 'all' ? 'Wrong pixels'
    : `Wrong pixels of ${state.technique}, by cause`;
  return element('section', { id: parameter.name, class: 'parameter' },
    element('h2', {}, parameter.name), element('p', {}, parameter.words),
    breakingTable(parameter),
    parameter.wrong_before.length > 0 ? element('p', { class: 'quiet' },
      `Wrong on the scene as it is: ${parameter.wrong_before.join(', ')}.`) : null,
    ...points.filter((point) => point.own && point.refused)
      .map((point) => alertLine(`${refusal(point)} on the scene as it is: ${point.refused}`)),
    series.length > 0 ? frame(`${title} along ${parameter.name}`,
                              shareChart(title, series, values, own.value, ink, chartWidth()))
      : null,
    frame(`What the truth costs along ${parameter.name}`,
          shareChart('What the truth costs', truthSeries(truths), values, own.value, ink,
                     chartWidth())),
    element('details', {}, element('summary', {}, 'Every technique at every value'),
      element('p', { class: 'quiet' }, 'An entry leads to its pictures. ' +
              'The scene’s own value is underlined.'),
      matrix(points, parameter, story), story));
}

function drawParameters() {
  found('parameters').replaceChildren(...state.scene.parameters.map(parameterSection));
}

function choice(id, label, options, chosen, choose) {
  return element('label', {}, `${label} `, element('select', {
    id, onchange: (event) => { choose(event.target.value); },
  }, options.map(([value, text]) =>
    element('option', { value, selected: value === chosen }, text))));
}

function showScene(name) {
  const { run } = state;
  state.scene = run.scenes.find((scene) => scene.name === name);
  const scenes = run.scenes.filter(({ error }) => !error);
  const techniques = techniquesOf(run.points.filter(({ scene }) => scene === name));
  if (!techniques.includes(state.technique)) state.technique = 'all';
  const { file, light, width, height, triangles, left_out: leftOut } = state.scene;
  found('main').replaceChildren(
    element('h1', {}, `${name} under stress`),
    ...run.scenes.filter(({ error }) => error).map(({ error }) => alertLine(error)),
    element('p', {}, 'Where each technique starts to fail as the scene becomes extreme, one ' +
      'parameter at a time. The truth is decided again by a second exact tracer at some pixels of ' +
      'every point, and traced again where the scene is only told otherwise.'),
    element('div', { class: 'toolbar' },
      choice('scene', 'Scene', scenes.map((each) => [each.name, each.name]), name, showScene),
      choice('technique', 'Technique',
             [['all', 'all'], ...techniques.map((each) => [each, each])], state.technique,
             (technique) => { state.technique = technique; drawParameters(); })),
    facts([['File', file], ['Light', light], ['Size', `${width}x${height}`],
           ['Triangles', grouped(triangles)],
           ['Does not suit', leftOut.join(', ')]]),
    element('nav', { 'aria-label': 'Parameters' }, element('p', {}, state.scene.parameters
      .flatMap((each) => [element('a', { href: `#${each.name}` }, each.name), ' ']))),
    element('div', { id: 'parameters' }),
    element('h2', {}, 'Made by'),
    facts([['shadowproof', run.version], ['Driver', `${run.gl.renderer}, ${run.gl.version}`],
           ['Embree', run.embree], ['Flags', run.arguments.join(' ')]]));
  drawParameters();
}

window.shadowproofStress = (run) => {
  state.run = run;
  const first = run.scenes.find(({ error }) => !error);
  if (first) showScene(first.name);
  else
    found('main').replaceChildren(element('h1', {}, 'No scene could be read'),
      ...run.scenes.map(({ error }) => alertLine(error)));
};
found('theme').addEventListener('click', () => {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  if (state.scene) drawParameters();
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  if (state.scene) drawParameters();
});
window.addEventListener('beforeprint', () => {
  document.documentElement.dataset.theme = 'light';
  if (state.scene) drawParameters();
});
