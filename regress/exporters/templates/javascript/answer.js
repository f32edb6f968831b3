$signature {
${measured}${layers}${inputs}/* JSON writes NaN as null, which would count as 0. */
function numberOf(value) {
  return typeof value === "number" ? value : NaN;
}

function flatten(points) {
  if (points.length === 136) {
    for (let i = 0; i < 136; i++) flat[i] = numberOf(points[i]);
  } else if (points.length === 68) {
    for (let i = 0; i < 68; i++) {
      flat[2 * i] = numberOf(points[i]?.[0]);
      flat[2 * i + 1] = numberOf(points[i]?.[1]);
    }
  } else {
    throw new RangeError("points has length " + points.length + "; 136 numbers or 68 pairs are needed");
  }
}

/* Near points move against far ones when the head turns: each is put back, as far as it stands out. */
function undoTurn() {
  let x = 0, y = 0;
  turn.forEach((weight, i) => {
    x += weight * flat[2 * i];
    y += weight * flat[2 * i + 1];
  });
  depth.forEach((far, i) => {
    flat[2 * i] -= far * x;
    flat[2 * i + 1] -= far * y;
  });
}

