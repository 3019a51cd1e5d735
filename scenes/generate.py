#!/usr/bin/env python3
"""Writes the test scenes: scenes/generate.py [--list] [--output FOLDER] [NAME...]

Without names it writes all of them next to itself. The same bytes come out every time.
"""

import argparse
import importlib
import pathlib

from generator import glb

NAMES = ("cornell", "table_room", "egg_room", "invisible_date", "office", "conference", "u_office", "keyhole",
         "three_turns", "wall_washers", "many_rooms")


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description="Writes the test scenes as glTF binaries.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(NAMES))
    parser.add_argument("--output", type=pathlib.Path, default=here, help="folder (%(default)s)")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(NAMES)
    if unknown:
        parser.error(f"no such scene: {', '.join(sorted(unknown))}; there are {', '.join(NAMES)}")
    print("| scene | triangles stored | with instances | lights | cameras | file [KB] |")
    print("|---|---|---|---|---|---|")
    for name in arguments.names or NAMES:
        scene = importlib.import_module(f"generator.{name}").build()
        data = glb.encode(scene)
        (arguments.output / f"{name}.glb").write_bytes(data)
        stored, all_triangles, lights = scene.statistics()
        row = (name, f"{stored:,}", f"{all_triangles:,}", lights, len(scene.cameras))
        print("|", *(f"{cell} |" for cell in row), f"{len(data) / 1000:.0f} |")


if __name__ == "__main__":
    main()
