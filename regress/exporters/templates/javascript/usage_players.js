 *     import { names, player, predict } from "./$name.js";
 *     const answer = player(neutral); // one for each person: the face at rest
 *     const weights = answer(points); // points: 136 numbers, x y x y ..., or 68 pairs; predict(points) without neutral
