"""The report as a folder of the project: results.md, a .csv for each table, plots as they are, other pictures as small
.jpg. Sections that are not in this report stay as they were, and so does what is kept by hand beside them (README.md, the
reading)."""
import os
import re
import shutil

from report_lib import page, pictures

HEAD = "# Results\n\nWritten by `scripts/report --keep`; `README.md` says how to read it.\n"


def write(folder, sections, out):
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "results.md")
    blocks = _blocks(path)
    for section in sections:
        for name in _files(blocks.get(section.title, "")):
            if os.path.exists(os.path.join(folder, name)):
                os.remove(os.path.join(folder, name))
        blocks[section.title] = _block(section, folder, out)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([HEAD, *blocks.values()]))


def _blocks(path):
    """{title: text} of the sections that are there."""
    try:
        with open(path, encoding="utf-8") as file:
            parts = re.split(r"^(?=## )", file.read(), flags=re.MULTILINE)[1:]
    except FileNotFoundError:
        return {}
    return {part.split("\n", 1)[0][3:]: part.rstrip("\n") + "\n" for part in parts}


def _files(block):
    """That it shows or names."""
    return set(re.findall(r"\]\(([^()/]+\.(?:csv|png|jpg))\)", block))


def _block(section, folder, out):
    lines = [f"## {section.title}", "", page.made(section), ""]
    for text in section.text:
        lines += [text, ""]
    for table in section.tables:
        with open(os.path.join(folder, table.name + ".csv"), "w", encoding="utf-8") as file:
            file.write(table.csv())
        lines += [table.markdown(), f"All digits: [{table.name}.csv]({table.name}.csv)", ""]
    for picture in section.pictures:
        name = _copy(picture, os.path.join(out, section.name), folder, section.name)
        lines += [f"![{picture.caption}]({name})", "", picture.caption, ""]
    return "\n".join(lines)


def _copy(picture, source, folder, section):
    path = os.path.join(source, picture.file)
    name = f"{section}_{picture.file}"
    if picture.plot:
        shutil.copyfile(path, os.path.join(folder, name))
        return name
    name = os.path.splitext(name)[0] + ".jpg"
    pictures.write_small(os.path.join(folder, name), path)
    return name
