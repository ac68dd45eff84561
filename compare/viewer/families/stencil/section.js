// The section of shadow volumes: counters, ledgers and the side view along the eye ray.

/** "3.1 ms and 271,004 volume fragments against zfail_reversed" */
const savingWords = ({ against, ms, volume_fragments: fragments, plan_ms: planning }) =>
  `${ms < 0 ? '−' : ''}${milliseconds(Math.abs(ms))} and ` +
  `${fragments < 0 ? '−' : ''}${grouped(Math.abs(fragments))} volume fragments a frame against ` +
  `${against}, after ${milliseconds(planning)} of planning`;

/** "1,204 to 1,210" */
const rangeWords = ({ low, high }) =>
  (low === high ? grouped(low) : `${grouped(low)} to ${grouped(high)}`);

/** What the counter read back is at a pixel that agrees. */
function agreeingCounter(opened, pixel) {
  const { predicted, readBack, bits } = countersOf(opened);
  if (!predicted || !readBack) return alertLine('The counters cannot be shown.');
  const equal = predicted[pixel] === readBack[pixel];
  return element('p', { class: equal ? 'counter' : 'counter unequal' },
    'Stored counter: predicted ',
    element('b', { id: 'stored' }, counterWords(predicted[pixel], bits)), ', read back ',
    element('b', { id: 'read-back' }, counterWords(readBack[pixel], bits)),
    equal ? '.' : ': not what the pixel’s centre predicts.');
}

addFamily('stencil', {
  sceneBlocks: (pixels) => ({ seen: pixels, exactness: pixels }),
  blocks: (pixels, differing) => ({
    predicted: pixels, read_back: pixels, faces: pixels,
    shown: differing, ledger: differing,
    ledger_counts: null, ledger_exact: null, ledger_predicted: null, crossing: null,
    face: null, triangle: null, vertex: null,
  }),
  pictures: { predicted: 'Counter predicted', read_back: 'Counter read back', volumes: 'Volumes' },
  drawn(opened) {
    const { predicted, readBack, faces, bits } = countersOf(opened);
    const { claim, width, height } = opened;
    return [...[['predicted', predicted], ['read_back', readBack]].map(([name, values]) =>
      [name, values && counterPicture(values, width, height, bits), name]),
      ['volumes', faces && claim && volumePicture(faces, claim, width, height),
       claim ? 'faces' : 'claim']];
  },
  word(opened, name, pixel) {
    const { predicted, readBack, faces } = countersOf(opened);
    const values = { predicted, read_back: readBack, volumes: faces }[name];
    return values ? String(values[pixel]) : '';
  },
  color(opened, name, pixel) {
    const { predicted, readBack, faces, bits } = countersOf(opened);
    if (name === 'volumes') return faces[pixel] > 2 ? [255, 192, 64] : [40, 40, 44];
    return counterColor(asCount((name === 'predicted' ? predicted : readBack)[pixel], bits));
  },
  legends: (opened) =>
    [legendTable('Counter', ['Value', 'Predicted', 'Read back'], counterRows(opened))],
  faults: ({ ledger, volumes }) => [
    ledger.unexplained > 0 && 'The counter read back is not the one predicted at ' +
                              counted(ledger.unexplained, 'pixel'),
    volumes.words && `Not as predicted: ${volumes.words}`],
  alarms: ({ ledger, volumes }) => [
    ledger.unexplained > 0 &&
      'The counter read back is not the one predicted, nor any in the band, or no rasterizer ' +
      `would show that triangle at that depth, at ${counted(ledger.unexplained, 'pixel')}.`,
    volumes.words && `Nothing that the volumes’ faces make: ${volumes.words}.`],
  facts: (cell) => [
    ['Volume fragments', grouped(cell.volume_fragments)],
    ['Predicted', rangeWords(cell.volumes.fragments)],
    ['Saved', cell.saved && savingWords(cell.saved)]],
  differing(page, pixel) {
    const { opened } = page;
    const record = pixelRecord(opened, pixel % opened.width, Math.floor(pixel / opened.width));
    page.record = record;
    return [
      element('div', { id: 'cutaway', class: 'scroll', tabindex: '0', role: 'region',
                       'aria-label': 'Side view along the eye ray' }),
      element('div', { class: 'ledger-head' }, element('h3', { id: 'ledger-title' }, 'Ledger'),
              button('save-drawing', 'Save the drawing', () => saveDrawing(page))),
      ledgerTable(record), counterLine(record.techniques[0], countersOf(opened).bits),
      record.adds_up ? null : alertLine(
        'Rounding lost a crossing here: those listed do not add up to the exact counts.'),
      pixelFacts(record)];
  },
  agreeing: ({ opened }, pixel) => [
    agreeingCounter(opened, pixel),
    element('p', { class: 'quiet' },
            'The ledger of pixels that agree is printed by the command.')],
  shown: drawCutaway,
});
