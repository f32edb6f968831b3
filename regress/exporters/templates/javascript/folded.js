function folded() {
  for (let i = 0; i < places.length; i++) places[i] = features[firstFeature[i]] + share[i] * features[secondFeature[i]];
  return places;
}

