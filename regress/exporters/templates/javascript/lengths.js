/* Linear part of the affine map that lays the anchors upon the reference by least squares, but for a factor:
 * features are ratios of lengths. Anchors on one line have no such map: NaN. */
function align() {
  map[0] = map[3] = 1;
  map[1] = map[2] = 0;
  if (!aligned) return;
  let cx = 0, cy = 0, xx = 0, xy = 0, yy = 0, xu = 0, xv = 0, yu = 0, yv = 0;
  for (const i of anchors) {
    cx += flat[2 * i] / anchors.length;
    cy += flat[2 * i + 1] / anchors.length;
  }
  anchors.forEach((i, row) => {
    const x = flat[2 * i] - cx, y = flat[2 * i + 1] - cy, u = reference[2 * row], v = reference[2 * row + 1];
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xu += x * u;
    xv += x * v;
    yu += y * u;
    yv += y * v;
  });
  const spread = xx * yy - xy * xy > 1e-12 * (xx + yy) * (xx + yy) ? xx + yy : NaN;
  map[0] = (yy * xu - xy * yu) / spread;
  map[1] = (yy * xv - xy * yv) / spread;
  map[2] = (xx * yu - xy * xu) / spread;
  map[3] = (xx * yv - xy * xv) / spread;
}

function alignedLength(edge) {
  const i = 2 * edges[2 * edge], j = 2 * edges[2 * edge + 1];
  const x = flat[j] - flat[i], y = flat[j + 1] - flat[i + 1];
  const u = x * map[0] + y * map[2], v = x * map[1] + y * map[3];
  return Math.sqrt(u * u + v * v);
}

