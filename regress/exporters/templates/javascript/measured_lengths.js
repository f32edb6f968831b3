function measure(points) {
  flatten(points);
  undoTurn();
  align();
  const width = alignedLength(featureCount);
  for (let i = 0; i < featureCount; i++) features[i] = alignedLength(i) / width;
  return features;
}

