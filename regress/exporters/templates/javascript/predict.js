${tables}/** Avatar weights, each within [0, 1], of one face; all NaN where a landmark is missing.
 *
 * points: the 68 landmarks in iBUG order, x to the right and y down, in pixels or any other unit: 136 numbers
 * (x, y, x, y, ...) or 68 pairs. weights: filled in and given back, in the order of `names`.${units}
 */
${functions}