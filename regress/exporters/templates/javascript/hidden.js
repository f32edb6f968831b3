/* All networks' hidden units in one table, a row an input; each weight reads one run of hidden units. */
const hiddenWeights = floats("$hidden_weights");
const hiddenBias = floats("$hidden_bias");
const firstHidden = $first_hidden;
const firstConnection = $first_connection;
const outputWeights = floats("$output_weights");
const outputBias = floats("$output_bias");
const hiddenCount = hiddenBias.length;

