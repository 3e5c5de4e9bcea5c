# SPDX-License-Identifier: Apache-2.0
"""What the tests share."""
import os
import pathlib

import numpy as np

import msq

SOURCE = pathlib.Path(__file__).resolve().parents[3]
SANITIZED = os.environ.get("MSQ_SANITIZE") == "1"


def reference_model():
    """The model of reference.c."""
    cylinder = msq.Shape.cylinder((1, 2, 0), (1, 2, 9), 7.5)
    radius = msq.Field.gradient((0, 0, 0), 0.15, (0, 0, 9), 0.6)
    foam = msq.Foam(cell_size=(2, 2.25, 2.5), origin=(0, -0.7, 0), radius=radius,
                    seed=12345678901234567890, jitter=0.875)
    return msq.Model(cylinder, [foam])


def box_model(foam=True, context=None):
    """A box of 8 x 6 x 4, filled with a foam."""
    context = context or msq.Context(threads=2)
    box = msq.Shape.box((0, 0, 0), (8, 6, 4), context=context)
    return msq.Model(box, [msq.Foam(cell_size=2, radius=0.3, context=context)] if foam else [])


def random_points(count, seed=1, dtype=np.float64):
    """Points in and about the models above."""
    generator = np.random.RandomState(seed)
    return (generator.rand(count, 3) * (18, 18, 12) - (8, 7, 1.5)).astype(dtype)
