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

