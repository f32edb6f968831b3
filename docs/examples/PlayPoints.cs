using System;
using System.Globalization;
using UnityEngine;

// Plays recorded landmarks on the avatar that FaceWeights drives: a first try without a camera. Put it beside FaceWeights.
public class PlayPoints : MonoBehaviour
{
    // A face a line, 136 numbers x y x y ..., y down. The first one is the neutral face.
    public TextAsset points;
    public float framesPerSecond = 30;
    FaceWeights face;
    float[][] faces = new float[0][];
    float seconds;
    int shown = -1;

    void Start()
    {
        face = GetComponent<FaceWeights>();
        var lines = points.text.Split(new[] { '\n', '\r' }, StringSplitOptions.RemoveEmptyEntries);
        faces = Array.ConvertAll(lines, Numbers);
        if (faces.Length > 0 && face.Calibrate(faces[0]))
            return;
        faces = new float[0][];
        Debug.LogError("The first line is no neutral face: it must have 136 numbers, and none missing.");
    }

    // With a point in every country: where a comma is usual, float.Parse would not take it.
    static float[] Numbers(string line)
    {
        var words = line.Split(new[] { ' ' }, StringSplitOptions.RemoveEmptyEntries);
        return Array.ConvertAll(words, Number);
    }

    // "nan", as NumPy writes a lost face's points, is NaN, like all that is no number: the avatar stays as it was.
    static float Number(string word) =>
        float.TryParse(word, NumberStyles.Float, CultureInfo.InvariantCulture, out float number) ? number : float.NaN;

    void Update()
    {
        if (faces.Length == 0)
            return;
        seconds += Time.deltaTime;
        int frame = (int)(seconds * framesPerSecond) % faces.Length;
        if (frame == shown)
            return;
        shown = frame;
        face.Apply(faces[frame]);
    }
}
