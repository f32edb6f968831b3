  const inputs = noiseCount ? denoised() : features;
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

