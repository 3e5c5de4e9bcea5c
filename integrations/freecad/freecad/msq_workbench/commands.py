# SPDX-License-Identifier: Apache-2.0
"""The commands of the workbench. They work on what is selected."""
import os
import traceback

import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import export
from . import filling as fillings
from . import layers
from .library import icon, msq
from .properties import number


def show_error(title, error):
    """Says what failed in a message box, and where in the report view."""
    FreeCAD.Console.PrintError("".join(traceback.format_exception(error)) + "\n")
    QtGui.QMessageBox.critical(FreeCADGui.getMainWindow(), title, str(error) or type(error).__name__)


def selected_filling():
    """The first filling that is selected, or that selected layers are of; None if there is none."""
    for obj in FreeCADGui.Selection.getSelection():
        for found in (obj, getattr(obj, "Filling", None)):
            if fillings.is_filling(found):
                return found
    return None


def _recompute(*objects):
    """Ends the transaction, if all of the objects succeed. FreeCAD does not execute what follows from an
    object that failed."""
    document = objects[0].Document
    document.recompute()
    for obj in objects:
        if not obj.isValid():
            raise RuntimeError(f"{obj.Label}: {obj.getStatusString()}")
    document.commitTransaction()


class _Command:
    """A command whose failures are shown, and undone."""

    TEXT = TIP = ICON = ""

    def GetResources(self):
        return {"MenuText": self.TEXT, "ToolTip": self.TIP, "Pixmap": icon(self.ICON)}

    def IsActive(self):
        return selected_filling() is not None

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(self.TEXT)
        try:
            self.run()
        except Exception as error:  # FreeCAD would only print it
            document.abortTransaction()
            show_error(self.TEXT, error)

    def run(self):
        raise NotImplementedError


class Fill(_Command):
    ICON = "fill"
    TEXT, TIP = "Fill with…", "Fill the selected solid with a foam, a lattice or a TPMS"

    def IsActive(self):
        return len(FreeCADGui.Selection.getSelection()) == 1

    def run(self):
        msq()  # its absence is said now
        from .task_panel import TaskPanel
        source = FreeCADGui.Selection.getSelection()[0]
        filling = fillings.make(source)
        source.ViewObject.Visibility = False
        FreeCADGui.Control.showDialog(TaskPanel(filling))  # which ends the transaction


class Preview(_Command):
    ICON = "preview"
    TEXT, TIP = "Preview", "Compute the preview mesh of the filling, or drop it"

    def run(self):
        filling = selected_filling()
        filling.Preview = not (filling.Preview and filling.PreviewFacets)
        filling.touch()
        _recompute(filling)


class Slice(_Command):
    ICON = "slice"
    TEXT, TIP = "Slice", "Add the layers of the filling to the document, as faces"

    def run(self):
        filling = selected_filling()
        made = layers.make(filling)
        made.LayerHeight = number(filling, "CellSize") / 5
        _recompute(filling, made)


class Export(_Command):
    ICON = "export"
    TEXT, TIP = "Export…", ("Write the filling as STL, PLY or 3MF, or its layers as a folder of PNGs or as SL1 "
                            "for a resin printer")

    def run(self):
        filling = selected_filling()
        filling.Document.abortTransaction()  # nothing changes
        path, chosen = QtGui.QFileDialog.getSaveFileName(
            FreeCADGui.getMainWindow(), "Export the filling", filling.Label,
            "STL (*.stl);;PLY (*.ply);;3MF (*.3mf);;SL1 (*.sl1);;Folder of PNG layers (*)")
        if not path:
            return
        if "PNG" in chosen:
            height, agreed = QtGui.QInputDialog.getDouble(
                FreeCADGui.getMainWindow(), "Export the filling", "Layer height and pixel in mm", 0.05,
                0.001, 1000, 3)
            if agreed:
                export.save_images(filling, path, height, height)
            return
        if "SL1" in chosen:
            height, agreed = QtGui.QInputDialog.getDouble(
                FreeCADGui.getMainWindow(), "Export the filling", "Layer height in mm", 0.05, 0.001, 1000, 3)
            if agreed:
                export.save_sl1(filling, path if os.path.splitext(path)[1] else path + ".sl1", height)
            return
        suffix = {"STL": ".stl", "PLY": ".ply", "3MF": ".3mf"}[chosen[:3]]
        if not os.path.splitext(path)[1]:
            path += suffix
        export.save_mesh(filling, path)


COMMANDS = {"Msq_Fill": Fill, "Msq_Preview": Preview, "Msq_Slice": Slice, "Msq_Export": Export}


def register():
    """Gives the commands to FreeCAD; returns their names."""
    for name, command in COMMANDS.items():
        FreeCADGui.addCommand(name, command())
    return list(COMMANDS)
