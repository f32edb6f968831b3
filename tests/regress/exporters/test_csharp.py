"""The C# examples, compiled by Mono, with stand-ins for Unity and onnxruntime, which cannot be had here."""

import shutil
import subprocess
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[3] / "docs" / "examples"

pytestmark = pytest.mark.skipif(
    not (shutil.which("mcs") and shutil.which("mono")), reason="needs Mono (Debian: mono-mcs, mono-runtime)"
)

UNITY = """
using System.Collections.Generic;
using System.Linq;
namespace UnityEngine {
    public class MonoBehaviour { }
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
        public void SetInput(string name, Tensor<float> tensor) { }
        public void Schedule() { }
        public object PeekOutput() => new Tensor<float>(null, Enumerable.Range(0, 52).Select(i => i / 100f).ToArray());
        public void Dispose() { }
    }
}
"""


def answer_of(example: str, stand_in: str, program: str, folder: Path) -> list[str]:
    """Lines that a program writes, which is the body of ``Main`` in a class that derives from the example's."""
    (folder / "standin.cs").write_text(stand_in)
    base = "" if "sealed" in (EXAMPLES / example).read_text() else f" : {example.removesuffix('.cs')}"
    head = "using System; using System.Collections.Generic; using System.Linq; using UnityEngine;"
    if "UnityEngine" not in stand_in:
        head = head.removesuffix(" using UnityEngine;")
    (folder / "main.cs").write_text(f"{head}\nclass Program{base} {{ static void Main() {{ {program} }} }}")
    files = [EXAMPLES / example, folder / "standin.cs", folder / "main.cs"]
    built = folder / "main.exe"
    for command in (["mcs", "-nologo", "-r:System.Core.dll", f"-out:{built}", *files], ["mono", built]):
        done = subprocess.run(command, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


CALIBRATING = """
    var face = new FaceWeights();
    foreach (var each in new Func<int, float>[] {
        i => i * i % 7, i => -1, i => i % 2, i => i % 2 == 0 ? i : 5, i => i == 9 ? float.NaN : i * i % 7 })
        Console.WriteLine(face.Calibrate(Enumerable.Range(0, 136).Select(each).ToArray()));
    Console.WriteLine(face.Calibrate(new float[135]));
"""


def test_a_neutral_face_without_extent_is_not_taken(tmp_path: Path):
    """As detectors write a lost one: with it all weights would be NaN from then on."""
    assert answer_of("FaceWeights.cs", UNITY, CALIBRATING, tmp_path) == ["True", *["False"] * 5]
