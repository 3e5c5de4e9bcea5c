# SPDX-License-Identifier: Apache-2.0
"""The task panel of a filling: its parameters, and what became of them."""
import FreeCADGui
from PySide import QtGui

from . import filling as fillings
from .properties import number

_LABELS = {"CellSize": "Cell size", "UnitCell": "Unit cell", "TopRadius": "Radius at the top",
           "WallThickness": "Wall thickness", "PreviewPitch": "Preview pitch"}
_ROWS = ["Kind", "UnitCell", "Function", "CellSize", "Radius", "TopRadius", "WallThickness", "Level",
         "Jitter", "Seed", "Skin", "PreviewPitch"]


class TaskPanel:
    """Apply recomputes; Cancel takes all changes back, those of the command that made the object too."""

    def __init__(self, obj):
        self.obj = obj
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Fill with…")
        self._layout = QtGui.QFormLayout(self.form)
        source = obj.Source.Label if obj.Source else "none: select a solid first"
        self._layout.addRow("Solid", QtGui.QLabel(source))
        self._inputs = {name: self._input(name) for name in _ROWS}
        self._status = QtGui.QLabel()
        self._status.setWordWrap(True)
        self._layout.addRow(self._status)
        self._show_rows()
        self._show_status()
        if not obj.Document.HasPendingTransaction:
            obj.Document.openTransaction("Edit filling")

    def _input(self, name):
        kind = self.obj.getTypeIdOfProperty(name)
        value = getattr(self.obj, name)
        if kind == "App::PropertyEnumeration":
            widget = QtGui.QComboBox()
            widget.addItems(self.obj.getEnumerationsOfProperty(name))
            widget.setCurrentText(value)
            widget.currentTextChanged.connect(self._show_rows)
        elif kind == "App::PropertyLength":
            widget = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
            widget.setProperty("unit", "mm")
            widget.setProperty("minimum", 0.0)
            widget.setProperty("rawValue", number(self.obj, name))
        elif kind == "App::PropertyIntegerConstraint":
            widget = QtGui.QSpinBox()
            widget.setRange(0, 2**31 - 1)
            widget.setValue(value)
        else:
            widget = QtGui.QDoubleSpinBox()
            widget.setDecimals(3)
            widget.setSingleStep(0.05)
            widget.setRange(*((0, 1) if name == "Jitter" else (-100, 100)))
            widget.setValue(value)
        widget.setToolTip(self.obj.getDocumentationOfProperty(name))
        self._layout.addRow(_LABELS.get(name, name), widget)
        return widget

    def _value(self, name):
        widget = self._inputs[name]
        if isinstance(widget, QtGui.QComboBox):
            return widget.currentText()
        raw = widget.property("rawValue")
        return widget.value() if raw is None else raw

    def _show_rows(self, *_):
        if len(self._inputs) < len(_ROWS):
            return  # not all of them are there yet
        of_kinds = {name for names in fillings.OF_KIND.values() for name in names}
        for name, widget in self._inputs.items():
            shown = name not in of_kinds or name in fillings.OF_KIND[self._value("Kind")]
            widget.setVisible(shown)
            self._layout.labelForField(widget).setVisible(shown)

    def _show_status(self):
        obj = self.obj
        if not obj.isValid():
            self._status.setText(f'<span style="color:#c00000">{obj.getStatusString()}</span>')
        elif obj.PreviewFacets:
            self._status.setText(f"{obj.PreviewFacets} facets, {number(obj, 'PreviewVolume'):.0f} mm³")
        else:
            self._status.setText("no preview yet: press Apply")

    def apply(self):
        """Takes the values over and recomputes. Returns whether that succeeded."""
        for name in _ROWS:
            if getattr(self.obj, name) != self._value(name):
                setattr(self.obj, name, self._value(name))
        self.obj.Preview = True
        self.obj.touch()
        self.obj.Document.recompute()
        self._show_status()
        return self.obj.isValid()

    # What FreeCAD calls.

    def getStandardButtons(self):
        box = QtGui.QDialogButtonBox
        return int(box.Ok | box.Cancel | box.Apply)

    def clicked(self, button):
        if button == int(QtGui.QDialogButtonBox.Apply):
            self.apply()

    def accept(self):
        if not self.apply():
            return False  # the panel stays, and shows why
        self.obj.Document.commitTransaction()
        self._close()
        return True

    def reject(self):
        self.obj.Document.abortTransaction()
        self._close()
        return True

    @staticmethod
    def _close():
        document = FreeCADGui.ActiveDocument
        FreeCADGui.Control.closeDialog()
        if document:
            document.resetEdit()
