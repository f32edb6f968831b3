
/** What `predict` is, for one person before one camera: faces are compared with the neutral one, which is far better.
 *
 * @param neutral the face at rest, mouth closed and eyes open, by the detector that will be used, points as `predict`
 * takes them; all zeros for none, which gives `predict` itself. Each player keeps a neutral face of its own
 * @throws RangeError where a point of the neutral face is missing, and where its points are on one line, in a mirror
 * (left and right exchanged), or have y upward
 */
export declare function player(
  neutral: ArrayLike<number> | ArrayLike<ArrayLike<number>>,
): (points: ArrayLike<number> | ArrayLike<ArrayLike<number>>, weights?: Float32Array) => Float32Array;
