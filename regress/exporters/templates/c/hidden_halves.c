/* Hidden units that look at the face in one table, a row an input, so that compilers add units side by side; as many
 * others look at its mirror image with the same weights. A mirror leaves the first EVEN inputs and turns the others
 * over, so what these add is subtracted there. */
#define ${OF}EVEN $even_count
#define ${OF}UNITS (${OF}HIDDEN / 2)
static const float ${of}hidden_weight[${OF}INPUTS][${OF}UNITS] = {
$hidden_weights
};
static const float ${of}hidden_bias[${OF}HIDDEN] = {
$hidden_bias
};

/* Weight i reads two runs of hidden units, from first_hidden[i] on and from UNITS + first_hidden[i] on; each is half as
 * long as first_connection[i + 1] - first_connection[i]. */
static const $place ${of}first_hidden[${GUARD}_WEIGHTS] = {
$first_hidden
};
static const $place ${of}first_connection[${GUARD}_WEIGHTS + 1] = {
$first_connection
};
static const float ${of}output_weight[${OF}CONNECTIONS] = {
$output_weights
};
static const float ${of}output_bias[${GUARD}_WEIGHTS] = {
$output_bias
};

