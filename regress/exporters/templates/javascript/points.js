/* The turn and scale that lay the anchors upon the reference by least squares. Anchors in one place, but for rounding,
 * have none: NaN. */
function align() {
  let cx = 0, cy = 0, along = 0, across = 0, spread = 0;
  for (const i of anchors) {
    cx += flat[2 * i] / anchors.length;
    cy += flat[2 * i + 1] / anchors.length;
  }
  anchors.forEach((i, row) => {
    const x = flat[2 * i] - cx, y = flat[2 * i + 1] - cy, u = reference[2 * row], v = reference[2 * row + 1];
    along += x * u + y * v;
    across += x * v - y * u;
    spread += x * x + y * y;
  });
  if (!(spread > 1e-24 * (cx * cx + cy * cy))) spread = NaN;
  map[0] = map[3] = along / spread;
  map[1] = across / spread;
  map[2] = -map[1];
  return [cx, cy];
}

/* Features are the points themselves under the map, about the anchors' middle. */
function measure(points) {
  flatten(points);
  undoTurn();
  const [cx, cy] = align();
  for (let i = 0; i < featureCount; i += 2) {
    const x = flat[i] - cx, y = flat[i + 1] - cy;
    features[i] = x * map[0] + y * map[2];
    features[i + 1] = x * map[1] + y * map[3];
  }
  return features;
}

