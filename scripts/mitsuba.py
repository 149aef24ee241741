#!/usr/bin/env python3
"""A second opinion: renders a folder made by `snell export --to mitsuba` with Mitsuba 3
and tells how well an exact image by snell agrees with it.

    python3 -m venv target/mitsuba/venv && target/mitsuba/venv/bin/pip install mitsuba numpy
    # On Debian the variant llvm_ad_rgb needs libllvm19 (apt-get install libllvm19).
    snell export cup --to mitsuba -o target/mitsuba/cup
    snell reference cup -o target/mitsuba/cup.exr --resolution 128 --lat-long --positions 16
    target/mitsuba/venv/bin/python scripts/mitsuba.py target/mitsuba/cup \
        --resolution 128 --reference target/mitsuba/cup.exr

Mitsuba integrates paths of up to 256 segments without roulette through a box filter, in
independent batches. Their mean and the standard error of the mean (se) are written as
FOLDER/mean.exr and FOLDER/standard_error.exr. With --reference one line per figure says:

  share of pixels within 4 se, over every channel of every pixel;
  mean difference in se: of the means over the image, so that a bias which no pixel shows is
  seen;
  chi: root mean square of the differences in se. Were both exact and the noise normal, it
  would be about 1 (for n batches, sqrt((n-1)/(n-3))); a tiled pattern of positions on the side of
  snell adds its own error at edges.
"""

import argparse
import json
import os
import re
import sys

# This file has the module's name and must not be imported in its place.
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path = [folder for folder in sys.path if os.path.abspath(folder or ".") != HERE]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", help="made by `snell export SCENE --to mitsuba`")
    parser.add_argument("--reference", metavar="FILE.exr", help="exact image to compare with")
    parser.add_argument("--resolution", type=int, metavar="PX", help="pixels a side [the scene's]")
    parser.add_argument("--batches", type=int, default=32, help="independent images [32]")
    parser.add_argument("--samples", type=int, default=64, help="paths per pixel and batch [64]")
    parser.add_argument("--seed", type=int, default=0, help="of the first batch [0]")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba [llvm_ad_rgb]")
    parser.add_argument("--floor", type=float, default=1e-4, metavar="F",
                        help="least standard error, as a share of the pixel's value [1e-4]")
    parser.add_argument("--json", action="store_true", help="answer with one JSON object")
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


def load(mi, asked):
    scene_file = os.path.join(asked.folder, "scene.xml")
    if not os.path.exists(scene_file):
        sys.exit(f"error: {scene_file} is not there\nmake it with `snell export SCENE --to mitsuba`")
    scene = mi.load_file(scene_file, spp=asked.samples, max_depth=256)
    if asked.resolution:
        # The film is part of the scene file; a square one replaces it.
        text = open(scene_file, encoding="utf-8").read()
        for side in ("width", "height"):
            text = re.sub(rf'name="{side}" value="\d+"', f'name="{side}" value="{asked.resolution}"', text)
        small = os.path.join(asked.folder, "scene-resized.xml")
        with open(small, "w", encoding="utf-8") as file:
            file.write(text)
        scene = mi.load_file(small, spp=asked.samples, max_depth=256)
    return scene


def render(mi, numpy, asked):
    """Mean of the batches and the standard error of it."""
    scene = load(mi, asked)
    mean, squares = 0.0, 0.0
    for batch in range(asked.batches):
        image = numpy.array(mi.render(scene, seed=asked.seed + batch), dtype=numpy.float64)
        step = image[..., :3] - mean
        mean = mean + step / (batch + 1)
        squares = squares + step * (image[..., :3] - mean)
        print(f"\rbatch {batch + 1} of {asked.batches}", end="", file=sys.stderr)
    print(file=sys.stderr)
    n = asked.batches
    return mean, numpy.sqrt(squares / (n * (n - 1)))


def agreement(numpy, exact, mean, error, floor):
    """How far the exact image is from Mitsuba's, in standard errors."""
    if exact.shape != mean.shape:
        sys.exit(f"error: the reference is {exact.shape[1]} x {exact.shape[0]} pixels and Mitsuba's "
                 f"image {mean.shape[1]} x {mean.shape[0]}\nrender both at one --resolution")
    # 32-bit arithmetic and the film's own rounding are not noise and do not average out.
    se = numpy.hypot(error, floor * numpy.abs(mean) + 1e-9)
    z = (exact - mean) / se
    whole = (exact.mean() - mean.mean()) / numpy.sqrt((error**2).sum()) * mean.size
    return {
        "share_within_4_se": float((numpy.abs(z) <= 4).mean()),
        "mean_difference_in_se": float(whole),
        "relative_mean_difference": float(exact.mean() / mean.mean() - 1),
        "rms_difference_in_se": float(numpy.sqrt((numpy.clip(z, -10, 10) ** 2).mean())),
        "relative_se": float(error.mean() / mean.mean()),
    }


def main():
    asked = arguments()
    find_llvm()
    try:
        import mitsuba as mi
        import numpy
    except ImportError as missing:
        sys.exit(f"error: {missing}\ninstall it: pip install mitsuba numpy")
    mi.set_variant(asked.variant)
    mean, error = render(mi, numpy, asked)
    for name, image in (("mean", mean), ("standard_error", error)):
        path = os.path.join(asked.folder, f"{name}.exr")
        mi.Bitmap(image.astype(numpy.float32)).write(path)
    if not asked.reference:
        return
    exact = numpy.array(mi.Bitmap(asked.reference).convert(mi.Bitmap.PixelFormat.RGB,
                        mi.Struct.Type.Float32, srgb_gamma=False), dtype=numpy.float64)
    figures = agreement(numpy, exact, mean, error, asked.floor)
    if asked.json:
        print(json.dumps({"schema": "snell.mitsuba/1", "scene": asked.folder, **figures}))
        return
    for name, value in figures.items():
        print(f"{name.replace('_', ' '):26} {value:.6g}")


if __name__ == "__main__":
    main()
