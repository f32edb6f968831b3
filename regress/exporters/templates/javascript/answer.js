$signature {
${measured}  const inputs = noiseCount ? denoised() : features;
  hidden.set(hiddenBias);
  for (let i = 0, k = 0; i < inputs.length; i++) {
    const input = inputs[i];
    for (let j = 0; j < hiddenCount; j++) hidden[j] += hiddenWeights[k++] * input;
  }
  for (let j = 0; j < hiddenCount; j++) hidden[j] = Math.tanh(hidden[j]);
  for (let i = 0; i < names.length; i++) {
    let sum = outputBias[i];
    for (let j = firstHidden[i], k = firstConnection[i]; k < firstConnection[i + 1]; j++, k++) {
      sum += outputWeights[k] * hidden[j];
    }
    weights[i] = Math.min(Math.max(sum, 0), 1) + missing;
  }
  return weights;
}

function denoised() {
  const count = signal.length;
  let noise = 0, excess = -usual;
  for (let j = 0, k = 0; j < places.length; j++) {
    places[j] = 0;
    for (let i = 0; i < featureCount; i++) places[j] += axes[k++] * features[i];
    if (j < count) excess += surplus[j] * places[j] * places[j];
    else noise += (places[j] * places[j]) / noiseCount;
  }
  noise = Math.max(noise, excess) + least;
  for (let j = 0; j < count; j++) places[j] = ((places[j] + offset[j]) * signal[j]) / (signal[j] + noise);
  return places.subarray(0, count);
}

function flatten(points) {
  if (points.length === 136) {
    for (let i = 0; i < 136; i++) flat[i] = points[i];
  } else if (points.length === 68) {
    for (let i = 0; i < 68; i++) {
      flat[2 * i] = points[i][0];
      flat[2 * i + 1] = points[i][1];
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

