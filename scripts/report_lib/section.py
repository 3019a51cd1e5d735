"""A section of the report: what it says, its tables and its pictures. Kept as files, so that the page can be built of
sections that were run on different days; each says when and of which commit it is."""
import dataclasses
import importlib
import json
import os
import shutil

from report_lib.tables import Table


@dataclasses.dataclass
class Picture:
    file: str  # in the section's folder
    caption: str
    plot: bool = False  # shown at its own size, not enlarged


@dataclasses.dataclass
class Section:
    name: str
    title: str
    text: list = dataclasses.field(default_factory=list)  # paragraphs
    tables: list = dataclasses.field(default_factory=list)
    pictures: list = dataclasses.field(default_factory=list)
    made: dict = dataclasses.field(default_factory=dict)  # date, commit, machine, options


def module_of(name):
    """What makes the section: "photon-map" is made by photon_map.py."""
    return importlib.import_module("report_lib." + name.replace("-", "_"))


def fresh_folder(out, name):
    folder = os.path.join(out, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    return folder


def save(out, section):
    with open(os.path.join(out, section.name, "section.json"), "w", encoding="utf-8") as file:
        json.dump(dataclasses.asdict(section), file, indent=1)


def load(out, name):
    """None if the section has never been run."""
    try:
        with open(os.path.join(out, name, "section.json"), encoding="utf-8") as file:
            stored = json.load(file)
    except FileNotFoundError:
        return None
    stored["tables"] = [Table(**table) for table in stored["tables"]]
    stored["pictures"] = [Picture(**picture) for picture in stored["pictures"]]
    return Section(**stored)
