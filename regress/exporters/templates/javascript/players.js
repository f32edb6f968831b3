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

/* Once round the face: along the jaw from the subject's right ear, and back along the brows. */
const outline = $outline;

/* Whether 136 numbers are a face, and none on one line, in a mirror, or with y upward. */
function isFace(numbers) {
  const x = numbers.filter((_, i) => i % 2 === 0), y = numbers.filter((_, i) => i % 2 === 1);
  for (const places of [x, y]) {
    const middle = places.reduce((sum, place) => sum + place / places.length, 0);
    places.forEach((place, i) => { places[i] = place - middle; });
  }
  const product = (one, other) => one.reduce((sum, value, i) => sum + value * other[i], 0);
  const xx = product(x, x), xy = product(x, y), yy = product(y, y);
  const extent = Math.max(...[...x, ...y].map(Math.abs));
  const area = outline.reduce((sum, i, place) => {
    const next = outline[(place + 1) % outline.length];
    return sum + x[i] * y[next] - y[i] * x[next];
  }, 0);
  return xx * yy - xy * xy > $flat * (xx + yy) ** 2 && area <= $turned * extent ** 2;
}

/** Avatar weights, each within [0, 1], of one face by itself; all NaN where a landmark is missing.
 *
 * points: the 68 landmarks in iBUG order, x to the right and y down: 136 numbers (x, y, x, y, ...) or 68 pairs. x and y
 * have one unit: multiply shares of a picture by its width and height first. A face in a mirror, or with y upward, is not
 * told from others: its weights are wrong. weights: filled in and given back, in the order of `names`.
 */
export function predict(points, weights = new Float32Array(names.length)) {
  return alone(points, weights);
}

/** What `predict` is, for one person before one camera: faces are compared with the neutral one, which is far better.
 *
 * neutral: the face at rest, mouth closed and eyes open, by the detector that will be used; all zeros for none, which
 * gives `predict` itself. Throws RangeError where a point of it is missing, and where its points are on one line, in a mirror
 * (left and right exchanged), or have y upward. Each player keeps a neutral face of its own.
 */
export function player(neutral) {
  const rest = calibrated.measure(neutral).slice();
  const numbers = Array.from(neutral, (value) => (typeof value === "number" ? [value] : [value?.[0], value?.[1]])).flat();
  if (numbers.length >= 136 && numbers.every((number) => number === 0)) return predict;
  if (!rest.every(Number.isFinite)) throw new RangeError("a point of the neutral face is missing");
  if (!isFace(numbers)) {
    throw new RangeError("the neutral face is no face: its points are on one line, in a mirror, or have y upward");
  }
  return (points, weights = new Float32Array(names.length)) => calibrated.answer(points, weights, rest);
}

