/* Networks that see a face by itself. */
const alone = (() => {
${alone}
  return answer;
})();

/* Networks that see how a face differs from the same person's face at rest. */
const calibrated = (() => {
${calibrated}
  return { answer, measure };
})();

/** Avatar weights, each within [0, 1], of one face by itself; all NaN where a landmark is missing.
 *
 * points: the 68 landmarks in iBUG order, x to the right and y down, in pixels or any other unit: 136 numbers
 * (x, y, x, y, ...) or 68 pairs. weights: filled in and given back, in the order of `names`.
 */
export function predict(points, weights = new Float32Array(names.length)) {
  return alone(points, weights);
}

/** What `predict` is, for one person before one camera: faces are compared with the neutral one, which is far better.
 *
 * neutral: the face at rest, mouth closed and eyes open, by the detector that will be used; all zeros for none, which
 * gives `predict` itself. Throws RangeError where a point of it is missing. Each player keeps a neutral face of its own.
 */
export function player(neutral) {
  const rest = calibrated.measure(neutral).slice();
  const numbers = Array.from(neutral, (value) => (typeof value === "number" ? [value] : Array.from(value ?? [null]))).flat();
  if (numbers.length >= 136 && numbers.every((number) => number === 0)) return predict;
  if (!rest.every(Number.isFinite)) throw new RangeError("a point of the neutral face is missing");
  return (points, weights = new Float32Array(names.length)) => calibrated.answer(points, weights, rest);
}

