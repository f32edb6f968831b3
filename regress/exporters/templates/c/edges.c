/* Ends of the edges whose lengths are measured; the last row spans the face's width. */
static const unsigned char ${of}edge[${OF}FEATURES + 1][2] = {
$edges
};
