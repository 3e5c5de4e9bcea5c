# SPDX-License-Identifier: Apache-2.0
"""The package msq, loaded when it is first needed."""
import functools
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))
MOD = os.path.normpath(os.path.join(FOLDER, "..", ".."))


def icon(name="msq"):
    """The file of an icon."""
    return os.path.join(MOD, "resources", name + ".svg")


@functools.lru_cache(maxsize=1)
def msq():
    """The module. ImportError says what FreeCAD's Python lacks."""
    try:
        import msq as module
    except ImportError as error:
        raise ImportError("FreeCAD cannot load the Python package msq; its place is the folder of the "
                          f"workbench, {MOD} ({error})") from None
    return module


@functools.lru_cache(maxsize=1)
def context():
    """The context that all objects of the workbench share: its threads and its cell cache."""
    return msq().Context()
