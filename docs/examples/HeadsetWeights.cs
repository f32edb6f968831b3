using System;
using System.Collections.Generic;
using System.Linq;
using Microsoft.ML.OnnxRuntime;
using Microsoft.ML.OnnxRuntime.Tensors;

// Weights of a headset's pictures by the NuGet package Microsoft.ML.OnnxRuntime, which Unity and .NET load alike.
// `regress headset export models/headset` makes headset.onnx; names and sizes are in headset.json beside it.
public sealed class HeadsetWeights : IDisposable
{
    // One of "cameras" in headset.json, in its order.
    public sealed class Camera
    {
        public readonly string Name;
        public readonly int Width, Height;

        public Camera(string name, int width, int height)
        {
            Name = name;
            Width = width;
            Height = height;
        }
    }

    // Weights have the order of "shapes" in headset.json. Gaze is yaw and pitch of the left eye, then of the right one,
    // in radians, yaw to the subject's left. SameSeat below .5: the headset has moved since the neutral pictures; NaN
    // without such pictures.
    public sealed class Answer
    {
        public float[] Weights, Gaze;
        public float SameSeat;
    }

    static readonly string[] outputs = { "weights", "gaze", "same_seat" };

    readonly InferenceSession session;
    readonly Camera[] cameras;

    public HeadsetWeights(string graph, params Camera[] cameras)
    {
        this.cameras = cameras;
        using (var options = new SessionOptions { IntraOpNumThreads = 1 })
            session = new InferenceSession(graph, options);
    }

    // The bytes of headset.onnx, where no path leads to it, as in an Android package.
    public HeadsetWeights(byte[] graph, params Camera[] cameras)
    {
        this.cameras = cameras;
        using (var options = new SessionOptions { IntraOpNumThreads = 1 })
            session = new InferenceSession(graph, options);
    }

    // Grey pictures by camera, laid and levelled as docs/your-camera.md says ("In another program"), rows from the top;
    // a camera that is missing is left out, but one is needed. Neutral pictures may be null.
    public Answer Predict(
        IReadOnlyDictionary<string, byte[]> pictures, IReadOnlyDictionary<string, byte[]> neutral = null)
    {
        if (pictures.Count == 0)
            throw new ArgumentException(
                "no picture is given of " + string.Join(", ", cameras.Select(camera => camera.Name)));
        foreach (var name in pictures.Keys)
            if (cameras.All(camera => camera.Name != name) || (neutral != null && !neutral.ContainsKey(name)))
                throw new ArgumentException(name + " is no camera of the headset, or has no neutral picture");
        var present = cameras.Select(camera => pictures.ContainsKey(camera.Name) ? 1f : 0f).ToArray();
        var calibrated = new[] { neutral == null ? 0f : 1f };
        var inputs = new List<NamedOnnxValue>
        {
            NamedOnnxValue.CreateFromTensor("present", new DenseTensor<float>(present, new[] { 1, cameras.Length })),
            NamedOnnxValue.CreateFromTensor("calibrated", new DenseTensor<float>(calibrated, new[] { 1 })),
        };
        foreach (var camera in cameras)
        {
            inputs.Add(NamedOnnxValue.CreateFromTensor("pictures_" + camera.Name, Grey(pictures, camera)));
            inputs.Add(NamedOnnxValue.CreateFromTensor("neutral_" + camera.Name, Grey(neutral, camera)));
        }
        using (var results = session.Run(inputs, outputs))
        {
            var found = results.ToDictionary(one => one.Name, one => one.AsEnumerable<float>().ToArray());
            var sameSeat = neutral == null ? float.NaN : found["same_seat"][0];
            return new Answer { Weights = found["weights"], Gaze = found["gaze"], SameSeat = sameSeat };
        }
    }

    static DenseTensor<byte> Grey(IReadOnlyDictionary<string, byte[]> pictures, Camera camera)
    {
        byte[] grey = null;
        if (pictures != null)
            pictures.TryGetValue(camera.Name, out grey);
        grey = grey ?? new byte[camera.Width * camera.Height];
        if (grey.Length != camera.Width * camera.Height)
            throw new ArgumentException(
                $"{camera.Name} has {grey.Length} grey levels; {camera.Width} x {camera.Height} are needed");
        return new DenseTensor<byte>(grey, new[] { 1, camera.Height, camera.Width });
    }

    public void Dispose() => session.Dispose();
}
