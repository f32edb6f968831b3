  flatten(points);
  undoTurn();
  align();
  const width = alignedLength(featureCount);
  let missing = 0;
  for (let i = 0; i < featureCount; i++) {
    features[i] = alignedLength(i) / width - featureMean[i];
    missing += 0 * features[i]; // NaN as soon as one point is not finite
  }
