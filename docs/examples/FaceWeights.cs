using Unity.InferenceEngine;
using UnityEngine;

// Drives an avatar's blend shapes from 68 landmarks. In Unity 6 with the package com.unity.ai.inference; put face.onnx
// (regress export models/default --format onnx) among the assets. The avatar's shapes carry ARKit's names.
public class FaceWeights : MonoBehaviour
{
    public ModelAsset asset;
    public SkinnedMeshRenderer avatar;

    // The order of the export's "names"; the shapes' places in the avatar are looked up once.
    public string[] names;
    Worker worker;
    int[] shapes;

    // The person's neutral face, 136 numbers as points; zeros where it is not known. One component for each player.
    // Models of the paper's recipe, and exports with --neutral, have no such input.
    float[] neutral = new float[136];

    void Start()
    {
        worker = new Worker(ModelLoader.Load(asset), BackendType.CPU);
        shapes = System.Array.ConvertAll(names, avatar.sharedMesh.GetBlendShapeIndex);
    }

    // Call it with a face at rest, mouth closed and eyes open. One with a missing point is not taken.
    public bool Calibrate(float[] points)
    {
        if (points.Length != 136 || System.Array.Exists(points, value => !float.IsFinite(value)))
            return false;
        neutral = (float[])points.Clone();
        return true;
    }

    // points: 136 numbers, x and y of each landmark, y down.
    public void Apply(float[] points)
    {
        using var input = new Tensor<float>(new TensorShape(1, 68, 2), points);
        using var rest = new Tensor<float>(new TensorShape(1, 68, 2), neutral);
        worker.SetInput("points", input);
        worker.SetInput("neutral", rest);
        worker.Schedule();
        var weights = (worker.PeekOutput() as Tensor<float>).DownloadToArray();
        for (int i = 0; i < shapes.Length; i++)
            if (shapes[i] >= 0 && !float.IsNaN(weights[i]))
                avatar.SetBlendShapeWeight(shapes[i], 100f * weights[i]);
    }

    void OnDestroy() => worker?.Dispose();
}
