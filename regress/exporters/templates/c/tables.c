/* How far each landmark of the mean face stands out, and what finds a turn of the head in a face; 0 where it is left. */
static const double ${of}depth[${GUARD}_POINTS] = {
$depth
};
static const double ${of}turn[${GUARD}_POINTS] = {
$turn
};

/* Landmarks that expressions hardly move, and where the mean face has them, about their own mean. */
static const unsigned char ${of}anchor[${OF}ANCHORS] = {
$anchors
};
static const double ${of}reference[${OF}ANCHORS][2] = {
$reference
};

${edge_table}static const double ${of}feature_mean[${OF}FEATURES] = {
$feature_mean
};

${inputs}${hidden}