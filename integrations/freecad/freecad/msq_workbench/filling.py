# SPDX-License-Identifier: Apache-2.0
"""The document object of a filled solid: its parameters, and a preview that follows them."""
import FreeCAD
import Mesh

from . import meshes, waiting
from .library import context, msq
from .properties import HIDDEN, SHOWN, Property, Proxy, add, number

KINDS = ["Foam", "Closed foam", "Lattice", "TPMS sheet", "TPMS network"]
UNIT_CELLS = ["bcc", "cubic", "octet", "fcc", "kelvin", "diamond", "rhombic dodecahedron", "reentrant"]
FUNCTIONS = ["gyroid", "schwarz p", "diamond", "i wp", "neovius", "f rd", "lidinoid", "split p",
             "fischer koch s", "c y", "c plus minus y", "karcher k", "g prime",
             "double gyroid", "double diamond", "double p", "honeycomb", "rods"]

# The properties that a kind has beside those that all have.
OF_KIND = {"Foam": ("Radius", "TopRadius", "Jitter", "Seed"),
           "Closed foam": ("WallThickness", "Jitter", "Seed"),
           "Lattice": ("UnitCell", "Radius", "TopRadius"),
           "TPMS sheet": ("Function", "WallThickness"),
           "TPMS network": ("Function", "Level")}

_UNIT = (0.0, 0.0, 1.0, 0.01)  # value, least, greatest and step
PROPERTIES = [
    Property("Source", "Link", "Filling", "The solid that is filled: an object with a shape or a mesh"),
    Property("Kind", "Enumeration", "Filling", "What fills it", KINDS),
    Property("UnitCell", "Enumeration", "Filling", "Struts of a cell of the lattice", UNIT_CELLS),
    Property("Function", "Enumeration", "Filling", "The triply periodic surface", FUNCTIONS),
    Property("CellSize", "Length", "Filling", "Edge of a cell; cells start at the document's origin", 5.0),
    Property("Radius", "Length", "Filling", "Radius of struts, at the bottom if TopRadius is not 0", 0.5),
    Property("TopRadius", "Length", "Filling", "Radius of struts at the top of the solid; 0: as Radius", 0.0),
    Property("WallThickness", "Length", "Filling", "Thickness of walls", 0.6),
    Property("Level", "Float", "Filling", "The network is where the function is at most this", 0.0),
    Property("Jitter", "FloatConstraint", "Filling", "0: a regular foam; 1: a random one",
             (1.0, *_UNIT[1:])),
    Property("Seed", "IntegerConstraint", "Filling", "Number of the random foam", (0, 0, 2**31 - 1, 1)),
    Property("Skin", "Length", "Filling", "Thickness of a solid skin; 0: none", 0.0),
    Property("Deflection", "Length", "Filling", "Greatest distance of the source's facets from its faces", 0.05),
    Property("Preview", "Bool", "Preview", "Whether the mesh is computed", True),
    Property("PreviewPitch", "Length", "Preview", "Distance of the samples of the mesh; 0: a tenth of a cell", 0.0),
    Property("PreviewVolume", "Volume", "Preview", "Volume of the mesh", 0.0, True),
    Property("PreviewFacets", "Integer", "Preview", "Number of its triangles", 0, True),
]


class Filling(Proxy):
    """The proxy of a Mesh::FeaturePython."""

    TYPE = "msq::Filling"

    def __init__(self, obj):
        obj.Proxy = self
        add(obj, PROPERTIES)
        _show_properties_of_kind(obj)

    def onDocumentRestored(self, obj):  # by an older workbench, perhaps
        add(obj, PROPERTIES)
        _show_properties_of_kind(obj)

    def onChanged(self, obj, name):
        if name == "Kind" and "Skin" in obj.PropertiesList:
            _show_properties_of_kind(obj)

    def execute(self, obj):
        """Computes the preview. What it raises is the object's error in the tree, and in the report view;
        the mesh stays as it was."""
        if not obj.Preview:
            _set_preview(obj, Mesh.Mesh())
            return
        pitch, build = preview_pitch(obj), recipe_of(obj)
        stl = waiting.run(f"Preview of {obj.Label}",
                          lambda job: meshes.boundary_of(build(job), pitch, job))
        _set_preview(obj, meshes.mesh_from(stl))


def make(source=None, document=None, name="Filling"):
    """Adds a filling of the source to the document; the next recompute makes its preview."""
    document = document or (source.Document if source else FreeCAD.ActiveDocument)
    obj = document.addObject("Mesh::FeaturePython", name)
    Filling(obj)
    if FreeCAD.GuiUp:
        from .view import FillingView
        FillingView(obj.ViewObject)
    if source is not None:
        obj.Source = source
        obj.Label = f"{source.Label} filled"
    return obj


def is_filling(obj):
    return isinstance(getattr(obj, "Proxy", None), Filling)


def preview_pitch(obj):
    """The pitch of the preview, in millimetres."""
    return number(obj, "PreviewPitch") or number(obj, "CellSize") / 10


def recipe_of(obj):
    """A function of a job that makes the msq.Model of a filling, in the coordinates of the document.
    It has read the document, and calls nothing of FreeCAD: any thread may call it."""
    stl = meshes.stl_of(obj.Source, number(obj, "Deflection"))
    values = {given.name: number(obj, given.name) for given in PROPERTIES
              if given.type in ("Length", "Float", "FloatConstraint")}
    values.update({name: getattr(obj, name) for name in ("Kind", "UnitCell", "Function", "Seed")})

    def build(job=None):
        shape = meshes.shape_of(stl, job)
        return msq().Model(shape, [msq().Scale(_structure(values, shape.info), skin=values["Skin"])])

    return build


def _structure(values, info):
    kind = values["Kind"]
    cells = {"cell_size": values["CellSize"], "context": context()}
    random = {"jitter": values["Jitter"], "seed": values["Seed"]}
    if kind == "Foam":
        return msq().Foam(radius=_radius(values, info), **random, **cells)
    if kind == "Closed foam":
        return msq().Foam(wall_thickness=values["WallThickness"], **random, **cells)
    if kind == "Lattice":
        return msq().Lattice(values["UnitCell"], radius=_radius(values, info), **cells)
    if kind == "TPMS sheet":
        return msq().Functional(values["Function"], kind="sheet",
                                thickness=values["WallThickness"], **cells)
    return msq().Functional(values["Function"], kind="network", level=values["Level"], **cells)


def _radius(values, info):
    bottom, top = values["Radius"], values["TopRadius"]
    if top in (0, bottom):
        return bottom
    return msq().Field.gradient((0, 0, info.min[2]), bottom, (0, 0, info.max[2]), top,
                                context=context())


def _set_preview(obj, mesh):
    obj.Mesh = mesh
    obj.PreviewVolume = mesh.Volume if mesh.CountFacets else 0
    obj.PreviewFacets = mesh.CountFacets


def _show_properties_of_kind(obj):
    every = {name for names in OF_KIND.values() for name in names}
    for name in every:
        obj.setEditorMode(name, SHOWN if name in OF_KIND[obj.Kind] else HIDDEN)
