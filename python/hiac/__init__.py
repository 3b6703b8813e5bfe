"""hiac: reference volume renderer for unstructured finite-element data.

    import hiac
    mesh = hiac.read("run.vtu")
    view = hiac.starter_view(mesh, field="pressure")
    picture = hiac.render(mesh, view)      # shown by a notebook
    picture.save("run.png")

Pictures, orders and meshes are those of the command-line tools, bit for bit. Arrays go in and out
without copies where memory allows it.
"""
from . import paraview
from ._check import Report, check
from ._compare import Comparison, compare
from ._core import Cancellation
from ._core import version as __version__
from ._exchange import from_meshio, from_pyvista, from_vtk, to_meshio, to_pyvista, to_vtk
from ._judge import Judgement, judge
from ._mesh import KINDS, NODES_OF_KIND, Field, Mesh
from ._notebook import ProgressBar, panel, rfb_view
from ._order import Order, sort
from ._picture import Picture, explain_pixel, render
from ._reading import read, write
from ._view import View, starter_view
from ._work import preview, tetrahedralize
from .errors import Cancelled, Error, InputError, JudgementError, PictureWarning, UsageError

__all__ = [
    "KINDS", "NODES_OF_KIND", "Cancellation", "Cancelled", "Comparison", "Error", "Field",
    "InputError", "Judgement", "JudgementError", "Mesh", "Order", "Picture", "PictureWarning", "ProgressBar",
    "Report", "UsageError", "View", "__version__", "check", "compare", "explain_pixel",
    "from_meshio", "from_pyvista", "from_vtk", "judge", "panel", "paraview", "preview", "read", "render", "rfb_view",
    "sort", "starter_view", "tetrahedralize", "to_meshio", "to_pyvista", "to_vtk", "write",
]
