"""How wrong is real-time refraction, and what does it cost?

Studies of the program ``snell`` as pandas data frames. Everything is computed by the
program, in a process of its own: what fails there raises :class:`SnellError` here.

    import snell
    frame = snell.study("ball", methods=["two-interface"], resolution=128)
    frame.pivot_metrics()[["exit_angle_median_deg", "flip_hdr"]]

Units are in the names: ``_deg``, ``_ms``, ``_px``, ``_m``. Lengths of scenes are metres,
indices of refraction are absolute.
"""

from snell.frame import Frame, MetricError
from snell.images import attributes, compare, layers, read
from snell.process import SnellError, SnellWarning, call, program
from snell.scenes import Scene
from snell.studies import results, study
from snell.viewer import Viewer

__all__ = [
    "Frame",
    "MetricError",
    "Scene",
    "SnellError",
    "SnellWarning",
    "Viewer",
    "attributes",
    "call",
    "compare",
    "layers",
    "program",
    "read",
    "results",
    "study",
]
