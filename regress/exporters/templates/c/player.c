
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "compile this file without -ffast-math, -Ofast or /fp:fast: they leave out how a missing point gives NaN"
#endif

int ${name}_neutral(${name}_player *player, const float points[${GUARD}_POINTS][2])
{
    double feature[CALIBRATED_FEATURES], missing = 0;
    int i, known = 0;

    for (i = 0; i < ${GUARD}_POINTS; i++)
        known = known || points[i][0] != 0 || points[i][1] != 0;
    if (known) {
        calibrated_measure(points, feature);
        for (i = 0; i < CALIBRATED_FEATURES; i++)
            missing += 0 * feature[i];
        if (missing != 0) /* NaN is not 0 */
            return 0;
        for (i = 0; i < CALIBRATED_FEATURES; i++)
            player->neutral[i] = feature[i];
    }
    player->known = known;
    return 1;
}

void ${name}_predict(const ${name}_player *player, const float points[${GUARD}_POINTS][2],
                     float weights[${GUARD}_WEIGHTS])
{
    if (player && player->known)
        calibrated_predict(points, player->neutral, weights);
    else
        alone_predict(points, weights);
}
