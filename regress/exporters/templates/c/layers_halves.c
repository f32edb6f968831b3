    ${of}${prepare}(feature, input);
    for (i = 0; i < ${OF}EVEN; i += 4) /* four at a time: a quarter of the loads and stores of left */
        for (j = 0; j < ${OF}UNITS; j++)
            left[j] += ${of}hidden_weight[i][j] * input[i] + ${of}hidden_weight[i + 1][j] * input[i + 1]
                     + (${of}hidden_weight[i + 2][j] * input[i + 2] + ${of}hidden_weight[i + 3][j] * input[i + 3]);
    for (; i < ${OF}INPUTS; i += 4)
        for (j = 0; j < ${OF}UNITS; j++)
            turned[j] += ${of}hidden_weight[i][j] * input[i] + ${of}hidden_weight[i + 1][j] * input[i + 1]
                       + (${of}hidden_weight[i + 2][j] * input[i + 2] + ${of}hidden_weight[i + 3][j] * input[i + 3]);
    for (j = 0; j < ${OF}UNITS; j++) {
        hidden[j] = ${own}tangent(${of}hidden_bias[j] + left[j] + turned[j]);
        hidden[${OF}UNITS + j] = ${own}tangent(${of}hidden_bias[${OF}UNITS + j] + left[j] - turned[j]);
    }
    for (i = 0; i < ${GUARD}_WEIGHTS; i++) {
        const int count = (${of}first_connection[i + 1] - ${of}first_connection[i]) / 2;
        const float *const own = ${of}output_weight + ${of}first_connection[i], *const mirrored = own + count;
        const float *const unit = hidden + ${of}first_hidden[i];
        float sum = ${of}output_bias[i];
        for (j = 0; j < count; j++)
            sum += own[j] * unit[j] + mirrored[j] * unit[${OF}UNITS + j];
        weights[i] = (sum < 0 ? 0 : sum > 1 ? 1 : sum) + (float)missing;
    }
}
