/* One person before one camera: what is known of the face at rest. Each has one of their own, {0} at the start, which
 * knows nothing; it may be copied and thrown away. */
typedef struct {
    int known;
    double neutral[$neutral_count];
} ${name}_player;

/* Calibrates a player to the neutral face: at rest, mouth closed, eyes open, by the detector that will be used.
 *
 * points: as below. All zeros: the player is not known any longer.
 * Gives 1; or 0 where a point is missing, that is not finite, and where points are no face: on one line, in a mirror
 * (left and right exchanged), or with y upward. The player then stays as it was.
 */
int ${name}_neutral(${name}_player *player, const float points[${GUARD}_POINTS][2]);

/* Avatar weights, each within [0, 1], of one face.
 *
 * player: who it is, after ${name}_neutral: the face is compared with the neutral one, which is far better than a
 *     face alone. NULL, or a player that knows nothing: other networks, made for a face alone, answer.
 * points: the 68 landmarks in iBUG order, x to the right and y down, anywhere in the picture. x and y have one unit:
 *     multiply shares of a picture by its width and height first. A row is (x, y). All must be finite; a face without
 *     width gives NaN. A face in a mirror, or with y upward, is not told from others here: its weights are wrong.
 * weights: filled in, in the order of ${name}_names.
 *
 * Keeps no state but the player's and allocates nothing, so threads may call it at once. Each needs $stack_kb kB of stack,
 * more than tasks of small systems often have. C before C23 warns with -pedantic when an array that is not const is
 * passed: cast it, (const float (*)[2])points.
 */
void ${name}_predict(const ${name}_player *player, const float points[${GUARD}_POINTS][2],
                     float weights[${GUARD}_WEIGHTS]);

