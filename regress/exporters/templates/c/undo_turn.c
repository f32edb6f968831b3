/* Near points move against far ones when the head turns: each is put back, as far as it stands out. */
static void ${of}undo_turn(const float points[${GUARD}_POINTS][2], double face[${GUARD}_POINTS][2])
{
    double moved[2] = {0, 0};
    int i, a;

    for (i = 0; i < ${GUARD}_POINTS; i++)
        for (a = 0; a < 2; a++)
            moved[a] += ${of}turn[i] * (double)points[i][a];
    for (i = 0; i < ${GUARD}_POINTS; i++)
        for (a = 0; a < 2; a++)
            face[i][a] = (double)points[i][a] - ${of}depth[i] * moved[a];
}

