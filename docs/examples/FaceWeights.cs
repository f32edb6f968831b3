using System.Collections.Generic;
using Unity.InferenceEngine;
using UnityEngine;

// Drives an avatar's blend shapes from 68 landmarks. In Unity 6 with the package com.unity.ai.inference; put face.onnx
// (regress export models/default --format onnx) among the assets. The avatar's shapes carry ARKit's names.
public class FaceWeights : MonoBehaviour
{
    public ModelAsset asset;
    // The avatar's meshes with such shapes: face, teeth, tongue, lashes. Where none is named, all below this object.
    public SkinnedMeshRenderer[] meshes = new SkinnedMeshRenderer[0];

    // The export's order (tests/regress/exporters hold it). Avatars spell the names as ARKit does, or with a capital as
    // Perfect Sync does, or with _L and _R.
    static readonly string[] Names =
    {
        "eyeBlinkLeft", "eyeLookDownLeft", "eyeLookInLeft", "eyeLookOutLeft", "eyeLookUpLeft",
        "eyeSquintLeft", "eyeWideLeft", "eyeBlinkRight", "eyeLookDownRight", "eyeLookInRight",
        "eyeLookOutRight", "eyeLookUpRight", "eyeSquintRight", "eyeWideRight", "jawForward", "jawLeft",
        "jawRight", "jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthLeft", "mouthRight",
        "mouthSmileLeft", "mouthSmileRight", "mouthFrownLeft", "mouthFrownRight", "mouthDimpleLeft",
        "mouthDimpleRight", "mouthStretchLeft", "mouthStretchRight", "mouthRollLower", "mouthRollUpper",
        "mouthShrugLower", "mouthShrugUpper", "mouthPressLeft", "mouthPressRight", "mouthLowerDownLeft",
        "mouthLowerDownRight", "mouthUpperUpLeft", "mouthUpperUpRight", "browDownLeft", "browDownRight",
        "browInnerUp", "browOuterUpLeft", "browOuterUpRight", "cheekPuff", "cheekSquintLeft",
        "cheekSquintRight", "noseSneerLeft", "noseSneerRight", "tongueOut",
    };
    // Share of the newest frame in what is shown, at 30 frames a second: .5 smooths without a visible lag. At other rates
    // it smooths over as long a time.
    [Range(.05f, 1f)] public float newest = .5f;
    float[] shown;
    double shownAt = double.NegativeInfinity;
    Worker worker;
    readonly List<Shape> shapes = new List<Shape>();

    class Shape
    {
        public SkinnedMeshRenderer Mesh;
        public int Index, Weight;
        public float Whole; // 100 in an FBX file, 1 in a glTF file that glTFast has read
    }

    // The person's neutral face, 136 numbers as points; zeros where it is not known. One component for each player.
    // Models of the paper's recipe, and exports with --neutral, have no such input.
    float[] neutral = new float[136];

    void Start()
    {
        worker = new Worker(ModelLoader.Load(asset), BackendType.CPU);
        shown = new float[Names.Length];
        foreach (var mesh in meshes.Length > 0 ? meshes : GetComponentsInChildren<SkinnedMeshRenderer>())
            for (int i = 0; i < Names.Length; i++)
                Find(mesh, i);
    }

    void Find(SkinnedMeshRenderer mesh, int weight)
    {
        int index = mesh.sharedMesh == null ? -1 : IndexOf(mesh.sharedMesh, Names[weight]);
        if (index < 0)
            return;
        int last = mesh.sharedMesh.GetBlendShapeFrameCount(index) - 1;
        float whole = mesh.sharedMesh.GetBlendShapeFrameWeight(index, last);
        shapes.Add(new Shape { Mesh = mesh, Index = index, Weight = weight, Whole = whole });
    }

    static int IndexOf(Mesh mesh, string name)
    {
        var sides = name.Replace("Left", "_L").Replace("Right", "_R");
        foreach (var spelling in new[] { name, char.ToUpper(name[0]) + name.Substring(1), sides })
        {
            int index = mesh.GetBlendShapeIndex(spelling);
            if (index >= 0)
                return index;
        }
        return -1;
    }

    // Call it with a face at rest, mouth closed and eyes open. One with a missing point is not taken, nor points that
    // are no face: all in one place or on one line, in a mirror (left and right exchanged), or with y upward.
    public bool Calibrate(float[] points)
    {
        if (points.Length != 136 || System.Array.Exists(points, value => !float.IsFinite(value)) || !IsFace(points))
            return false;
        neutral = (float[])points.Clone();
        return true;
    }

    // Once round the face: along the jaw from the player's right ear, and back along the brows.
    static readonly int[] Outline =
    {
        0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17,
    };

    static bool IsFace(float[] points)
    {
        double middleX = 0, middleY = 0, xx = 0, xy = 0, yy = 0, extent = 0, area = 0;
        for (int i = 0; i < 136; i += 2)
        {
            middleX += points[i] / 68.0;
            middleY += points[i + 1] / 68.0;
        }
        for (int i = 0; i < 136; i += 2)
        {
            double x = points[i] - middleX, y = points[i + 1] - middleY;
            extent = System.Math.Max(extent, System.Math.Max(System.Math.Abs(x), System.Math.Abs(y)));
            xx += x * x;
            xy += x * y;
            yy += y * y;
        }
        for (int i = 0; i < Outline.Length; i++)
        {
            int one = 2 * Outline[i], next = 2 * Outline[(i + 1) % Outline.Length];
            area += (points[one] - middleX) * (points[next + 1] - middleY);
            area -= (points[one + 1] - middleY) * (points[next] - middleX);
        }
        return xx * yy - xy * xy > .001 * (xx + yy) * (xx + yy) && area <= .8 * extent * extent;
    }

    // points: 136 numbers, x and y of each landmark, y down.
    public void Apply(float[] points)
    {
        using (var input = new Tensor<float>(new TensorShape(1, 68, 2), points))
        using (var rest = new Tensor<float>(new TensorShape(1, 68, 2), neutral))
        {
            worker.SetInput("points", input);
            worker.SetInput("neutral", rest);
            worker.Schedule();
            Show((worker.PeekOutput() as Tensor<float>).DownloadToArray());
        }
    }

    void Show(float[] weights)
    {
        // Unscaled time goes on in a paused game. Of several frames at one time the newest is shown.
        double step = Time.unscaledTimeAsDouble - shownAt;
        double kept = newest < 1 && step > 0 ? System.Math.Pow(1 - newest, 30 * step) : 0;
        shownAt = Time.unscaledTimeAsDouble;
        for (int i = 0; i < shown.Length; i++)
            if (!float.IsNaN(weights[i]))
                shown[i] += (float)(1 - kept) * (weights[i] - shown[i]);
        foreach (var shape in shapes)
            shape.Mesh.SetBlendShapeWeight(shape.Index, shape.Whole * shown[shape.Weight]);
    }

    void OnDestroy() => worker?.Dispose();
}
