# SPDX-License-Identifier: Apache-2.0
"""FreeCAD runs this when it starts with a window."""
import FreeCADGui

from .library import icon


class MsqWorkbench(FreeCADGui.Workbench):
    """Lattices, foams and TPMS inside solids."""

    MenuText = "msq"
    ToolTip = "Fill solids with lattices, foams and TPMS"
    Icon = icon()

    def Initialize(self):
        from . import commands
        names = commands.register()
        self.appendToolbar("msq", names)
        self.appendMenu("msq", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(MsqWorkbench())
