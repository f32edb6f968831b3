"""The C# examples, compiled by Mono, with stand-ins for Unity and onnxruntime, which cannot be had here."""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from regress.runtime.inputs import face_faults
from tests.regress.exporters.test_outline import drawn_neutral_faces

EXAMPLES = Path(__file__).resolve().parents[3] / "docs" / "examples"

pytestmark = pytest.mark.skipif(
    not (shutil.which("mcs") and shutil.which("mono")), reason="needs Mono (Debian: mono-mcs, mono-runtime)"
)

UNITY = """
using System.Collections.Generic;
using System.Linq;
namespace UnityEngine {
    public class MonoBehaviour {
        public static SkinnedMeshRenderer[] Below = { };
        public T[] GetComponentsInChildren<T>() => (T[])(object)Below;
        public static object Beside;
        public T GetComponent<T>() => (T)Beside;
    }
    public static class Application { public static string streamingAssetsPath; }
    public class TextAsset { public string text; }
    public static class Time { public static float deltaTime, time; public static double unscaledTimeAsDouble; }
    public static class Debug { public static void LogError(string said) { System.Console.WriteLine(said); } }
    public class RangeAttribute : System.Attribute { public RangeAttribute(float least, float most) { } }
    public static class Mathf {
        public static float Min(float a, float b) => System.Math.Min(a, b);
        public static float Max(float a, float b) => System.Math.Max(a, b);
    }
    public class Mesh {
        public string[] Names = { };
        public int GetBlendShapeIndex(string name) => System.Array.IndexOf(Names, name);
        public int GetBlendShapeFrameCount(int index) => 1;
        public float GetBlendShapeFrameWeight(int index, int frame) => 100;
    }
    public class SkinnedMeshRenderer {
        public Mesh sharedMesh = new Mesh();
        public Dictionary<string, float> Shown = new Dictionary<string, float>();
        public void SetBlendShapeWeight(int index, float value) { Shown[sharedMesh.Names[index]] = value; }
    }
}
namespace Unity.InferenceEngine {
    public class ModelAsset { }
    public static class ModelLoader { public static object Load(ModelAsset asset) => asset; }
    public enum BackendType { CPU }
    public class TensorShape { public TensorShape(params int[] sizes) { } }
    public class Tensor<T> : System.IDisposable {
        readonly T[] values;
        public Tensor(TensorShape shape, T[] values) { this.values = values; }
        public T[] DownloadToArray() => values;
        public void Dispose() { }
    }
    public class Worker : System.IDisposable {
        public Worker(object model, BackendType backend) { }
        public static List<string> Given = new List<string>();
        public void SetInput(string name, Tensor<float> tensor) { Given.Add(name + " " + tensor.DownloadToArray()[0]); }
        public void Schedule() { }
        public object PeekOutput() => new Tensor<float>(null, Enumerable.Range(0, 52).Select(i => i / 100f).ToArray());
        public void Dispose() { }
    }
}
"""


def answer_of(examples: str | tuple[str, ...], stand_in: str, program: str, folder: Path) -> list[str]:
    """Lines that a program writes, of which the body of ``Main`` is given."""
    using = "".join(f"using {name};" for name in ("System", "System.Collections.Generic", "System.Linq"))
    (folder / "standin.cs").write_text(stand_in)
    (folder / "main.cs").write_text(f"{using} class Program {{ static void Main() {{ {program} }} }}")
    examples = (examples,) if isinstance(examples, str) else examples
    files = [*(EXAMPLES / example for example in examples), folder / "standin.cs", folder / "main.cs"]
    built = folder / "main.exe"
    for command in (["mcs", "-nologo", "-r:System.Core.dll", f"-out:{built}", *files], ["mono", built]):
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


CALIBRATING = """
    var face = new FaceWeights();
    foreach (var line in System.IO.File.ReadLines(@"%s"))
        Console.WriteLine(face.Calibrate(line.Split(' ').Select(
            word => float.Parse(word, System.Globalization.CultureInfo.InvariantCulture)).ToArray()));
    Console.WriteLine(face.Calibrate(new float[135]));
    Console.WriteLine(face.Calibrate(Enumerable.Repeat(float.NaN, 136).ToArray()));
"""


def test_a_neutral_face_that_is_no_face_is_not_taken(tmp_path: Path):
    """In one place, as detectors write a lost one: all weights would be NaN from then on, or wrong."""
    faces = np.concatenate([drawn_neutral_faces(), np.full((1, 68, 2), -1)]).astype(np.float32)
    written = tmp_path / "faces.txt"
    np.savetxt(written, faces.reshape(len(faces), -1), fmt="%.9g")
    taken = [fault is None for fault in face_faults(faces.astype(np.float64))]
    answered = answer_of("FaceWeights.cs", UNITY, CALIBRATING % written, tmp_path)
    assert answered == [*map(str, taken), "False", "False"]


MOVING = """
    var names = new[] { "jawOpen EyeBlinkLeft other", "JawOpen", "eyeBlink_L", "" };
    var all = names.Select(text => new UnityEngine.SkinnedMeshRenderer
        { sharedMesh = new UnityEngine.Mesh { Names = text.Split(' ') } }).ToArray();
    UnityEngine.MonoBehaviour.Below = all;
    var start = typeof(FaceWeights).GetMethod(
        "Start", System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance);
    foreach (var named in new[] { all.Take(0), all.Skip(1).Take(1) }) {
        foreach (var each in all) each.Shown.Clear();
        var face = new FaceWeights { newest = 1, meshes = named.ToArray() };
        start.Invoke(face, null);
        face.Apply(new float[136]);
        Console.WriteLine(string.Join(" ", all.SelectMany(each => each.Shown).Select(
            each => each.Key + " " + Math.Round(each.Value))));
    }
"""


def test_all_meshes_of_an_avatar_move_that_have_a_shape(tmp_path: Path):
    """Teeth and lashes are meshes of their own; jawOpen is weight 17 of the stand-in's, eyeBlinkLeft weight 0."""
    lines = answer_of("FaceWeights.cs", UNITY, MOVING, tmp_path)
    assert lines == ["EyeBlinkLeft 0 jawOpen 17 JawOpen 17 eyeBlink_L 0", "JawOpen 17"]


PLAYING = """
    System.Threading.Thread.CurrentThread.CurrentCulture = new System.Globalization.CultureInfo("de-DE");
    Action<object, string> call = (what, method) => what.GetType().GetMethod(
        method, System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance).Invoke(what, null);
    Func<int, string> line = first => first + ".5 " + string.Join(" ", Enumerable.Range(1, 135).Select(i => i * i % 5));
    var lost = string.Join(" ", Enumerable.Repeat("nan", 136));
    var three = line(0) + "\\r\\n" + line(1) + "\\n" + line(2) + "\\n";
    foreach (var text in new[] { three, "1 2 3", line(0) + "\\n" + lost }) {
        Unity.InferenceEngine.Worker.Given.Clear();
        var face = new FaceWeights();
        UnityEngine.MonoBehaviour.Beside = face;
        var play = new PlayPoints { points = new UnityEngine.TextAsset { text = text } };
        call(face, "Start");
        call(play, "Start");
        UnityEngine.Time.deltaTime = 1 / 45f;
        for (int i = 0; i < 5; i++) call(play, "Update");
        Console.WriteLine(string.Join(", ", Unity.InferenceEngine.Worker.Given.Select(each => each.Replace(",", "."))));
    }
"""


SMOOTHING = """
    var shapes = new UnityEngine.Mesh { Names = new[] { "jawOpen" } };
    var mesh = new UnityEngine.SkinnedMeshRenderer { sharedMesh = shapes };
    UnityEngine.MonoBehaviour.Below = new[] { mesh };
    var flags = System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance;
    foreach (var rate in new[] { 30, 60, 90 }) {
        UnityEngine.Time.unscaledTimeAsDouble = 0;
        var face = new FaceWeights();
        typeof(FaceWeights).GetMethod("Start", flags).Invoke(face, null);
        Action<float> show = open => typeof(FaceWeights).GetMethod("Show", flags).Invoke(
            face, new object[] { Enumerable.Repeat(open, 52).ToArray() });
        show(0);
        for (int i = 1; i <= rate / 10; i++) {
            UnityEngine.Time.unscaledTimeAsDouble = i / (double)rate; show(1);
        }
        Console.WriteLine(Math.Round(mesh.Shown["jawOpen"], 2));
        show(.25f);
        Console.WriteLine(Math.Round(mesh.Shown["jawOpen"], 2));
    }
"""


def test_smoothing_takes_as_long_at_any_rate(tmp_path: Path):
    """A tenth of a second of .5 at 30 frames a second: what was shown has an eighth left.

    The game's own time stands still, as a paused one's does, and a second frame at the same time is shown as it is.
    """
    assert answer_of("FaceWeights.cs", UNITY, SMOOTHING, tmp_path) == ["87.5", "25"] * 3


def test_recorded_points_are_played_by_the_clock_and_the_first_one_is_neutral(tmp_path: Path):
    """Updates at 0.67, 1.33, 2, 2.67 and 3.33 frames of three, where numbers are usually written with commas."""
    played, refused, nothing, lost = answer_of(("FaceWeights.cs", "PlayPoints.cs"), UNITY, PLAYING, tmp_path)
    given = [f"points {first}, neutral 0.5" for first in ("0.5", "1.5", "2.5", "0.5")]
    assert played == ", ".join(given)
    assert refused.startswith("The first line is no neutral face")
    assert nothing == ""
    assert lost.startswith("points 0.5, neutral 0.5, points NaN, neutral 0.5"), "nan, as NumPy writes it"


PAGE_CLASSES = """
using System.Collections.Generic;
using UnityEngine;
class Landmarks : MonoBehaviour { void Run(float[] neutral, float[] points) { %s } }
class Pictures { void Run(Dictionary<string, byte[]> pictures, Dictionary<string, byte[]> neutral) { %s } }
"""


def test_the_code_of_the_page_is_compiled(tmp_path: Path):
    page = (EXAMPLES.parent / "game-engines.md").read_text(encoding="utf-8")
    snippets = re.findall(r"```csharp\n(.*?)```", page, flags=re.DOTALL)
    texts = {"unity": UNITY, "runtime": ONNXRUNTIME, "page": PAGE_CLASSES % tuple(snippets)}
    for name, text in texts.items():
        (tmp_path / f"{name}.cs").write_text(text)
    files = [
        *(tmp_path / f"{name}.cs" for name in texts),
        EXAMPLES / "FaceWeights.cs",
        EXAMPLES / "HeadsetWeights.cs",
    ]
    command = [
        "mcs",
        "-nologo",
        "-target:library",
        "-r:System.Core.dll",
        f"-out:{tmp_path / 'page.dll'}",
        *files,
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr


ONNXRUNTIME = """
using System;
using System.Collections.Generic;
using System.Linq;
namespace Microsoft.ML.OnnxRuntime.Tensors {
    public class DenseTensor<T> {
        public readonly T[] Values;
        public DenseTensor(T[] values, int[] sizes) { Values = values; }
    }
}
namespace Microsoft.ML.OnnxRuntime {
    public class SessionOptions : IDisposable {
        public static int Alive;
        public int IntraOpNumThreads;
        public SessionOptions() { Alive++; }
        public void Dispose() { Alive--; }
    }
    public class NamedOnnxValue : IDisposable {
        public string Name;
        public object Values;
        public static NamedOnnxValue CreateFromTensor<T>(string name, Tensors.DenseTensor<T> tensor) =>
            new NamedOnnxValue { Name = name, Values = tensor.Values };
        public IEnumerable<T> AsEnumerable<T>() => (T[])Values;
        public void Dispose() { }
    }
    public class Results : List<NamedOnnxValue>, IDisposable { public void Dispose() { } }
    public class InferenceSession : IDisposable {
        public InferenceSession(string graph, SessionOptions options) { }
        public InferenceSession(byte[] graph, SessionOptions options) { }
        public Results Run(IEnumerable<NamedOnnxValue> inputs, IEnumerable<string> outputs) {
            var present = (float[])inputs.First(one => one.Name == "present").Values;
            var found = new Results();
            foreach (var name in outputs) found.Add(new NamedOnnxValue { Name = name, Values = present });
            return found;
        }
        public void Dispose() { }
    }
}
"""

ANSWERING = """
    var mouth = new HeadsetWeights.Camera("mouth", 2, 2);
    using (var weights = new HeadsetWeights(new byte[9], mouth)) {
        var one = new Dictionary<string, byte[]> { { "mouth", new byte[4] } };
        Console.WriteLine(float.IsNaN(weights.Predict(one).SameSeat) + " " + weights.Predict(one, one).SameSeat);
    }
    using (var weights = new HeadsetWeights("headset.onnx", mouth, new HeadsetWeights.Camera("left_eye", 2, 2))) {
        Console.WriteLine(Microsoft.ML.OnnxRuntime.SessionOptions.Alive);
        foreach (var names in new[] { "mouth", "", "right_eye" })
            try {
                var shown = names.Split(' ').Where(name => name != "");
                var pictures = shown.ToDictionary(name => name, name => new byte[4]);
                Console.WriteLine(string.Join(" ", weights.Predict(pictures).Weights));
            } catch (ArgumentException error) { Console.WriteLine(error.Message); }
    }
"""


def test_a_headset_without_any_picture_has_no_answer(tmp_path: Path):
    assert answer_of("HeadsetWeights.cs", ONNXRUNTIME, ANSWERING, tmp_path) == [
        "True 1",  # of the same seat nothing is known without neutral pictures
        "0",  # options that nobody let go
        "1 0",
        "no picture is given of mouth, left_eye",
        "right_eye is no camera of the headset, or has no neutral picture",
    ]
