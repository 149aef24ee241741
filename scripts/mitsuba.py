#!/usr/bin/env python3
"""A second opinion: renders scenes with Mitsuba 3 from what `snell export` writes, and
tells how well snell's exact images agree.

    python3 -m venv target/mitsuba/venv && target/mitsuba/venv/bin/pip install mitsuba numpy
    # On Debian the variant llvm_ad_rgb needs libllvm19 (apt-get install libllvm19).
    target/mitsuba/venv/bin/python scripts/mitsuba.py            # every built-in scene
    target/mitsuba/venv/bin/python scripts/mitsuba.py cup my-scene.toml --resolution 128

Mitsuba integrates paths of up to 256 segments without roulette through a box filter, in
independent batches; their mean and its standard error (se) are kept beside the export.

Left out are pixels in or beside which snell replaced a shading normal or met trapped light,
seen at 4 x 4 positions: there both follow a rule of their own. What remains is compared
twice: all of it, and without the pixels in or beside which Mitsuba breaks the white furnace
by more than 1e-3. In a furnace (the same bodies under uniform light of 1) bodies without
absorption vanish, so that there Mitsuba is known to be wrong. The share is printed.

  within    share of values, every channel of every pixel, within 4 se
  mean      difference of the means over the image in se: a bias that no pixel shows
  relative  the same as a share of the mean
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys

# This file has the module's name and must not be imported in its place.
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path = [folder for folder in sys.path if os.path.abspath(folder or ".") != HERE]

REPLACED = 64  # the flag of a replaced normal
FURNACE = '<emitter type="constant"><rgb name="radiance" value="1"/></emitter>'


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="name or file [every built-in]")
    parser.add_argument("--snell", default="target/release/snell", help="program [%(default)s]")
    parser.add_argument("--out", "-o", default="target/mitsuba", help="folder [%(default)s]")
    parser.add_argument("--resolution", type=int, default=64, help="pixels a side [%(default)s]")
    parser.add_argument("--positions", type=int, default=16, help="snell's K x K [%(default)s]")
    parser.add_argument("--batches", type=int, default=32, help="independent images [%(default)s]")
    parser.add_argument("--samples", type=int, default=64, help="paths per pixel and batch [%(default)s]")
    parser.add_argument("--seed", type=int, default=0, help="of the first batch [%(default)s]")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba [%(default)s]")
    parser.add_argument("--floor", type=float, default=1e-4, metavar="F",
                        help="least standard error, as a share of the value [%(default)s]")
    parser.add_argument("--json", action="store_true", help="answer with one JSON object per line")
    asked = parser.parse_args()
    if asked.batches < 4:
        parser.error("--batches: at least 4, or there is no standard error to speak of")
    return asked


def find_llvm():
    """Debian puts a versioned library where Dr.Jit does not look."""
    for version in range(21, 13, -1):
        path = f"/usr/lib/llvm-{version}/lib/libLLVM-{version}.so"
        for candidate in (path, f"/usr/lib/x86_64-linux-gnu/libLLVM-{version}.so"):
            if os.path.exists(candidate):
                os.environ.setdefault("DRJIT_LIBLLVM_PATH", candidate)
                return


class Refused(Exception):
    """snell says why."""


def snell(asked, *words):
    done = subprocess.run([asked.snell, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise Refused(" ".join(done.stderr.split("error:")[-1].split()))
    return done.stdout


def pixels(path):
    bitmap = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32,
                                     srgb_gamma=False)
    return numpy.array(bitmap, dtype=numpy.float64)


def exact(asked, scene, folder):
    """snell's image, and in which pixels it replaced a normal."""
    px, image, flags = asked.resolution, f"{folder}/exact.exr", f"{folder}/flags.exr"
    words = ["reference", scene, "--lat-long", "--resolution"]
    snell(asked, *words, f"{px}x{px}", "--positions", str(asked.positions), "--cut", "1e-6",
          "-o", image)
    snell(asked, *words, f"{4 * px}x{4 * px}", "--positions", "1", "--layers", "flags", "-o", flags)
    marks = numpy.array(mi.Bitmap(flags), dtype=numpy.float64).reshape(4 * px, 4 * px).astype(int)
    return pixels(image), (marks & REPLACED != 0).reshape(px, 4, px, 4).any(axis=(1, 3))


def beside(mask):
    """The pixels of a mask and their neighbours."""
    wide = numpy.pad(mask, 1)
    height, width = mask.shape
    return numpy.any([wide[y:y + height, x:x + width] for y in range(3) for x in range(3)], axis=0)


def load(asked, folder, furnace):
    """The exported scene as a square, in its own light or in a furnace's."""
    with open(f"{folder}/scene.xml", encoding="utf-8") as file:
        text = file.read()
    for side in ("width", "height"):
        text = re.sub(rf'name="{side}" value="\d+"', f'name="{side}" value="{asked.resolution}"', text)
    if furnace:
        text = re.sub(r'<emitter type="(envmap|constant)">.*?</emitter>', FURNACE, text, flags=re.S)
    path = f"{folder}/{'furnace' if furnace else 'judged'}.xml"
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return mi.load_file(path, spp=asked.samples, max_depth=256)


def render(asked, scene):
    """Mean of the batches and the standard error of it."""
    mean, squares, n = 0.0, 0.0, asked.batches
    for batch in range(n):
        image = numpy.array(mi.render(scene, seed=asked.seed + batch), dtype=numpy.float64)[..., :3]
        step = image - mean
        mean = mean + step / (batch + 1)
        squares = squares + step * (image - mean)
    return mean, numpy.sqrt(squares / (n * (n - 1)))


def agreement(asked, ours, mean, error, kept):
    """How far apart two images are in the pixels that are kept, in standard errors."""
    ours, mean, error = ours[kept], mean[kept], error[kept]
    # 32-bit arithmetic and the film's own rounding are not noise and do not average out.
    z = (ours - mean) / numpy.hypot(error, asked.floor * numpy.abs(mean) + 1e-9)
    of_mean = max(numpy.sqrt((error**2).sum()) / error.size, asked.floor * abs(mean.mean()) / 4)
    return {
        "within": float((numpy.abs(z) <= 4).mean()),
        "mean_in_se": float((ours.mean() - mean.mean()) / of_mean),
        "relative": float(ours.mean() / mean.mean() - 1),
    }


def judge(asked, scene):
    name = os.path.splitext(os.path.basename(scene))[0]
    folder = os.path.join(asked.out, name)
    if os.path.exists(os.path.join(folder, "scene.xml")):
        shutil.rmtree(folder)  # of an earlier run
    snell(asked, "export", scene, "--to", "mitsuba", "-o", folder)
    ours, replaced = exact(asked, scene, folder)
    mean, error = render(asked, load(asked, folder, False))
    for part, image in (("mean", mean), ("standard_error", error)):
        mi.Bitmap(image.astype(numpy.float32)).write(f"{folder}/{part}.exr")
    white, _ = render(asked, load(asked, folder, True))
    # Absorption darkens a furnace: then nothing is known from it.
    lossless = "medium" not in open(f"{folder}/scene.xml", encoding="utf-8").read()
    broken = (numpy.abs(white - 1) > 1e-3).any(axis=2) if lossless else numpy.zeros_like(replaced)
    kept = ~beside(replaced)
    sound = kept & ~beside(broken)
    return {
        "scene": name,
        "left_out": float(1 - kept.mean()),
        **agreement(asked, ours, mean, error, kept),
        "furnace_broken": float((kept & ~sound).mean()),
        "furnace_low": float(white.min()), "furnace_high": float(white.max()),
        **{f"sound_{key}": value for key, value in agreement(asked, ours, mean, error, sound).items()},
    }


HEAD = ("scene               left out  within  mean, se  relative   furnace   (values)      "
        "without it: within  mean, se  relative")


def line(row):
    return (f"{row['scene']:20}{row['left_out']:7.1%}{row['within']:9.2%}{row['mean_in_se']:9.2f}"
            f"{row['relative']:11.1e}{row['furnace_broken']:9.1%}   {row['furnace_low']:.3f} to "
            f"{row['furnace_high']:.3f}{row['sound_within']:18.2%}{row['sound_mean_in_se']:10.2f}"
            f"{row['sound_relative']:11.1e}")


def main():
    asked = arguments()
    mi.set_variant(asked.variant)
    os.makedirs(asked.out, exist_ok=True)
    listed = [json.loads(row) for row in snell(asked, "scenes", "--json").splitlines()]
    scenes = asked.scenes or [row["name"] for row in listed if not row["missing"]]
    if not asked.json:
        print(HEAD, flush=True)
    for scene in scenes:
        print(f"mitsuba: {scene}", file=sys.stderr, flush=True)
        try:
            row = judge(asked, scene)
        except Refused as why:
            row = {"scene": scene, "refused": str(why)}
        row = {"schema": "snell.mitsuba/2", **row}
        text = f"{scene:20}{row['refused']}" if "refused" in row else line(row)
        print(json.dumps(row) if asked.json else text, flush=True)


if __name__ == "__main__":
    options = [word for word in sys.argv[1:] if word in ("-h", "--help")]
    if options:
        arguments()
    find_llvm()
    try:
        import mitsuba as mi
        import numpy
    except ImportError as missing:
        sys.exit(f"error: {missing}\ninstall it: pip install mitsuba numpy")
    main()
