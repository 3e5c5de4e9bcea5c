# SPDX-License-Identifier: Apache-2.0
"""What the vectors are about: names, model files and points. make_vectors.py adds the results."""
import random

BOX = {"shape": {"box": {"min": [0, 0, 0], "max": [10, 8, 6]}}}
SLICING = {"pitch": 0.5, "layer_height": 1.5}


def model(*structures, shape=BOX, slicing=None, **more):
    return {"msq_model": 1, **more, "scales": [shape, *structures],
            "slicing": {**SLICING, **(slicing or {})}}


def structure(kind, /, skin=0, **more):
    made = {"structure": {kind: more}}
    if skin:
        made["skin"] = skin
    return made


TETRAHEDRON = {"shape": {"mesh": {
    "vertices": [[0, 0, 0], [10, 0, 0], [0, 8, 0], [0, 0, 6]],
    "triangles": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]}}}
DRILLED = {"shape": {"boolean": {"operation": "difference", "shapes": [
    {"offset": {"original": BOX["shape"], "distance": 0.25}},
    {"cylinder": {"from": [5, 4, -1], "to": [5, 4, 7], "radius": 2.5}}]}}}
TURN = [0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1]
IMAGE = {"value_type": "uint8", "size": [4, 4, 4], "grid": {"cell_size": 2},
         "values": [(7 * i * i + 3 * i) % 251 for i in range(64)]}
GRADIENT = {"gradient": {"from": [0, 0, 0], "from_value": 0.2, "to": [0, 0, 6], "to_value": 0.7}}

# The coordinates of bent cells, in quarters, which all languages write and read alike.
MAP_GRID = {"origin": [-2, -2, -2], "cell_size": [7, 6, 5]}
MAP = [{"grid": {"image": {"value_type": "float64", "size": [3, 3, 3], "grid": MAP_GRID,
                           "values": [coordinate(i % 3, i // 3 % 3, i // 9) for i in range(27)]}}}
       for coordinate in (lambda x, y, z: 2.25 * x + 0.25 * y, lambda x, y, z: 2 * y + 0.25 * x * z,
                          lambda x, y, z: 1.75 * z - 0.25 * x)]

#: name: model file. A text is read as it stands.
CASES = {
    "box": model(title="A box, ü and all"),
    "lattice": model(structure("lattice", unit_cell="octet", grid={"cell_size": [3, 4, 2.5]},
                               radius=0.4), shape=DRILLED),
    "lattice_turned": model(structure("lattice", skin=0.6, unit_cell="kelvin", radius=GRADIENT,
                                      grid={"cell_size": 3, "origin": [0.5, 0, 0.25],
                                            "rotation": TURN}), slicing={"output": "bytes"}),
    "plate_lattice": model(structure("plate_lattice", plate_cell="kelvin", thickness=GRADIENT,
                                     radius=0.4, unit_cell="bcc",
                                     grid={"cell_size": [4, 5, 3], "origin": [0.5, 0, 0.25]})),
    "foam": model(structure("foam", grid={"cell_size": 2}, radius=0.45, seed=18446744073709551615,
                            jitter=0.875), shape=TETRAHEDRON),
    "foam_stretched": model(structure("foam", grid={"cell_size": 2.5}, radius=0.35, seed=3,
                                      stretch=[1, 0.5, 2])),
    "foam_weighted": model(structure("foam", grid={"cell_size": 3}, radius=0.3, wall_thickness=0.1,
                                     weight=2.5, seed=5)),
    "foam_period": model(structure("foam", grid={"cell_size": 3}, radius=0.25, wall_thickness=0.15,
                                   period={"axis": 1, "positions": [0, 6], "cell_sizes": [4, 1]},
                                   seed=6)),
    "foam_warp": model(structure("foam", grid={"cell_size": 2, "origin": [5, 4, 0]}, radius=0.2,
                                 wall_thickness=0.1, seed=8,
                                 warp={"count": 12, "inner_radius": 2, "outer_radius": 5})),
    "foam_walls": model(structure("foam", grid={"cell_size": 3}, radius=0.2, wall_thickness=0.3,
                                  vent_radius=0.4, density={"expression": {
                                      "expression": "1 + a * x", "parameters": {"a": 0.2},
                                      "low": 1, "high": 3}})),
    "gyroid": model(structure("functional", function="gyroid", kind="sheet", thickness=0.4,
                              grid={"cell_size": 4}), slicing={"output": "distance"}),
    "period": model(structure("lattice", unit_cell="bcc", grid={"cell_size": [9, 3, 3]}, radius=0.35,
                              period={"axis": 0, "positions": [1, 9], "cell_sizes": [2, 4]}),
                    structure("functional", function="schwarz_p", level=0.5,
                              grid={"cell_size": [1.5, 9, 1.5]},
                              period={"axis": 1, "positions": [0, 8], "cell_sizes": [1, 2]})),
    "warped": model(structure("lattice", unit_cell="bcc", radius=0.3,
                              grid={"cell_size": [2, 9, 2.5], "origin": [5, 4, 0]},
                              warp={"count": 9, "inner_radius": 1, "shear_along": 0.75,
                                    "shear_outwards": -0.25}),
                    structure("functional", function="gyroid", level=0.6,
                              grid={"cell_size": 1.5, "origin": [5, 4, 3]},
                              warp={"kind": "spherical", "count": 16, "count_polar": 8,
                                    "outer_radius": 6})),
    "sampled_map": model(structure("lattice", unit_cell="bcc", radius=0.35,
                                   warp={"kind": "sampled", "u": MAP[0], "v": MAP[1], "w": MAP[2]}),
                         structure("functional", function="gyroid", level=0.75,
                                   warp={"kind": "sampled", "u": MAP[0], "v": MAP[1], "w": MAP[2]})),
    "expression": model(structure("functional", function="expression", level=0.25,
                                  expression="cos(2*pi*x) + cos(2*pi*y) - z",
                                  grid={"cell_size": 5})),
    "waves": model(structure("waves", kind="sheet", count=40, seed=9, volume_fraction=0.4,
                             cone_angles=[30, 30, 0], tile=[0, 0, 3], grid={"cell_size": [3, 4, 5]})),
    "beams": model(structure("beams", cap="sphere", radius=1.25,
                             nodes=[[0, 0, 0], [10, 8, 6], [10, 0, 0], [0, 8, 6]],
                             beams=[[0, 1], [2, 3]])),
    "boolean": model(structure("boolean", operation="union", structures=[
        {"boolean": {"operation": "difference", "structures": [
            {"functional": {"function": "gyroid", "level": 0.4, "grid": {"cell_size": 4}}},
            {"foam": {"grid": {"cell_size": 3}, "radius": 0.4}}]}},
        {"lattice": {"unit_cell": "bcc", "grid": {"cell_size": 2.5, "rotation": TURN},
                     "radius": 0.25}}])),
    "blend": model(structure("blend", a={"foam": {"grid": {"cell_size": 3}, "radius": 0.5}},
                             b={"functional": {"function": "gyroid", "level": 0.2,
                                               "grid": {"cell_size": 4}}},
                             fraction={"gradient": {"from": [2, 0, 0], "from_value": 0,
                                                    "to": [8, 0, 0], "to_value": 1}})),
    "smooth_boolean": model(structure(
        "smooth_boolean", operation="union",
        a={"smooth_boolean": {"operation": "difference", "radius": 0.4,
                              "a": {"functional": {"function": "gyroid", "grid": {"cell_size": 4}}},
                              "b": {"lattice": {"unit_cell": "bcc", "grid": {"cell_size": 2.5},
                                                "radius": 0.3}}}},
        b={"foam": {"grid": {"cell_size": 3}, "radius": 0.3}},
        radius={"gradient": {"from": [2, 0, 0], "from_value": 0,
                             "to": [8, 0, 0], "to_value": 1}})),
    "voxels": model(structure("lattice", unit_cell="bcc", grid={"cell_size": 2}, radius=0.35),
                    shape={"shape": {"voxels": {"image": IMAGE, "threshold": 90}}}),
    "nested": model(structure("lattice", unit_cell="cubic", grid={"cell_size": 5}, radius=1.2),
                    structure("functional", skin=0.2, function="schwarz_p", grid={"cell_size": 1.25})),
    "materials": {
        "msq_model": 1,
        "materials": {"steel": {"plain": {"id": 7, "channels": [{"name": "hardness", "value": 3}]}}},
        "scales": [{**BOX, "material": {"plain": {"id": 9, "channels": []}}},
                   {**structure("foam", skin=0.5, grid={"cell_size": 2.5}, radius=0.4),
                    "material": "steel"}],
        "slicing": {**SLICING, "output": "material"}},
    "regions": {
        "msq_model": 1,
        "regions": [{"scales": [{"shape": {"sphere": {"center": [5, 4, 3], "radius": 2.5}}},
                                structure("foam", grid={"cell_size": 1.5}, radius=0.2)]},
                    {"scales": [BOX, structure("lattice", grid={"cell_size": 2}, radius=0.3)]}],
        "slicing": SLICING},
    "refused_text": '{"msq_model": 1,\n "scales": [],\n "scales": []}',
    "refused_key": model(structure("foam", cell_size=2, radius=0.3)),
    "refused_value": model(structure("foam", grid={"cell_size": 2}, radius=-0.5)),
    "refused_file": model(shape={"shape": {"file": {"file": "part.stl"}}}),
}


def points():
    """Points in and about the box, with 2^-20 as their unit, and corners."""
    numbers = random.Random(2024)
    found = [[round(numbers.uniform(-1, side + 1) * 2**20) / 2**20 for side in (10, 8, 6)]
             for _ in range(120)]
    return [[0.0, 0.0, 0.0], [10.0, 8.0, 6.0], [5.0, 4.0, 3.0], [-0.0, 4.0, 3.0],
            [10.000000000000002, 4.0, 3.0], *found]
