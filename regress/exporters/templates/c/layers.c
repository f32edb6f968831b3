    ${of}denoise(feature, input);
    for (j = 0; j < ${OF}HIDDEN; j++)
        hidden[j] = ${of}hidden_bias[j];
    for (i = 0; i + 4 <= ${OF}INPUTS; i += 4) /* four at a time: a quarter of the loads and stores of hidden */
        for (j = 0; j < ${OF}HIDDEN; j++)
            hidden[j] += ${of}hidden_weight[i][j] * input[i] + ${of}hidden_weight[i + 1][j] * input[i + 1]
                       + (${of}hidden_weight[i + 2][j] * input[i + 2] + ${of}hidden_weight[i + 3][j] * input[i + 3]);
    for (; i < ${OF}INPUTS; i++)
        for (j = 0; j < ${OF}HIDDEN; j++)
            hidden[j] += ${of}hidden_weight[i][j] * input[i];
    for (j = 0; j < ${OF}HIDDEN; j++)
        hidden[j] = ${own}tangent(hidden[j]);
    for (i = 0; i < ${GUARD}_WEIGHTS; i++) {
        const int count = ${of}first_connection[i + 1] - ${of}first_connection[i];
        float sum = ${of}output_bias[i];
        for (j = 0; j < count; j++)
            sum += ${of}output_weight[${of}first_connection[i] + j] * hidden[${of}first_hidden[i] + j];
        weights[i] = (sum < 0 ? 0 : sum > 1 ? 1 : sum) + (float)missing;
    }
}
