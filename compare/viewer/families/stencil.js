// The section of shadow volumes: counters, ledgers and the side view along the eye ray.

familySections.stencil = {
  blocks: (pixels, differing) => ({
    predicted: pixels, read_back: pixels, faces: pixels,
    seen: differing, shown: differing, exactness: differing, ledger: differing,
    ledger_start: null, ledger_counts: null, ledger_exact: null, ledger_predicted: null,
    crossing_face: null, crossing_change: null, crossing_status: null,
    face: null, triangle: null, vertex: null,
  }),
  pictures: ['predicted', 'read_back', 'volumes'],
  drawn: ({ predicted, readBack, width, height, bits }) =>
    [['predicted', predicted], ['read_back', readBack]].map(([name, values]) =>
      [name, values && counterPicture(values, width, height, bits)]),
  differing(page, pixel) {
    const { opened } = page;
    const record = pixelRecord(opened, pixel % opened.width, Math.floor(pixel / opened.width));
    page.record = record;
    return [
      element('div', { id: 'cutaway', class: 'scroll', tabindex: '0', role: 'region',
                       'aria-label': 'Side view along the eye ray' }),
      element('div', { class: 'ledger-head' }, element('h3', { id: 'ledger-title' }, 'Ledger'),
              button('save-drawing', 'Save the drawing', () => saveDrawing(page))),
      ledgerTable(record), counterLine(record.techniques[0], opened.bits),
      record.adds_up ? null : alertLine(
        'Rounding lost a crossing here: those listed do not add up to the exact counts.'),
      pixelFacts(record)];
  },
  agreeing({ opened: { predicted, readBack, bits } }, pixel) {
    if (!predicted || !readBack) return [alertLine('The counters cannot be shown.')];
    const equal = predicted[pixel] === readBack[pixel];
    return [
      element('p', { class: equal ? 'counter' : 'counter unequal' },
        'Stored counter: predicted ',
        element('b', { id: 'stored' }, counterWords(predicted[pixel], bits)), ', read back ',
        element('b', { id: 'read-back' }, counterWords(readBack[pixel], bits)),
        equal ? '.' : ': not what the pixel’s centre predicts.'),
      element('p', { class: 'quiet' },
              'The ledger of pixels that agree is printed by the command.')];
  },
};
