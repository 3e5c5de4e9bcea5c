# SPDX-License-Identifier: Apache-2.0
"""Drives the installed workbench in FreeCAD's window, through its commands and its task panel: freecad
test_window.py. scripts/test_freecad runs it. MSQ_PICTURE: where to save a picture of the window."""
import os
import sys
import tempfile
import traceback

import FreeCAD
import FreeCADGui
import Part
from PySide import QtCore, QtGui

WIDTH, HEIGHT = 1300, 820


def settle(seconds=0.3):
    """Lets the window work."""
    end = QtCore.QTime.currentTime().addMSecs(int(1000 * seconds))
    while QtCore.QTime.currentTime() < end:
        QtGui.QApplication.processEvents()


def bracket():
    foot = Part.makeBox(46, 24, 6)
    back = Part.makeBox(6, 24, 34)
    bearing = Part.makeCylinder(11, 14, FreeCAD.Vector(30, 12, 0))
    hole = Part.makeCylinder(5, 40, FreeCAD.Vector(30, 12, -5))
    return foot.fuse([back, bearing]).cut(hole).removeSplitter()


def check(condition, what):
    if not condition:
        raise AssertionError(what)
    print("ok:", what, flush=True)


def panel_of(filling):
    """The open task panel; FreeCAD gives no way to it but the widgets."""
    import gc

    from freecad.msq_workbench.task_panel import TaskPanel
    return next(panel for panel in gc.get_objects()
                if isinstance(panel, TaskPanel) and panel.obj is filling)


class Presser(QtCore.QObject):
    """Presses a button of the first dialog of a class that appears, and keeps its text."""

    def __init__(self, kind, press):
        super().__init__()
        self.text, self._kind, self._press = None, kind, press
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._look)
        self._timer.start(20)

    def _look(self):
        for widget in QtGui.QApplication.topLevelWidgets():
            if isinstance(widget, self._kind) and widget.isVisible():
                self._timer.stop()
                self.text = widget.text() if hasattr(widget, "text") else widget.labelText()
                self._press(widget)
                return


def drive():
    from freecad.msq_workbench import export, filling, layers
    FreeCADGui.activateWorkbench("MsqWorkbench")
    check(FreeCADGui.activeWorkbench().name() == "MsqWorkbench", "the workbench is there")
    window = FreeCADGui.getMainWindow()
    window.resize(WIDTH, HEIGHT)
    for dock in window.findChildren(QtGui.QDockWidget):  # the tree stays
        if dock.objectName() in ("Report view", "Python console", "Selection view"):
            dock.close()
        elif dock.objectName() == "Combo View":
            window.resizeDocks([dock], [330], QtCore.Qt.Horizontal)

    document = FreeCAD.newDocument("Bracket")
    part = document.addObject("Part::Feature", "Bracket")
    part.Shape = bracket()
    document.recompute()
    FreeCADGui.Selection.addSelection(part)
    FreeCADGui.runCommand("Msq_Fill")
    settle()
    made = next(obj for obj in document.Objects if filling.is_filling(obj))
    check(FreeCADGui.Control.activeDialog(), "Fill with… opens the task panel")
    panel = panel_of(made)
    for name, value in {"CellSize": 4.0, "Radius": 0.7, "TopRadius": 0.3, "Skin": 0.0,
                        "PreviewPitch": 0.2}.items():
        panel._inputs[name].setProperty("rawValue", value)
    panel.clicked(int(QtGui.QDialogButtonBox.Apply))
    check(made.isValid() and made.Mesh.isSolid(), "Apply makes a closed solid")
    made.ViewObject.ShapeColor = (0.36, 0.60, 0.85)
    part.ViewObject.Visibility = True
    part.ViewObject.Transparency = 88
    part.ViewObject.LineColor = (0.9, 0.9, 0.95)
    FreeCADGui.Selection.clearSelection()
    view = FreeCADGui.ActiveDocument.ActiveView
    view.setAnimationEnabled(False)
    view.viewIsometric()
    view.fitAll()
    settle(1.5)
    view.fitAll()
    settle(1.5)
    picture = os.environ.get("MSQ_PICTURE")
    if picture:
        check(save_window(window, picture), f"a picture in {picture}")

    panel._inputs["CellSize"].setProperty("rawValue", 0.0)
    check(not panel.accept(), "a cell size of 0 is refused")
    check("cell" in panel._status.text(), f"and the panel says: {panel._status.text()}")
    panel._inputs["CellSize"].setProperty("rawValue", 4.0)
    panel.accept()
    settle()
    check(not FreeCADGui.Control.activeDialog(), "OK closes the panel")

    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(made)
    FreeCADGui.runCommand("Msq_Slice")
    stack = next(obj for obj in document.Objects if isinstance(getattr(obj, "Proxy", None), layers.Layers))
    check(len(stack.Areas) == 43, "Slice makes layers")
    FreeCADGui.runCommand("Msq_Preview")
    check(made.Mesh.CountFacets == 0, "Preview drops the mesh")
    FreeCADGui.runCommand("Msq_Preview")
    check(made.Mesh.CountFacets == made.PreviewFacets > 0, "Preview makes it again")

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "part.stl")
        export.save_mesh(made, path)
        check(os.path.getsize(path) == 84 + 50 * made.PreviewFacets, "Export writes STL")
        print("cancelling", flush=True)
        presser = Presser(QtGui.QProgressDialog, lambda dialog: dialog.cancel())
        try:
            export.save_mesh(made, os.path.join(folder, "fine.stl"), 0.03)
            check(False, "Cancel stops an export")
        except Exception as error:
            check("cancel" in str(error), f"Cancel stops an export: {presser.text}; {error}")
        check(os.listdir(folder) == ["part.stl"], "and leaves no file")

    made.CellSize = 0.0
    document.recompute()
    presser = Presser(QtGui.QMessageBox, lambda box: box.accept())
    FreeCADGui.runCommand("Msq_Slice")
    settle()
    check(presser.text and "cell" in presser.text, f"a message box says: {presser.text}")
    document.undo()
    count = len(document.Objects)

    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(part)
    FreeCADGui.runCommand("Msq_Fill")
    settle()
    added = document.Objects[-1]
    check(len(document.Objects) == count + 1 and filling.is_filling(added), "a second filling")
    panel_of(added).reject()
    check(len(document.Objects) == count, "Cancel takes it back")


def save_window(window, path):
    """The window as it is on the screen, with the 3D view."""
    screen = QtGui.QApplication.primaryScreen()
    return screen.grabWindow(window.winId()).save(path)


def main():
    status = 1
    try:
        drive()
        status = 0
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # FreeCAD would ask about the document


QtCore.QTimer.singleShot(1500, main)
