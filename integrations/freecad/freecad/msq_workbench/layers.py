# SPDX-License-Identifier: Apache-2.0
"""The document object of a filling's layers: a stack of faces, whose borders are its contours."""
import FreeCAD
import Part

from . import filling as fillings
from . import waiting
from .library import msq
from .properties import Property, Proxy, add, number

PROPERTIES = [
    Property("Filling", "Link", "Layers", "What is sliced"),
    Property("LayerHeight", "Length", "Layers", "Distance of layers; each is cut at its middle", 1.0),
    Property("FirstLayer", "Integer", "Layers", "The lowest layer shown, from 0", 0),
    Property("LayerCount", "Integer", "Layers", "Number of layers shown; 0: to the top", 0),
    Property("Tolerance", "Length", "Layers", "Greatest distance of contours from the boundary", 0.05),
    Property("Pitch", "Length", "Layers", "Size of the smallest feature that is not lost, over 1.4; 0: twice "
             "the tolerance", 0.0),
    Property("Heights", "FloatList", "Result", "z of the layers", None, True),
    Property("Areas", "FloatList", "Result", "Solid area of the layers, in square millimetres", None, True),
]


class Layers(Proxy):
    """The proxy of a Part::FeaturePython."""

    TYPE = "msq::Layers"

    def __init__(self, obj):
        obj.Proxy = self
        add(obj, PROPERTIES)

    def onDocumentRestored(self, obj):
        add(obj, PROPERTIES)

    def execute(self, obj):
        if not fillings.is_filling(obj.Filling):
            raise ValueError("Filling is empty; it must be an object that Fill with… made")
        found = contours_of(obj)
        obj.Shape = Part.Compound([Part.Compound(_faces(contours, z)) for z, contours in found])
        obj.Heights = [z for z, _ in found]
        obj.Areas = [_area(contours) for _, contours in found]


def make(filling, name="Layers"):
    """Adds the layers of a filling to its document; the next recompute computes them."""
    obj = filling.Document.addObject("Part::FeaturePython", name)
    Layers(obj)
    if FreeCAD.GuiUp:
        from .view import LayersView
        LayersView(obj.ViewObject)
    obj.Filling = filling
    obj.Label = f"Layers of {filling.Label}"
    return obj


def contours_of(obj):
    """(z, msq.Contours) of each layer."""
    tolerance, height = number(obj, "Tolerance"), number(obj, "LayerHeight")
    pitch = number(obj, "Pitch") or 2 * tolerance
    first, count = obj.FirstLayer, obj.LayerCount
    build = fillings.recipe_of(obj.Filling)

    def slice_layers(job):
        output = msq().Output("contours", tolerance=tolerance, pitch=pitch)
        slicer = build(job).slicer(layer_height=height, pitch=pitch, output=[output])
        if first < 0 or count < 0 or first >= len(slicer) or first + count > len(slicer):
            raise ValueError(f"FirstLayer is {first} and LayerCount {count}; there are {len(slicer)} "
                             "layers")
        found = []
        slicer.run(lambda layer: found.append((layer.z, layer.contours())), first,
                   count or len(slicer) - first, job=job)
        return found

    return waiting.run(f"Layers of {obj.Filling.Label}", slice_layers)


def _faces(contours, z):
    """A face for each outer ring, with its holes."""
    holes = {}
    for ring, parent in enumerate(contours.parents):
        if contours.holes[ring]:
            holes.setdefault(int(parent), []).append(_wire(contours[ring], z))
    return [Part.Face([_wire(contours[ring], z), *holes.get(ring, ())])
            for ring in range(len(contours)) if not contours.holes[ring]]


def _wire(ring, z):
    points = [FreeCAD.Vector(x, y, z) for x, y in ring.tolist()]
    return Part.makePolygon(points + points[:1])


def _area(contours):
    """Of the rings: holes run the other way round, and count as negative."""
    total = 0.0
    for ring in contours:
        x, y = (ring - ring[0]).T
        total += 0.5 * float((x[:-1] * y[1:] - x[1:] * y[:-1]).sum())
    return total
