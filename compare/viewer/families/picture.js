// The section of pictures that another renderer made: what would explain their wrong pixels.

/** "z-pass, which ...: explains 67,754 wrong pixels, contradicts 0" */
const diagnosisWords = ({ words, explained, contradicted }) =>
  `${words}: explains ${counted(explained, 'wrong pixel')}, contradicts ${grouped(contradicted)}`;

/** "caught, by 243 pixels: the light is moved by 1 %" */
const controlWords = ({ words, caught, wrong, why_not }) =>
  (caught ? `caught, by ${counted(wrong, 'pixel')}: ${words}` : `not caught: ${words}: ${why_not}`);

addFamily('picture', {
  explained: ({ diagnosis }) =>
    (diagnosis?.length ? [`Best explained by ${diagnosisWords(diagnosis[0])}`] : []),
  remarks: ({ diagnosis, regions, controls }) =>
    [['What would explain wrong pixels', diagnosis?.map(diagnosisWords)],
     [diagnosis?.length ? 'What the first of these leaves' : 'Where wrong pixels lie together',
      regions?.map(({ words }) => words)],
     ['Would it have been caught?', controls?.map(controlWords)]],
});
