// The section of pictures that somebody's renderer made: what would explain their wrong pixels.

/** "z-pass, which ...: explains 67,754 wrong pixels, contradicts 0" */
const diagnosisWords = ({ words, explained, contradicted }) =>
  `${words}: explains ${counted(explained, 'wrong pixel')}, contradicts ${grouped(contradicted)}`;

addFamily('picture', {
  explained: ({ diagnosis }) =>
    (diagnosis?.length ? [`Best explained by ${diagnosisWords(diagnosis[0])}`] : []),
  remarks: ({ diagnosis }) =>
    [['What would explain wrong pixels', diagnosis?.map(diagnosisWords)]],
});
