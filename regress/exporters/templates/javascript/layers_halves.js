  const inputs = ${prepare}();
  left.fill(0);
  turned.fill(0);
  for (let i = 0, k = 0; i < inputs.length; i++) {
    const input = inputs[i], sums = i < evenCount ? left : turned;
    for (let j = 0; j < unitCount; j++) sums[j] += hiddenWeights[k++] * input;
  }
  for (let j = 0; j < unitCount; j++) {
    hidden[j] = Math.tanh(hiddenBias[j] + left[j] + turned[j]);
    hidden[unitCount + j] = Math.tanh(hiddenBias[unitCount + j] + left[j] - turned[j]);
  }
  for (let i = 0; i < names.length; i++) {
    const own = firstConnection[i], count = (firstConnection[i + 1] - own) / 2;
    let sum = outputBias[i];
    for (let j = 0; j < count; j++) {
      const unit = firstHidden[i] + j;
      sum += outputWeights[own + j] * hidden[unit] + outputWeights[own + count + j] * hidden[unitCount + unit];
    }
    weights[i] = Math.min(Math.max(sum, 0), 1) + missing;
  }
  return weights;
}

