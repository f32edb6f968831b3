/* Inputs are sums and differences of features that a mirror exchanges; 0 for those that it leaves where they are. */
static const unsigned short ${of}first_feature[${OF}INPUTS] = {
$fold_first
};
static const unsigned short ${of}second_feature[${OF}INPUTS] = {
$fold_second
};
static const float ${of}share[${OF}INPUTS] = {
$fold_share
};

static void ${of}fold(const float feature[${OF}FEATURES], float input[${OF}INPUTS])
{
    int i;

    for (i = 0; i < ${OF}INPUTS; i++)
        input[i] = feature[${of}first_feature[i]] + ${of}share[i] * feature[${of}second_feature[i]];
}

