    ${of}undo_turn(points, face);
    ${of}align(face, map);
    width = ${of}aligned_length(face, map, ${OF}FEATURES);
    for (i = 0; i < ${OF}FEATURES; i++)
        feature[i] = (float)(${of}aligned_length(face, map, i) / width - ${of}feature_mean[i]);
