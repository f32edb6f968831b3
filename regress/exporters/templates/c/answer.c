$signature
{
    double $scratch, missing = 0;
    float feature[${OF}FEATURES], input[${OF}INPUTS], hidden[${OF}HIDDEN]${sums};
    int i, j;

$measured
    for (i = 0; i < ${OF}FEATURES; i++)
        missing += 0 * (double)feature[i]; /* NaN as soon as one point is not finite */
${layers}