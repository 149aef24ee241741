"""Mitsuba 3 beside snell: processor time to one root mean square error.

Asked by `snell bench --reference --against mitsuba`, which hands over itself, a folder,
and the resolution. One JSON object per line and scene goes to stdout.

Mitsuba integrates paths of up to 256 segments without roulette with 64, 256 and 1,024
samples per pixel; its time is that of the render alone, after one that compiled its
kernels. snell follows random paths through the points of a lattice and through the centres
of k x k cells of a pixel, and at such centres the whole tree of branches; each with more
and more positions until the error is below the least of Mitsuba's. Whichever way gets there
first counts, and is named. Its time is that of the whole process less that of one which
renders one pixel. Both are user and system time of all threads. The truth is snell's tree at
16 x 16 positions, which share none with the images that are judged; whether Mitsuba agrees with it is told as
the difference of the means in standard errors. Left out are pixels in or beside which snell
replaced a shading normal or caught trapped light, as in its other comparisons.
"""

import json
import math
import os
import resource
import subprocess
import sys

SAMPLES = [64, 256, 1024]
TRUTH = (16, 1e-4)
CELLS = [1, 2, 3, 4, 5, 6, 8]
LATTICES = [1, 2, 3, 5, 8, 13, 21, 34, 55, 89]
REPLACED = 64  # the flag of a replaced normal
SCENES = {
    "sphere, smooth": ("geodesic-16", "smooth"),
    "sphere, flat": ("geodesic-16", "flat"),
    "cup, smooth": ("cup", "smooth"),
}
TEXT = """title = "timing"
[camera]
eye = [0.0, 0.6, 4.0]
target = [0.0, 0.0, 0.0]
vertical_fov_deg = 40.0
resolution_px = [{px}, {px}]
[environment]
sky = {{ zenith = [0.16, 0.34, 0.78], horizon = [0.86, 0.90, 0.96], ground = [0.10, 0.09, 0.08], \
checker = {{ colour = [0.62, 0.56, 0.48], size = 0.7 }} }}
[[object]]
shape = {{ builtin = "{shape}" }}
surface = "dielectric"
medium = {{ eta = 1.5 }}
normals = "{normals}"
"""


def find_llvm():
    """Debian puts a versioned library where Dr.Jit does not look."""
    for version in range(21, 13, -1):
        for folder in (f"/usr/lib/llvm-{version}/lib", "/usr/lib/x86_64-linux-gnu"):
            path = f"{folder}/libLLVM-{version}.so"
            if os.path.exists(path):
                os.environ.setdefault("DRJIT_LIBLLVM_PATH", path)
                return


def used(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


class Snell:
    def __init__(self, program, folder, scene):
        self.program, self.folder, self.scene = program, folder, scene

    def run(self, *arguments):
        """Seconds of processor time."""
        before = used(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"error: snell {' '.join(arguments)}\n{done.stderr.strip()}")
        return used(resource.RUSAGE_CHILDREN) - before

    def image(self, px, *how):
        path = os.path.join(self.folder, "ours.exr")
        seconds = self.run("reference", self.scene, "-o", path, "--lat-long", "--resolution",
                           f"{px}x{px}", *how)
        return rgb(path), seconds

    def replaced(self, px):
        """True in and beside pixels that the comparison leaves out."""
        path = os.path.join(self.folder, "flags.exr")
        self.run("reference", self.scene, "-o", path, "--layers", "flags", "--positions", "1",
                 "--resolution", f"{4 * px}x{4 * px}")
        flags = numpy.array(mi.Bitmap(path), dtype=numpy.float64).reshape(4 * px, 4 * px)
        here = (flags.astype(int) & REPLACED != 0).reshape(px, 4, px, 4).any(axis=(1, 3))
        wide = numpy.pad(here, 1)
        return numpy.any([wide[y:y + px, x:x + px] for y in range(3) for x in range(3)], axis=0)


def tree(k, cut):
    return ("--positions", str(k), "--cut", repr(cut))


def paths(seed, split, *where):
    return ("--estimator", "paths", "--batches", "1", "--seed", str(seed), "--split", repr(split),
            *where)


def ways(seed):
    """What snell does with how much effort, the least first."""
    found = {"tree": [tree(k, 1e-2) for k in CELLS]}
    for split in (1 / 16, 1 / 32):
        name = f"1/{round(1 / split)}"
        found[f"lattice {name}"] = [paths(seed, split, "--lattice", "--samples", str(n))
                                    for n in LATTICES]
        found[f"cells {name}"] = [paths(seed, split, "--positions", str(k)) for k in CELLS]
    return found


def rgb(path):
    bitmap = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32,
                                     srgb_gamma=False)
    return numpy.array(bitmap, dtype=numpy.float64)


def theirs(scene, samples, seed):
    """An image and its processor time, kernels compiled before."""
    before = used(resource.RUSAGE_SELF)
    image = numpy.array(mi.render(scene, spp=samples, seed=seed), dtype=numpy.float64)[..., :3]
    return image, used(resource.RUSAGE_SELF) - before


def seconds_at(ladder, wanted):
    """Least time to an error, and how: times between errors, on logarithms."""
    best = (math.inf, "none")
    for way, points in ladder.items():
        points = sorted(points)
        for (e0, t0), (e1, t1) in zip(points, points[1:]):
            if e0 <= wanted <= e1 and e1 > e0:
                part = math.log(wanted / e0) / math.log(e1 / e0)
                best = min(best, (t0 * (t1 / t0) ** part, str(way)))
        if points[-1][0] < wanted:
            best = min(best, (points[-1][1], str(way)))
    return best


def judge(name, shape, normals, program, folder, px, repetitions):
    scene_file = os.path.join(folder, "scene.toml")
    with open(scene_file, "w", encoding="utf-8") as file:
        file.write(TEXT.format(px=px, shape=shape, normals=normals))
    ours = Snell(program, folder, scene_file)
    exported = os.path.join(folder, f"{shape}-{normals}")
    ours.run("export", scene_file, "--to", "mitsuba", "-o", exported)
    kept = ~ours.replaced(px)
    truth, _ = ours.image(px, *tree(*TRUTH))

    def error(image):
        return float(numpy.sqrt(((image - truth)[kept] ** 2).mean()))

    start = min(ours.run("reference", scene_file, "-o", os.path.join(folder, "one.exr"),
                         "--lat-long", "--resolution", "1x1") for _ in range(3))
    scene = mi.load_file(os.path.join(exported, "scene.xml"), max_depth=256)
    theirs(scene, 16, 0)
    reached, images = {}, []
    for samples in SAMPLES:
        found = [theirs(scene, samples, 1 + 100 * samples + turn) for turn in range(repetitions)]
        images = [image for image, _ in found]
        reached[samples] = ([error(image) for image in images], [time for _, time in found])
    least = min(min(errors) for errors, _ in reached.values())
    ladders = []
    for turn in range(repetitions):
        ladder = {}
        for way, efforts in ways(turn).items():
            points = ladder.setdefault(way, [])
            for how in efforts:
                image, seconds = ours.image(px, *how)
                points.append((error(image), max(seconds - start, 1e-3)))
                if points[-1][0] < least:
                    break
        ladders.append(ladder)
    rows = []
    for samples, (errors, seconds) in reached.items():
        wanted, seconds = float(numpy.median(errors)), sorted(seconds)
        needed = sorted(seconds_at(ladder, wanted) for ladder in ladders)
        rows.append({
            "samples": samples,
            "rmse": wanted,
            "mitsuba_cpu_s": seconds[len(seconds) // 2],
            "snell_cpu_s": needed[len(needed) // 2][0],
            "snell_by": needed[len(needed) // 2][1],
            "ratio": needed[len(needed) // 2][0] / seconds[len(seconds) // 2],
            "ratio_low": needed[0][0] / seconds[-1],
            "ratio_high": needed[-1][0] / seconds[0],
        })
    mean = numpy.mean(images, axis=0)
    # The error of a pixel is its distance from the truth; of the mean, that over the root.
    apart = float((mean - truth)[kept].mean())
    of_mean = error(mean) / math.sqrt(3 * kept.sum())
    print(json.dumps({
        "schema": "snell.bench.mitsuba/1", "scene": name, "mitsuba": mi.__version__,
        "variant": mi.variant(), "resolution_px": px, "repetitions": repetitions,
        "left_out": float(1 - kept.mean()), "mean_difference_in_se": apart / of_mean,
        "relative_mean_difference": apart / float(truth[kept].mean()), "rows": rows,
    }), flush=True)


def main():
    program, folder, px, repetitions = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    for name, (shape, normals) in SCENES.items():
        print(f"snell bench: {name}", file=sys.stderr, flush=True)
        judge(name, shape, normals, program, folder, px, repetitions)


if __name__ == "__main__":
    find_llvm()
    try:
        import mitsuba as mi
        import numpy
    except ImportError as missing:
        sys.exit(f"error: {missing}\ninstall it: python3 -m venv mitsuba && mitsuba/bin/pip install "
                 "mitsuba numpy, and write PYTHON=mitsuba/bin/python\n"
                 "on Debian also: apt-get install libllvm19")
    mi.set_variant("llvm_ad_rgb")
    main()
