/* Weights of faces on standard input: a line of 136 numbers (x y x y ...) in, 52 lines "name weight" out.
 * The first line is the person's neutral face, or 136 zeros where it is not known.
 *
 *     regress export models/default --format c --out .
 *     cc -std=c99 -O2 main.c face.c -lm -o weights
 *     ./weights < points.txt
 */
#include <stdio.h>
#include "face.h"

static int read_face(float points[FACE_POINTS][2]) {
    for (int i = 0; i < FACE_POINTS; i++)
        if (scanf("%f %f", &points[i][0], &points[i][1]) != 2) return 0;
    return 1;
}

int main(void) {
    static float points[FACE_POINTS][2], weights[FACE_WEIGHTS];
    face_player player = {0}; /* one for each person */
    if (!read_face(points) || !face_neutral(&player, (const float (*)[2])points)) {
        fputs("the first line must be a whole face, or 136 zeros\n", stderr);
        return 1;
    }
    while (read_face(points)) {
        face_predict(&player, (const float (*)[2])points, weights);
        for (int i = 0; i < FACE_WEIGHTS; i++) printf("%s %.6f\n", face_names[i], weights[i]);
    }
    return 0;
}
