// What the viewer shows of a claim's evidence, by family. A family's section is a file of its own;
// a family without one shows its claim and causes alone.

/**
 * Sections by the name of the family:
 *   blocks(pixels, differing)  the lengths of its blocks in cell.js, by name; null: any
 *   pictures                   names of its pictures, after the cause map
 *   drawn(opened)              those that are drawn from blocks: [name, canvas or null]
 *   differing(page, pixel)     the inspector's elements for a pixel that differs, below its cause
 *   agreeing(page, pixel)      the same for one that does not
 */
const familySections = {
  plain: { blocks: () => ({}), pictures: [], drawn: () => [], differing: () => [],
           agreeing: () => [] },
};

/** Older reports, without families, hold counters alone. */
const familyOf = (cell) => familySections[cell.family ?? 'stencil'] ?? familySections.plain;
