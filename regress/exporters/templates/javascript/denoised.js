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

