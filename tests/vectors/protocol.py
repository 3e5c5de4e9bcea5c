# SPDX-License-Identifier: Apache-2.0
"""How a program of any language runs the vectors.

It is called with pairs of files, a model file and its points, and prints for each pair

    case
    title TEXT
    hash HEX                   of the model; `hash -` where the build has no hashes
    inside 0110...             a digit for each point
    distance HEX HEX ...       the 64 bits of each signed distance
    plan WIDTH HEIGHT LAYERS
    layer INDEX HEX HEX        the 64 bits of z, and height rows of stride bytes
    refused STATUS: MESSAGE    instead of all this: the model file is refused

A file of points has three doubles for each, in the order of bytes of the machine. The program takes
them, the layers and the messages through the binding of its language, and knows nothing of JSON.
"""
import hashlib
import json
import pathlib
import struct
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def model_text(model):
    return model if isinstance(model, str) else json.dumps(model, ensure_ascii=False)


def _doubles(words):
    return [struct.unpack(">d", bytes.fromhex(word))[0] for word in words]


def _read(lines):
    """What a vector has as `expected`, from the lines of a case."""
    found, layers = {}, []
    for line in lines:
        word, _, rest = line.partition(" ")
        if word in found or word not in ("title", "hash", "inside", "distance", "plan", "layer",
                                         "refused"):
            raise ValueError(f"unexpected line {line[:60]!r}")
        if word == "distance":
            found[word] = _doubles(rest.split())
        elif word == "plan":
            found[word] = [int(number) for number in rest.split()]
        elif word == "layer":
            index, z, rows = rest.split()
            layers.append({"index": int(index), "z": _doubles([z])[0],
                           "sha256": hashlib.sha256(bytes.fromhex(rows)).hexdigest()})
        else:
            found[word] = rest
    if "refused" not in found:
        found["layers"] = layers
    return found


def run(command, vectors):
    """The results of a program: a list of dictionaries, one for each vector."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = []
        for number, vector in enumerate(vectors):
            model = pathlib.Path(folder, f"{number}.json")
            model.write_text(model_text(vector["model"]), encoding="utf-8")
            points = pathlib.Path(folder, f"{number}.points")
            points.write_bytes(b"".join(struct.pack("=3d", *point) for point in vector["points"]))
            arguments += [str(model), str(points)]
        done = subprocess.run([*command, *arguments], stdout=subprocess.PIPE)
    if done.returncode != 0:
        raise ValueError(f"{' '.join(command)} ended with {done.returncode}")
    cases = done.stdout.decode("utf-8").split("case\n")[1:]
    if len(cases) != len(vectors):
        raise ValueError(f"{len(cases)} cases for {len(vectors)} vectors")
    return [_read(case.splitlines()) for case in cases]


def same(left, right):
    """Equal to the bit, so that 0 and -0 differ."""
    return json.dumps(left, sort_keys=True) == json.dumps(right, sort_keys=True)
