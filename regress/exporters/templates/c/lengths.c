/* Linear part of the affine map that lays the anchors upon the reference by least squares, but for a factor:
 * features are ratios of lengths, so the determinant and the translation drop out. Anchors on one line have no such
 * map: NaN. */
static void ${of}align(double points[${GUARD}_POINTS][2], double map[2][2])
{
    double centre[2] = {0, 0}, moment[2][2] = {{0, 0}, {0, 0}}, cross[2][2] = {{0, 0}, {0, 0}};
    double spread, determinant;
    int i, a, b;

    if (!${OF}ALIGNED) {
        map[0][0] = map[1][1] = 1;
        map[0][1] = map[1][0] = 0;
        return;
    }
    for (i = 0; i < ${OF}ANCHORS; i++)
        for (a = 0; a < 2; a++)
            centre[a] += points[${of}anchor[i]][a] / ${OF}ANCHORS;
    for (i = 0; i < ${OF}ANCHORS; i++)
        for (a = 0; a < 2; a++) {
            const double offset = points[${of}anchor[i]][a] - centre[a];
            for (b = 0; b < 2; b++) {
                moment[a][b] += offset * (points[${of}anchor[i]][b] - centre[b]);
                cross[a][b] += offset * ${of}reference[i][b];
            }
        }
    determinant = moment[0][0] * moment[1][1] - moment[0][1] * moment[1][0];
    spread = moment[0][0] + moment[1][1]; /* keeps the numbers near one, whatever the unit */
    if (!(determinant > 1e-12 * spread * spread))
        spread = NAN;
    for (b = 0; b < 2; b++) {
        map[0][b] = (moment[1][1] * cross[0][b] - moment[0][1] * cross[1][b]) / spread;
        map[1][b] = (moment[0][0] * cross[1][b] - moment[1][0] * cross[0][b]) / spread;
    }
}

static double ${of}aligned_length(double points[${GUARD}_POINTS][2], double map[2][2], int i)
{
    const double x = points[${of}edge[i][1]][0] - points[${of}edge[i][0]][0];
    const double y = points[${of}edge[i][1]][1] - points[${of}edge[i][0]][1];
    const double u = x * map[0][0] + y * map[1][0];
    const double v = x * map[0][1] + y * map[1][1];

    return sqrt(u * u + v * v);
}

