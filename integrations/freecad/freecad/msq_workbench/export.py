# SPDX-License-Identifier: Apache-2.0
"""Files of a filling. Each is written under another name beside its own and renamed at the end, so a
failure leaves none."""
import os
import shutil
import tempfile

from . import meshes, waiting
from .filling import preview_pitch, recipe_of

MESH_FORMATS = (".stl", ".ply", ".3mf")


def save_mesh(obj, path, pitch=0.0):
    """Writes the filling's boundary to an STL, PLY or 3MF file. pitch: distance of the samples, in
    millimetres; 0: that of the preview. STL and PLY are streamed; FreeCAD writes 3MF, and holds the
    mesh for it."""
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in MESH_FORMATS:
        raise ValueError(f"the file is {os.path.basename(path)!r}; its name must end in "
                         f"{', '.join(MESH_FORMATS)}")
    pitch, build = pitch or preview_pitch(obj), recipe_of(obj)
    with _replaced(path, suffix) as temporary:
        label = f"Writing {os.path.basename(path)}"
        if suffix == ".3mf":
            mesh = meshes.mesh_from(waiting.run(
                label, lambda job: meshes.boundary_of(build(job), pitch, job)))
            if mesh.CountFacets == 0:
                raise ValueError(f"{obj.Label!r} has nothing solid, and 3MF needs something")
            mesh.write(Filename=temporary, Format="3MF")
        else:
            waiting.run(label, lambda job: build(job).save_mesh(temporary, pitch, job=job))


def save_images(obj, folder, layer_height, pitch):
    """Writes the layers as one-bit PNGs, layer_00000.png being the lowest, to a folder that does not exist
    yet. White is solid; y is up. Lengths are in millimetres. Returns the number of layers."""
    if os.path.exists(folder):
        raise FileExistsError(f"{folder} exists; layers need a new folder")
    from PySide import QtGui  # each FreeCAD has it, also without a window
    build = recipe_of(obj)

    def write(job):
        slicer = build(job).slicer(layer_height=layer_height, pitch=pitch)
        temporary = tempfile.mkdtemp(prefix=".msq-", dir=os.path.dirname(os.path.abspath(folder)))
        try:
            def save(layer):
                rows = layer.rows[::-1].tobytes()
                image = QtGui.QImage(rows, layer.width, layer.height, layer.rows.shape[1],
                                     QtGui.QImage.Format_Mono)
                image.setColorTable([0xFF000000, 0xFFFFFFFF])
                name = os.path.join(temporary, f"layer_{layer.index:05}.png")
                if not image.save(name):
                    raise OSError(f"{os.path.basename(name)} cannot be written to {folder}")

            slicer.run(save, job=job)
            os.chmod(temporary, 0o777 & ~_umask())
            os.rename(temporary, folder)
        except BaseException:
            shutil.rmtree(temporary, ignore_errors=True)
            raise
        return len(slicer)

    return waiting.run(f"Writing {os.path.basename(folder)}", write)


def save_sl1(obj, path, layer_height, pixels=(2560, 1440), size=(120.96, 68.04)):
    """Writes an SL1 archive for a resin printer, with the filling in the middle of the panel. pixels, size: of
    the panel along x and y, size in millimetres; those of the Original Prusa SL1 unless given. Returns
    the number of layers."""
    if not path.lower().endswith((".sl1", ".sl1s")):
        raise ValueError(f"the file is {os.path.basename(path)!r}; its name must end in .sl1 or .sl1s")
    try:
        import msq.io
    except ImportError as error:
        raise RuntimeError(f"SL1 needs the library msq_io: {error}") from error
    build, panel = recipe_of(obj), msq.io.Panel(pixels=pixels, size=size)

    def write(job):
        model = build(job)
        slicer = msq.io.panel_slicer(model, layer_height=layer_height, panel=panel)
        name = os.path.splitext(os.path.basename(path))[0]
        msq.io.save_sl1(slicer, path, panel=panel, name=name, thumbnail=model, replace=True, job=job)
        return len(slicer)

    return waiting.run(f"Writing {os.path.basename(path)}", write)


class _replaced:
    """Within `with`, the name of a file in the path's folder; then it is renamed to path, or removed after a
    failure."""

    def __init__(self, path, suffix):
        self._path = os.path.abspath(path)
        self._suffix = suffix

    def __enter__(self):
        handle, self._temporary = tempfile.mkstemp(self._suffix, ".msq-", os.path.dirname(self._path))
        os.close(handle)
        return self._temporary

    def __exit__(self, kind, _error, _trace):
        if kind is None:
            os.chmod(self._temporary, 0o666 & ~_umask())
            os.replace(self._temporary, self._path)
        else:
            os.unlink(self._temporary)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
