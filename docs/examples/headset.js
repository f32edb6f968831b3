// Weights of a headset's pictures, in a browser or in Node: onnxruntime-web or onnxruntime-node is handed in.
//
//   import * as ort from "onnxruntime-web";
//   const headset = await (await fetch("headset.json")).json();     // of `regress headset export`
//   const predict = await openHeadset(ort, headset, headset.graph); // or the graph's path, or its bytes
//   const { weights, gaze } = await predict({ left_eye, right_eye, mouth });

/**
 * A network as a function of pictures.
 *
 * pictures and neutral have a Uint8Array of height * width grey levels for each camera's name, rows from the top. A
 * camera that has no picture may be left out; neutral pictures are those of the person at rest, in the same seat.
 * Points cost time, and are given where withPoints is true: x and y in pixels, in the order of headset.points.
 */
export async function openHeadset(ort, headset, graph) {
  const session = await ort.InferenceSession.create(graph);
  const cameras = headset.cameras;

  return async function predict(pictures, neutral = null, withPoints = false) {
    check(cameras, pictures, neutral);
    const feed = {
      present: new ort.Tensor("float32", Float32Array.from(cameras, (c) => +(c.name in pictures)), [1, cameras.length]),
      calibrated: new ort.Tensor("float32", [+(neutral !== null)], [1]),
    };
    for (const { name, width, height } of cameras) {
      for (const [kind, given] of [["pictures", pictures], ["neutral", neutral ?? {}]]) {
        const grey = given[name] ?? new Uint8Array(width * height);
        feed[`${kind}_${name}`] = new ort.Tensor("uint8", grey, [1, height, width]);
      }
    }
    const traced = withPoints ? Object.keys(headset.points).filter((name) => name in pictures) : [];
    const wanted = ["weights", "deviation", "gaze", "same_seat", ...traced.map((name) => `points_${name}`)];
    const found = await session.run(feed, wanted);
    const byShape = (values) => Object.fromEntries(headset.shapes.map((shape, i) => [shape, values[i]]));
    const [leftYaw, leftPitch, rightYaw, rightPitch] = found.gaze.data; // radians, yaw to the subject's left
    return {
      weights: byShape(found.weights.data),
      deviation: byShape(found.deviation.data),
      gaze: { left: { yaw: leftYaw, pitch: leftPitch }, right: { yaw: rightYaw, pitch: rightPitch } },
      sameSeat: neutral === null ? null : found.same_seat.data[0],
      points: Object.fromEntries(traced.map((name) => [name, found[`points_${name}`].data])),
    };
  };
}

function check(cameras, pictures, neutral) {
  const names = cameras.map((camera) => camera.name);
  if (!names.some((name) => name in pictures)) throw new Error(`no picture is given of ${names.join(", ")}`);
  for (const [given, kind] of [[pictures, "picture"], [neutral ?? {}, "neutral picture"]]) {
    for (const [name, grey] of Object.entries(given)) {
      const camera = cameras.find((one) => one.name === name);
      if (!camera) throw new Error(`${name} is no camera of headset.json; it has ${names.join(", ")}`);
      const { width, height } = camera;
      if (grey.length !== width * height) {
        throw new Error(`the ${kind} of ${name} has ${grey.length} grey levels; ${width} x ${height} are needed`);
      }
    }
  }
  const lost = Object.keys(pictures).find((name) => neutral !== null && !(name in neutral));
  if (lost) throw new Error(`${lost} has no neutral picture; every camera with a picture needs one`);
}
