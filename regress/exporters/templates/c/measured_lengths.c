static void ${of}measure(const float points[${GUARD}_POINTS][2], double feature[${OF}FEATURES])
{
    double face[${GUARD}_POINTS][2], map[2][2], width;
    int i;

    ${of}undo_turn(points, face);
    ${of}align(face, map);
    width = ${of}aligned_length(face, map, ${OF}FEATURES);
    for (i = 0; i < ${OF}FEATURES; i++)
        feature[i] = ${of}aligned_length(face, map, i) / width;
}

