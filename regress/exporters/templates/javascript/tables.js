${aligned}/* How far each landmark of the mean face stands out, and what finds a turn of the head in a face; 0 where it is left. */
const depth = $depth;
const turn = $turn;

/* Landmarks that expressions hardly move, and where the mean face has them, about their own mean. */
const anchors = $anchors;
const reference = $reference;

${edge_table}const featureMean = $feature_mean;
const featureCount = featureMean.length;

/* Where there are noise axes, features are measured along axes in which expressions show, then along those in which
 * only noise does, and of each place along the former signal / (signal + noise) is left. A face that differs from those of
 * the training by more than they do from each other counts as noisy: by the surplus of its squares. */
const axes = floats("$axes");
const noiseCount = $noise_count;
const offset = $offset;
const signal = $signal;
const surplus = $surplus;
const usual = $usual;
const least = $least;

/* All networks' hidden units in one table, a row an input; each weight reads one run of hidden units. */
const hiddenWeights = floats("$hidden_weights");
const hiddenBias = floats("$hidden_bias");
const firstHidden = $first_hidden;
const firstConnection = $first_connection;
const outputWeights = floats("$output_weights");
const outputBias = floats("$output_bias");
const hiddenCount = hiddenBias.length;

const flat = new Float64Array(136);
const features = new Float64Array(featureCount);
const places = new Float64Array(signal.length + noiseCount);
const hidden = new Float64Array(hiddenCount);
const map = new Float64Array(4);

