/* Features are the points themselves, turned and scaled as lays the anchors upon the reference by least squares, and
 * about the anchors' middle. Anchors in one place, but for rounding, have no such map: NaN. */
static void ${of}measure(const float points[${GUARD}_POINTS][2], double feature[${OF}FEATURES])
{
    double face[${GUARD}_POINTS][2], centre[2] = {0, 0}, along = 0, across = 0, spread = 0;
    int i, a;

    ${of}undo_turn(points, face);
    for (i = 0; i < ${OF}ANCHORS; i++)
        for (a = 0; a < 2; a++)
            centre[a] += face[${of}anchor[i]][a] / ${OF}ANCHORS;
    for (i = 0; i < ${OF}ANCHORS; i++) {
        const double x = face[${of}anchor[i]][0] - centre[0];
        const double y = face[${of}anchor[i]][1] - centre[1];
        along += x * ${of}reference[i][0] + y * ${of}reference[i][1];
        across += x * ${of}reference[i][1] - y * ${of}reference[i][0];
        spread += x * x + y * y;
    }
    spread = spread > 1e-24 * (centre[0] * centre[0] + centre[1] * centre[1]) ? spread : NAN;
    along /= spread;
    across /= spread;
    for (i = 0; i < ${GUARD}_POINTS; i++) {
        const double x = face[i][0] - centre[0];
        const double y = face[i][1] - centre[1];
        feature[2 * i] = along * x - across * y;
        feature[2 * i + 1] = across * x + along * y;
    }
}

