# SPDX-License-Identifier: Apache-2.0
"""Models in JSON, with settings for slices and pictures (docs/model_file.md)."""
from __future__ import annotations

import ctypes
import os
from typing import Any, Optional, Sequence, Tuple, Union

from . import _abi, picture
from ._handle import Handle
from ._interrupt import build
from ._library import constant, defaults, lib, report
from .camera import Camera
from .context import Context, Job, MadeIn, context_of, c_path, unsigned
from .errors import naming
from .model import Model
from .picture import Picture
from .slicer import Slicer

Path = Union[str, "os.PathLike[str]"]


class Document(Handle):
    """A model with settings for slices and pictures, read from a text in JSON.

        document = msq.Document.from_file("part.json")
        for layer in document.slicer():
            ...
    """

    _kind = "document"
    context = MadeIn()

    @classmethod
    def from_json(cls, text: Union[str, bytes], *, base_directory: Optional[Path] = None,
                  files: str = "below", max_bytes: int = 0, max_values: int = 0,
                  max_depth: int = 0, max_files: int = 0, max_file_bytes: int = 0,
                  max_triangles: int = 0, context: Optional[Context] = None,
                  job: Optional[Job] = None) -> Document:
        """Reads a text. base_directory: where the paths in it start. files: which it may name:
        `below` that directory, `none` or `any`. Maxima of 0: those of msq."""
        if not isinstance(text, (str, bytes, bytearray)):
            raise TypeError(f"text is of type {type(text).__name__}; it must be str or bytes")
        data = text.encode() if isinstance(text, str) else bytes(text)
        context = context_of(context)
        definition = _definition(base_directory, files, max_bytes, max_values, max_depth, max_files,
                                 max_file_bytes, max_triangles)
        return build(lambda new: cls._make(context, new, data, len(data),
                                           ctypes.byref(definition)),
                     lib.msq_document_from_json, job)

    @classmethod
    def from_file(cls, path: Path, *, base_directory: Optional[Path] = None, files: str = "below",
                  max_bytes: int = 0, max_values: int = 0, max_depth: int = 0, max_files: int = 0,
                  max_file_bytes: int = 0, max_triangles: int = 0,
                  context: Optional[Context] = None, job: Optional[Job] = None) -> Document:
        """Reads a file. base_directory: None: that of the file. The rest as in from_json."""
        name = c_path(path)
        context = context_of(context)
        definition = _definition(base_directory, files, max_bytes, max_values, max_depth, max_files,
                                 max_file_bytes, max_triangles)
        with naming(path):
            return build(lambda new: cls._make(context, new, name, ctypes.byref(definition)),
                         lib.msq_document_from_file, job)

    @classmethod
    def _make(cls, context: Context, create: Any, *arguments: Any) -> Document:
        made = cls._wrap(cls._create(create, context._ref, *arguments))
        made.context = context
        filled = report(_abi.msq_document_report, lib.msq_document_info, made._ref)
        made.version: int = filled.version  #: of the format
        made.title: str = filled.title.decode()
        made.files: int = filled.files  #: number of files that it names
        made.has_slicing: bool = bool(filled.has_slicing)
        made.has_view: bool = bool(filled.has_view)
        return made

    def __repr__(self) -> str:
        return f"<msq.Document {self.title!r}>"

    @property
    def model(self) -> Model:
        """The model."""
        made = Model._wrap(Model._create(lib.msq_document_model, self._ref))
        made.context = self.context
        return made

    def slicer(self) -> Slicer:
        """The slicer of the document's settings."""
        definition = defaults(_abi.msq_slicer_def)
        lib.msq_document_slicing(self._ref, ctypes.byref(definition))
        return Slicer._of_definition(self.model, definition)

    @property
    def camera(self) -> Camera:
        """The camera of the document's view."""
        return self._view()[0]

    def render(self, *, outputs: Sequence[str] = ("rgba",), length_scale: float = 0.0,
               job: Optional[Job] = None) -> Picture:
        """The picture of the document's view; outputs, length_scale and job as in Model.render."""
        camera, definition = self._view()
        return picture.render(self.model, camera, definition, self._ref, outputs, length_scale, None,
                              None, job)

    def _view(self) -> Tuple[Camera, Any]:
        lens, definition = defaults(_abi.msq_camera), defaults(_abi.msq_render_def)
        lib.msq_document_view(self._ref, ctypes.byref(lens), ctypes.byref(definition))
        projection = ("perspective" if lens.projection == _abi.MSQ_CAMERA_PERSPECTIVE
                      else "orthographic")
        return Camera(tuple(lens.eye), tuple(lens.target), tuple(lens.up), projection, lens.height,
                      lens.field_of_view, lens.clip_near, lens.clip_far), definition


def _definition(base_directory: Optional[Path], files: str, max_bytes: int, max_values: int,
                max_depth: int, max_files: int, max_file_bytes: int,
                max_triangles: int) -> _abi.msq_document_def:
    definition = defaults(_abi.msq_document_def)
    definition.files = constant("MSQ_DOCUMENT_FILES_", files, "files")
    if base_directory is not None:
        definition.base_directory = c_path(base_directory)
    definition.max_bytes = unsigned(max_bytes, 64, "max_bytes")
    definition.max_values = unsigned(max_values, 64, "max_values")
    definition.max_depth = unsigned(max_depth, 32, "max_depth")
    definition.max_files = unsigned(max_files, 32, "max_files")
    definition.max_file_bytes = unsigned(max_file_bytes, 64, "max_file_bytes")
    definition.max_triangles = unsigned(max_triangles, 64, "max_triangles")
    return definition
