${aligned}/* How far each landmark of the mean face stands out, and what finds a turn of the head in a face; 0 where it is left. */
const depth = $depth;
const turn = $turn;

/* Landmarks that expressions hardly move, and where the mean face has them, about their own mean. */
const anchors = $anchors;
const reference = $reference;

${edge_table}const featureMean = $feature_mean;
const featureCount = featureMean.length;

${input_tables}${hidden}const flat = new Float64Array(136);
const features = new Float64Array(featureCount);
${places}const hidden = new Float64Array(hiddenCount);
${sums}const map = new Float64Array(4);

