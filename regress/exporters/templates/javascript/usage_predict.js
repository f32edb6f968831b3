 *     import { names, predict } from "./$name.js";
 *     const weights = predict(points); // points: 136 numbers, x y x y ..., or 68 pairs
