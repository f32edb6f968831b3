using System;
using System.Collections.Generic;
using System.Linq;
using Microsoft.ML.OnnxRuntime;
using Microsoft.ML.OnnxRuntime.Tensors;

// Weights of a headset's pictures by the NuGet package Microsoft.ML.OnnxRuntime, which Unity and .NET load alike.
// `regress headset export models/headset` makes headset.onnx; names and sizes are in headset.json beside it.
public sealed class HeadsetWeights : IDisposable
{
    readonly InferenceSession session;
    readonly string[] cameras;
    readonly int width, height;

    public HeadsetWeights(string graph, string[] cameras, int width, int height)
    {
        var options = new SessionOptions { IntraOpNumThreads = 1 };
        session = new InferenceSession(graph, options);
        (this.cameras, this.width, this.height) = (cameras, width, height);
    }

    // Grey pictures by camera, rows from the top; a camera that is missing is left out. Neutral pictures may be null.
    // The result has the order of "shapes" in headset.json.
    public float[] Predict(IReadOnlyDictionary<string, byte[]> pictures, IReadOnlyDictionary<string, byte[]> neutral = null)
    {
        foreach (var name in pictures.Keys)
            if (!cameras.Contains(name) || (neutral != null && !neutral.ContainsKey(name)))
                throw new ArgumentException(name + " is no camera of the headset, or has no neutral picture");
        var present = cameras.Select(camera => pictures.ContainsKey(camera) ? 1f : 0f).ToArray();
        var calibrated = new[] { neutral == null ? 0f : 1f };
        var inputs = new List<NamedOnnxValue>
        {
            NamedOnnxValue.CreateFromTensor("present", new DenseTensor<float>(present, new[] { 1, cameras.Length })),
            NamedOnnxValue.CreateFromTensor("calibrated", new DenseTensor<float>(calibrated, new[] { 1 })),
        };
        foreach (var camera in cameras)
        {
            inputs.Add(NamedOnnxValue.CreateFromTensor("pictures_" + camera, Grey(pictures, camera)));
            inputs.Add(NamedOnnxValue.CreateFromTensor("neutral_" + camera, Grey(neutral, camera)));
        }
        using var results = session.Run(inputs, new[] { "weights" });
        return results.First().AsEnumerable<float>().ToArray();
    }

    DenseTensor<byte> Grey(IReadOnlyDictionary<string, byte[]> pictures, string camera)
    {
        var found = pictures != null && pictures.TryGetValue(camera, out var picture) ? picture : new byte[width * height];
        return new DenseTensor<byte>(found, new[] { 1, height, width });
    }

    public void Dispose() => session.Dispose();
}
