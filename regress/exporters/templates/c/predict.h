/* Avatar weights, each within [0, 1], of one face.
 *
 * points: the 68 landmarks in iBUG order, x to the right and y down, in pixels or any other unit, anywhere in
 *     the picture. A row is (x, y). All must be finite; a face without width gives NaN.${units}
 * weights: filled in, in the order of ${name}_names.
 *
 * Keeps no state and allocates nothing, so threads may call it at once. C before C23 warns with -pedantic when
 * an array that is not const is passed: cast it, (const float (*)[2])points.
 */
void ${name}_predict(const float points[${GUARD}_POINTS][2], float weights[${GUARD}_WEIGHTS]);

