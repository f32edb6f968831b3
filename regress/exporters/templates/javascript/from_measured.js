  measure(points);
  let missing = 0;
  for (let i = 0; i < featureCount; i++) {
    features[i] -= ${neutral}featureMean[i];
    missing += 0 * features[i]; // NaN as soon as one point is not finite
  }
