# SPDX-License-Identifier: Apache-2.0
"""Properties of document objects, from tables."""
from typing import Any, NamedTuple

READ_ONLY, HIDDEN, SHOWN = 1, 2, 0  # modes of FreeCAD's property editor


class Property(NamedTuple):
    """One property: App::PropertyX is written X."""

    name: str
    type: str
    group: str
    text: str
    value: Any = None
    read_only: bool = False


def add(obj, table):
    """Adds the properties that the object does not have yet, with their defaults."""
    for given in table:
        if given.name in obj.PropertiesList:
            continue
        obj.addProperty("App::Property" + given.type, given.name, given.group, given.text)
        if given.value is not None:
            setattr(obj, given.name, given.value)
        if given.read_only:
            obj.setEditorMode(given.name, READ_ONLY)


def number(obj, name):
    """The value of a property in FreeCAD's own units: millimetres."""
    value = getattr(obj, name)
    return float(getattr(value, "Value", value))


class Proxy:
    """What FreeCAD calls for an object; it keeps nothing, so documents store its class alone."""

    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps, loads = __getstate__, __setstate__  # their names from FreeCAD 0.21.2 on
