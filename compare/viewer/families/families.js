// What the viewer shows of a claim's evidence, by family. A family's section is a file of its own;
// a family without one shows its claim and causes alone.

/** The defaults of a section. */
const plainSection = {
  /** The lengths of the blocks that it needs of scene.js, by name. */
  sceneBlocks: (pixels) => ({}),
  /** The same of its blocks in cell.js; null: any. */
  blocks: (pixels, differing) => ({}),
  /** Titles of its pictures by their names, shown after the cause map. */
  pictures: {},
  /** The same, drawn: [name, canvas or null, the block that is drawn]. */
  drawn: (opened) => [],
  /** What one of its pictures says at a pixel, as a word that fits into it. */
  word: (opened, name, pixel) => '',
  /** The colour that one of its pictures has at a pixel: [red, green, blue]. */
  color: (opened, name, pixel) => [40, 40, 44],
  /** Tables below the pictures. */
  legends: (opened) => [],
  /** What of the evidence is not as predicted: clauses for the cell's reason, and alarms. */
  faults: (cell) => [],
  alarms: (cell) => [],
  /** What else explains the cell, as clauses. */
  explained: (cell) => [],
  /** How the cell was made: [name, value]; and lists, [title, items]. */
  facts: (cell) => [],
  remarks: (cell) => [],
  /** The inspector's elements for a pixel that differs, below its cause, and for another one. */
  differing: (page, pixel) => [],
  agreeing: (page, pixel) => [],
  /** Called when these are in the page, and when its width changes. */
  shown: (page) => {},
};

const familySections = new Map();

/** Adds the section of the family of that name. */
function addFamily(name, section) {
  familySections.set(name, { ...plainSection, ...section });
}

const familyOf = (cell) => familySections.get(cell.family) ?? plainSection;
