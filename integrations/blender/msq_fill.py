# SPDX-License-Identifier: Apache-2.0
"""An add-on for Blender: fills a mesh with a foam, a lattice or a TPMS of msq, as a new mesh.

See README.md beside this file. In scripts: bpy.ops.object.msq_fill(), with the active object's
properties in object.msq.
"""
import importlib
import threading

import bpy
import numpy as np

bl_info = {"name": "msq: fill with lattices and foams", "author": "the authors of msq",
           "version": (0, 1, 0), "blender": (3, 4, 0), "category": "Object",
           "location": "3D view, sidebar, msq",
           "description": "Fills a mesh with a foam, a lattice or a TPMS"}

KINDS = [("FOAM", "Foam", "Struts on the edges of a Voronoi diagram"),
         ("CLOSED_FOAM", "Closed foam", "Walls on the faces of a Voronoi diagram"),
         ("LATTICE", "Lattice", "Struts of a periodic cell"),
         ("SHEET", "TPMS sheet", "A triply periodic surface of some thickness")]
UNIT_CELLS = ["bcc", "cubic", "octet", "fcc", "kelvin", "diamond", "rhombic dodecahedron", "reentrant"]
FUNCTIONS = ["gyroid", "schwarz p", "diamond", "i wp", "neovius", "f rd", "lidinoid", "split p",
             "fischer koch s", "c y", "c plus minus y", "karcher k", "g prime",
             "double gyroid", "double diamond", "double p", "honeycomb", "rods"]


def named(names):
    """Items of an EnumProperty."""
    return [(name.upper().replace(" ", "_"), name.capitalize(), "") for name in names]


class MsqFillProperties(bpy.types.PropertyGroup):
    """What a mesh is filled with. Lengths are in Blender's units, in world space."""

    kind: bpy.props.EnumProperty(name="Kind", items=KINDS)
    unit_cell: bpy.props.EnumProperty(name="Unit cell", items=named(UNIT_CELLS))
    function: bpy.props.EnumProperty(name="Function", items=named(FUNCTIONS))
    cell_size: bpy.props.FloatProperty(name="Cell size", default=0.4, min=0, subtype="DISTANCE",
                                       description="Edge of a cell; cells start at the world's origin")
    radius: bpy.props.FloatProperty(name="Radius", default=0.04, min=0, subtype="DISTANCE",
                                    description="Radius of struts")
    thickness: bpy.props.FloatProperty(name="Thickness", default=0.05, min=0, subtype="DISTANCE",
                                       description="Thickness of walls")
    skin: bpy.props.FloatProperty(name="Skin", default=0, min=0, subtype="DISTANCE",
                                  description="Thickness of a solid skin; 0: none")
    jitter: bpy.props.FloatProperty(name="Jitter", default=1, min=0, max=1,
                                    description="0: a regular foam; 1: a random one")
    seed: bpy.props.IntProperty(name="Seed", default=0, min=0, description="Number of the random foam")
    pitch: bpy.props.FloatProperty(name="Pitch", default=0, min=0, subtype="DISTANCE",
                                   description="Distance of the samples of the mesh; 0: a tenth of a cell")


OF_KIND = {"FOAM": ("radius", "jitter", "seed"), "CLOSED_FOAM": ("thickness", "jitter", "seed"),
           "LATTICE": ("unit_cell", "radius"), "SHEET": ("function", "thickness")}


def as_typed(value):
    """A number as the user typed it: Blender keeps single precision, in which 0.4 is 0.400000006."""
    return float(f"{value:.7g}") if isinstance(value, float) else value


def load_msq():
    """The Python package msq."""
    try:
        return importlib.import_module("msq")
    except ImportError as error:
        raise ImportError("Blender cannot load the Python package msq; its place is the folder "
                          f"{bpy.utils.user_resource('SCRIPTS', path='addons/modules')} ({error})") from None


def triangles_of(obj, depsgraph):
    """Vertices (n, 3) in world space and triangles (m, 3) of an object, with its modifiers."""
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        vertices = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", vertices)
        triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", triangles)
    finally:
        evaluated.to_mesh_clear()
    matrix = np.array(evaluated.matrix_world)
    triangles = triangles.reshape(-1, 3).astype(np.uint32)
    if np.linalg.det(matrix[:3, :3]) < 0:  # mirrored
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return vertices.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], triangles


def fill(vertices, triangles, values, job):
    """The msq.Mesh of a filling. Calls nothing of Blender, so any thread may call it."""
    msq = load_msq()
    cells = {"cell_size": values["cell_size"]}
    random = {"jitter": values["jitter"], "seed": values["seed"]}
    if values["kind"] == "FOAM":
        structure = msq.Foam(radius=values["radius"], **random, **cells)
    elif values["kind"] == "CLOSED_FOAM":
        structure = msq.Foam(wall_thickness=values["thickness"], **random, **cells)
    elif values["kind"] == "LATTICE":
        structure = msq.Lattice(values["unit_cell"], radius=values["radius"], **cells)
    else:
        structure = msq.Functional(values["function"], kind="sheet", thickness=values["thickness"],
                                   **cells)
    shape = msq.Shape.from_mesh(vertices, triangles)
    model = msq.Model(shape, [msq.Scale(structure, skin=values["skin"])])
    return model.mesh(values["pitch"] or values["cell_size"] / 10, job=job)


def add_object(context, name, filled):
    """Adds the mesh as a new object, and makes it the active one."""
    count = len(filled.triangles)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(filled.vertices))
    mesh.vertices.foreach_set("co", filled.vertices.astype(np.float32).ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", filled.triangles.astype(np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))
    mesh.update(calc_edges=True)
    obj = bpy.data.objects.new(name, mesh)
    context.collection.objects.link(obj)
    for selected in context.selected_objects:
        selected.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj
    return obj


class OBJECT_OT_msq_fill(bpy.types.Operator):
    """Fill the active mesh with a foam, a lattice or a TPMS, as a new mesh. Esc cancels"""

    bl_idname = "object.msq_fill"
    bl_label = "Fill"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        """Waits for the mesh: for scripts. An interrupt from the keyboard cancels."""
        try:
            self._prepare(context)
            self._filled = self._call()
        except Exception as error:
            return self._fail(error)
        return self._finish(context)

    def invoke(self, context, _event):
        """Computes on another thread: for the window."""
        try:
            self._prepare(context)
        except Exception as error:
            return self._fail(error)
        self._error = self._filled = None

        def work():
            try:
                self._filled = self._call()
            except BaseException as error:  # reported by modal
                self._error = error

        self._thread = threading.Thread(target=work, name="msq")
        self._thread.start()
        manager = context.window_manager
        manager.progress_begin(0, 1)
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.cancel()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        manager = context.window_manager
        manager.progress_update(self._job.progress)
        if self._thread.is_alive():
            return {"RUNNING_MODAL"}
        manager.event_timer_remove(self._timer)
        manager.progress_end()
        return self._finish(context) if self._error is None else self._fail(self._error)

    def cancel(self, _context):  # Blender is closing
        self._job.cancel()
        self._thread.join()

    def _prepare(self, context):
        source = context.object
        self._job = load_msq().Job()
        self._name = f"{source.name} filled"
        vertices, triangles = triangles_of(source, context.evaluated_depsgraph_get())
        values = {name: as_typed(getattr(source.msq, name))
                  for name in MsqFillProperties.__annotations__}
        self._call = lambda: fill(vertices, triangles, values, self._job)

    def _finish(self, context):
        if len(self._filled.triangles) == 0:
            return self._fail(ValueError("nothing is solid: the structure is thinner than the pitch"))
        obj = add_object(context, self._name, self._filled)
        self.report({"INFO"}, f"{obj.name}: {len(self._filled.triangles)} triangles")
        return {"FINISHED"}

    def _fail(self, error):
        self.report({"ERROR"}, str(error) or type(error).__name__)
        return {"CANCELLED"}


class VIEW3D_PT_msq_fill(bpy.types.Panel):
    """The panel of the sidebar."""

    bl_label = "Fill"
    bl_category = "msq"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"

    def draw(self, context):
        obj = context.object
        if obj is None or obj.type != "MESH":
            self.layout.label(text="Select a mesh")
            return
        self.layout.use_property_split = True
        for name in ("kind", "cell_size", *OF_KIND[obj.msq.kind], "skin", "pitch"):
            self.layout.prop(obj.msq, name)
        self.layout.operator("object.msq_fill")


CLASSES = (MsqFillProperties, OBJECT_OT_msq_fill, VIEW3D_PT_msq_fill)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.msq = bpy.props.PointerProperty(type=MsqFillProperties)


def unregister():
    del bpy.types.Object.msq
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
