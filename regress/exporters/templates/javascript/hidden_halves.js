/* Hidden units that look at the face in one table, a row an input; as many others look at its mirror image with the same
 * weights. A mirror leaves the first inputs and turns the others over, so what these add is subtracted there. Each weight
 * reads two runs of hidden units, one of either kind. */
const evenCount = $even_count;
const hiddenWeights = floats("$hidden_weights");
const hiddenBias = floats("$hidden_bias");
const firstHidden = $first_hidden;
const firstConnection = $first_connection;
const outputWeights = floats("$output_weights");
const outputBias = floats("$output_bias");
const hiddenCount = hiddenBias.length;
const unitCount = hiddenCount / 2;

