# SPDX-License-Identifier: Apache-2.0
"""Solids of FreeCAD filled with the structures of msq: see README.md of the workbench."""
