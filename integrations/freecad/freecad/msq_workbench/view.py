# SPDX-License-Identifier: Apache-2.0
"""How the objects look in the tree and in the 3D view."""
from .library import icon
from .properties import Proxy


class _View(Proxy):
    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.Object = view.Object

    def getIcon(self):
        return icon()


class FillingView(_View):
    """Of a filling: a double click opens its task panel, and its source is below it."""

    def claimChildren(self):
        return [self.Object.Source] if self.Object.Source else []

    def setEdit(self, view, _mode=0):
        import FreeCADGui

        from .task_panel import TaskPanel
        FreeCADGui.Control.showDialog(TaskPanel(view.Object))
        return True

    def unsetEdit(self, _view, _mode=0):
        import FreeCADGui
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, view):
        view.Document.setEdit(view.Object.Name)
        return True


class LayersView(_View):
    """Of layers."""
