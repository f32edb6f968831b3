/* How far each landmark of the mean face stands out, and what finds a turn of the head in a face; 0 where it is left. */
static const double ${of}depth[${GUARD}_POINTS] = {
$depth
};
static const double ${of}turn[${GUARD}_POINTS] = {
$turn
};

/* Landmarks that expressions hardly move, and where the mean face has them, about their own mean. */
static const unsigned char ${of}anchor[${OF}ANCHORS] = {
$anchors
};
static const double ${of}reference[${OF}ANCHORS][2] = {
$reference
};

${edge_table}static const double ${of}feature_mean[${OF}FEATURES] = {
$feature_mean
};

#if ${OF}NOISE_AXES
/* What features are measured along: axes in which expressions show, then those in which only noise does. Of a place
 * along the former signal / (signal + noise) is left. A face that differs from those of the training by more than they do
 * from each other counts as noisy: by the surplus of its squares. */
static const float ${of}axis[${OF}FEATURES][${OF}INPUTS + ${OF}NOISE_AXES] = {
$axes
};
static const float ${of}place_offset[${OF}INPUTS] = {
$offset
};
static const float ${of}signal_of[${OF}INPUTS] = {
$signal
};
static const float ${of}surplus_of[${OF}INPUTS] = {
$surplus
};
static const double ${of}usual = $usual, ${of}least = $least;

static void ${of}denoise(const float feature[${OF}FEATURES], float input[${OF}INPUTS])
{
    float place[${OF}INPUTS + ${OF}NOISE_AXES] = {0};
    double square = 0, surplus = -${of}usual;
    float noise;
    int i, j;

    for (i = 0; i < ${OF}FEATURES; i++)
        for (j = 0; j < ${OF}INPUTS + ${OF}NOISE_AXES; j++)
            place[j] += ${of}axis[i][j] * feature[i];
    for (j = ${OF}INPUTS; j < ${OF}INPUTS + ${OF}NOISE_AXES; j++)
        square += (double)place[j] * place[j];
    for (j = 0; j < ${OF}INPUTS; j++)
        surplus += (double)${of}surplus_of[j] * place[j] * place[j];
    square /= ${OF}NOISE_AXES;
    noise = (float)((surplus > square ? surplus : square) + ${of}least);
    for (j = 0; j < ${OF}INPUTS; j++)
        input[j] = (place[j] + ${of}place_offset[j]) * (${of}signal_of[j] / (${of}signal_of[j] + noise));
}
#else
static void ${of}denoise(const float feature[${OF}FEATURES], float input[${OF}INPUTS])
{
    int i;

    for (i = 0; i < ${OF}INPUTS; i++)
        input[i] = feature[i];
}
#endif

/* All networks' hidden units in one table, a row an input, so that compilers add units side by side; the spread of
 * the features is folded in. */
static const float ${of}hidden_weight[${OF}INPUTS][${OF}HIDDEN] = {
$hidden_weights
};
static const float ${of}hidden_bias[${OF}HIDDEN] = {
$hidden_bias
};

/* Weight i reads ${of}first_connection[i + 1] - ${of}first_connection[i] hidden units from ${of}first_hidden[i] on. */
static const unsigned short ${of}first_hidden[${GUARD}_WEIGHTS] = {
$first_hidden
};
static const unsigned short ${of}first_connection[${GUARD}_WEIGHTS + 1] = {
$first_connection
};
static const float ${of}output_weight[${OF}CONNECTIONS] = {
$output_weights
};
static const float ${of}output_bias[${GUARD}_WEIGHTS] = {
$output_bias
};

