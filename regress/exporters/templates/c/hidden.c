/* All networks' hidden units in one table, a row an input, so that compilers add units side by side; the spread of
 * the features is folded in. */
static const float ${of}hidden_weight[${OF}INPUTS][${OF}HIDDEN] = {
$hidden_weights
};
static const float ${of}hidden_bias[${OF}HIDDEN] = {
$hidden_bias
};

/* Weight i reads ${of}first_connection[i + 1] - ${of}first_connection[i] hidden units from ${of}first_hidden[i] on. */
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

