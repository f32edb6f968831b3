
/* Once round the face: along the jaw from the subject's right ear, and back along the brows. */
static const unsigned char ${own}outline[] = {
$outline
};

/* Whether it is a face, and none on one line, in a mirror, or with y upward. */
static int ${own}is_face(const float points[${GUARD}_POINTS][2])
{
    const int count = (int)sizeof ${own}outline;
    double middle[2] = {0, 0}, extent = 0, area = 0, xx = 0, xy = 0, yy = 0;
    int i, a;

    for (i = 0; i < ${GUARD}_POINTS; i++)
        for (a = 0; a < 2; a++)
            middle[a] += (double)points[i][a] / ${GUARD}_POINTS;
    for (i = 0; i < ${GUARD}_POINTS; i++) {
        const double x = points[i][0] - middle[0], y = points[i][1] - middle[1];
        extent = fmax(extent, fmax(fabs(x), fabs(y)));
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    for (i = 0; i < count; i++) {
        const float *const one = points[${own}outline[i]], *const next = points[${own}outline[(i + 1) % count]];
        area += (one[0] - middle[0]) * (next[1] - middle[1]) - (one[1] - middle[1]) * (next[0] - middle[0]);
    }
    return xx * yy - xy * xy > $flat * (xx + yy) * (xx + yy) && area <= $turned * extent * extent;
}

int ${name}_neutral(${name}_player *player, const float points[${GUARD}_POINTS][2])
{
    double feature[${OWN}CALIBRATED_FEATURES], missing = 0;
    int i, known = 0;

    for (i = 0; i < ${GUARD}_POINTS; i++)
        known = known || points[i][0] != 0 || points[i][1] != 0;
    if (known) {
        ${own}calibrated_measure(points, feature);
        for (i = 0; i < ${OWN}CALIBRATED_FEATURES; i++)
            missing += 0 * feature[i];
        if (missing != 0 || !${own}is_face(points)) /* NaN is not 0 */
            return 0;
        for (i = 0; i < ${OWN}CALIBRATED_FEATURES; i++)
            player->neutral[i] = feature[i];
    }
    player->known = known;
    return 1;
}

void ${name}_predict(const ${name}_player *player, const float points[${GUARD}_POINTS][2],
                     float weights[${GUARD}_WEIGHTS])
{
    if (player && player->known)
        ${own}calibrated_predict(points, player->neutral, weights);
    else
        ${own}alone_predict(points, weights);
}
