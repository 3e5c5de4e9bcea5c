# SPDX-License-Identifier: Apache-2.0
"""The recipe for Conan and the port for vcpkg name options that CMake has, and the version of the project:
usage: check_recipes.py"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read(path):
    return (ROOT / path).read_text(encoding="utf-8")


def problems():
    cmake = read("CMakeLists.txt")
    version = re.search(r"project\(msq VERSION ([\d.]+)", cmake).group(1)
    options = set(re.findall(r"\boption\((MSQ_\w+)", cmake))
    optional = {name for name in options if re.match(r"MSQ_(WITH|BUILD)_", name)} - {"MSQ_BUILD_BENCH"}
    conan, port = read("packaging/conan/conanfile.py"), read("packaging/vcpkg/portfile.cmake")
    manifest = json.loads(read("packaging/vcpkg/vcpkg.json"))
    for file, text in (("conanfile.py", conan), ("portfile.cmake", port)):
        named = set(re.findall(r"MSQ_(?:WITH|BUILD)_\w+", text))
        for name in sorted(named ^ optional):
            yield f"{file}: {name} is {'no option of CMake' if name in named else 'not set'}"
    if manifest["version"] != version:
        yield f"vcpkg.json has version {manifest['version']}; the project has {version}"
    project = re.search(r"<Version>(.*)</Version>", read("bindings/csharp/Msq.csproj")).group(1)
    if project != version:
        yield f"Msq.csproj has version {project}; the project has {version}"
    features = re.search(r"FEATURES\n(.*?)\n\)", port, flags=re.S).group(1)
    if sorted(line.split()[0] for line in features.splitlines()) != sorted(manifest["features"]):
        yield "portfile.cmake and vcpkg.json differ in their features"
    if not set(manifest["default-features"]) <= set(manifest["features"]):
        yield "vcpkg.json: a default feature is no feature"
    given = re.search(r"options = \{(.*?)\n    \}", conan, flags=re.S).group(1)
    defaults = re.search(r"default_options = \{(.*?)\n    \}", conan, flags=re.S).group(1)
    if re.findall(r'"(\w+)":', given) != re.findall(r'"(\w+)":', defaults):
        yield "conanfile.py: an option has no default"
    # What vcpkg asks of a manifest: names in lower case, lists and features in order.
    lists = [manifest["dependencies"], *(one.get("dependencies", []) for one in manifest["features"].values())]
    for one in lists:
        names = [each if isinstance(each, str) else each["name"] for each in one]
        if names != sorted(names):
            yield f"vcpkg.json: {names} is not sorted"
        yield from (f"vcpkg.json: name {name}" for name in names if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name))
    if list(manifest["features"]) != sorted(manifest["features"]):
        yield "vcpkg.json: features are not sorted"
    for name, feature in manifest["features"].items():
        if not set(feature) <= {"description", "dependencies", "license", "supports"} or "description" not in feature:
            yield f"vcpkg.json: members of the feature {name}"


def main():
    found = list(problems())
    print("\n".join(found) or "the recipes agree with CMakeLists.txt")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
