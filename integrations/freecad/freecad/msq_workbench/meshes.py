# SPDX-License-Identifier: Apache-2.0
"""Meshes from FreeCAD to msq and back, as binary STL: lists of vertices and facets take a hundred times as
long. STL rounds coordinates to single precision."""
import collections
import hashlib
import io
import os
import tempfile
import threading

import Mesh
import MeshPart

from .library import context, msq

_ANGULAR_DEFLECTION = 0.3  # radians, of a facet of a curved face
_MOST_SHAPES = 8

_shapes = collections.OrderedDict()  # digest of an STL file: msq.Shape with its trees
_lock = threading.Lock()


def mesh_of(source, deflection):
    """The mesh of an object that has a Shape or a Mesh, in the coordinates of the document.
    deflection: the greatest distance of facets from a curved face, in millimetres."""
    if source is None:
        raise ValueError("Source is empty; it must be an object with a shape or a mesh")
    shape, mesh = getattr(source, "Shape", None), getattr(source, "Mesh", None)
    if isinstance(mesh, Mesh.Mesh):
        mesh = mesh.copy()
    elif shape is None or not hasattr(shape, "Solids"):
        raise ValueError(f"Source is {source.Label!r}, which has neither a shape nor a mesh")
    elif not shape.Solids:
        raise ValueError(f"Source is {source.Label!r}, whose shape has no solid")
    else:
        mesh = MeshPart.meshFromShape(Shape=shape, LinearDeflection=deflection,
                                      AngularDeflection=_ANGULAR_DEFLECTION)
    # Shape and Mesh have the object's own placement in them, not those of the parts around it.
    around = source.getGlobalPlacement().multiply(source.Placement.inverse())
    if not around.isIdentity():
        mesh.transform(around.toMatrix())
    return mesh


def stl_of(source, deflection):
    """The bytes of a binary STL of such an object."""
    if deflection <= 0:
        raise ValueError(f"Deflection is {deflection:g} mm; it must be more than 0")
    mesh = mesh_of(source, deflection)
    if mesh.CountFacets == 0:
        raise ValueError(f"Source is {source.Label!r}, whose mesh has no facets")
    with tempfile.TemporaryDirectory(prefix="msq-") as folder:  # Mesh.write takes no stream
        path = os.path.join(folder, "source.stl")
        mesh.write(Filename=path, Format="STL")
        with open(path, "rb") as file:
            return file.read()


def shape_of(stl, job):
    """The msq.Shape of an STL file. The last few are kept, with the trees that rays and slices use.
    Calls nothing of FreeCAD, so any thread may call it."""
    digest = hashlib.blake2b(stl, digest_size=16).digest()
    with _lock:
        shape = _shapes.pop(digest, None)
    if shape is None:
        shape = msq().Shape.from_memory(stl, "stl", context=context(), job=job)
    with _lock:
        _shapes[digest] = shape
        while len(_shapes) > _MOST_SHAPES:
            _shapes.popitem(last=False)
    return shape


def boundary_of(model, pitch, job):
    """The boundary of an msq.Model as the bytes of a binary STL, for any thread."""
    stl = io.BytesIO()
    model.save_mesh(stl, pitch, format="stl", job=job)
    return stl.getvalue()


def mesh_from(stl):
    """A Mesh.Mesh of a binary STL."""
    mesh = Mesh.Mesh()
    if len(stl) > 84:  # else it has no triangles, which FreeCAD does not read
        mesh.read(Stream=io.BytesIO(stl), Format="STL")
    return mesh
