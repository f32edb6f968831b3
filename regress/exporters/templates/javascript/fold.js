/* Inputs are sums and differences of features that a mirror exchanges; 0 for those that it leaves where they are. */
const firstFeature = $fold_first;
const secondFeature = $fold_second;
const share = $fold_share;

