# SPDX-License-Identifier: Apache-2.0
"""Materials: what a scale of a model, or its skin, is made of."""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence

from . import _abi
from ._given import remembers
from ._handle import Handle, hash_of, lend
from ._library import defaults, lib
from .context import Context, MadeIn, context_of, c_text, unsigned
from .field import Param, set_param


class Material(Handle):
    """An id above 0 and named channels, each a number or a Field: `Material(1, density=7.8)`.

    What they mean is for the caller to say. A name that is no identifier goes in as
    `**{"Young's modulus": 210.0}`; the name `context` cannot be.
    """

    _kind = "material"
    id: int  #: what Model.material answers
    context = MadeIn()

    @remembers
    def __init__(self, id: int, /, *, context: Optional[Context] = None, **channels: Param) -> None:
        definition = defaults(_abi.msq_material_def)
        definition.id = unsigned(id, 32, "id")
        values = (_abi.msq_channel * len(channels))()
        names = encoded(list(channels))
        for channel, encoded_name, (name, value) in zip(values, names, channels.items()):
            channel.name = encoded_name
            set_param(channel.value, name, value)
        definition.channels = values
        definition.channel_count = len(values)
        context = context_of(context, *channels.values())
        self._reference = self._create(lib.msq_material_create, context._ref,
                                       ctypes.byref(definition))
        self.id, self.context = definition.id, context

    @classmethod
    @remembers
    def blend(cls, id: int, a: Material, b: Material, fraction: Param, *,
              context: Optional[Context] = None) -> Material:
        """One material graded into another, with an id of its own: each channel is (1 - f) times
        that of a plus f times that of b, f being the fraction, 0 to 1. Both have the same channels.
        """
        for material, name in ((a, "a"), (b, "b")):
            if not isinstance(material, Material):
                raise TypeError(f"{name} is a {type(material).__name__}; it must be a Material")
        number, part = unsigned(id, 32, "id"), _abi.msq_param()
        set_param(part, "fraction", fraction)
        context = context_of(context, a, b, fraction)
        made = cls._wrap(cls._create(lib.msq_material_blend, context._ref, number, a._ref, b._ref,
                                     ctypes.byref(part)))
        made.id, made.context = number, context
        return made

    @property
    def hash(self) -> str:
        """32 hexadecimal digits: equal for equal definitions with equal inputs, on every machine,
        and different otherwise (docs/howto/caching.md)."""
        return hash_of(lib.msq_material_hash, self)


def lend_material(target: Any, field: str, material: Optional[Material]) -> None:
    """Writes a material to a field of a struct, as lend() does; None leaves it without one."""
    if material is None:
        return
    if not isinstance(material, Material):
        raise TypeError(f"{field} is a {type(material).__name__}; it must be a Material")
    lend(target, field, material)


def encoded(names: Sequence[str]) -> Sequence[bytes]:
    """Names of channels as C takes them."""
    if isinstance(names, (str, bytes)):
        raise TypeError(f"channels is {names!r}; it must be a sequence of names")
    return [c_text(name, "a channel's name") for name in names]
