    ${of}measure(points, measured);
    for (i = 0; i < ${OF}FEATURES; i++)
        feature[i] = (float)(measured[i] - ${neutral}${of}feature_mean[i]);
