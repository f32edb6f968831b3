/* Where there are noise axes, features are measured along axes in which expressions show, then along those in which
 * only noise does, and of each place along the former signal / (signal + noise) is left. A face that differs from those of
 * the training by more than they do from each other counts as noisy: by the surplus of its squares. */
const axes = floats("$axes");
const noiseCount = $noise_count;
const offset = $offset;
const signal = $signal;
const surplus = $surplus;
const usual = $usual;
const least = $least;

