"""The report as a folder of the project: results.md, a .csv for each table, plots as they are, other pictures as small
.jpg. What is kept by hand beside them (README.md, the reading) stays as it is."""
import os
import shutil

from report_lib import page, pictures


def write(folder, sections, out):
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        if name.endswith((".csv", ".png", ".jpg")):
            os.remove(os.path.join(folder, name))
    lines = ["# Results", "", "Written by `scripts/report --keep`; `README.md` says how to read it.", ""]
    for section in sections:
        lines += [f"## {section.title}", "", page.made(section), ""]
        for text in section.text:
            lines += [text, ""]
        for table in section.tables:
            with open(os.path.join(folder, table.name + ".csv"), "w", encoding="utf-8") as file:
                file.write(table.csv())
            lines += [table.markdown(), f"All digits: [{table.name}.csv]({table.name}.csv)", ""]
        for picture in section.pictures:
            name = _copy(picture, os.path.join(out, section.name), folder, section.name)
            lines += [f"![{picture.caption}]({name})", "", picture.caption, ""]
    with open(os.path.join(folder, "results.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def _copy(picture, source, folder, section):
    path = os.path.join(source, picture.file)
    name = f"{section}_{picture.file}"
    if picture.plot:
        shutil.copyfile(path, os.path.join(folder, name))
        return name
    name = os.path.splitext(name)[0] + ".jpg"
    pictures.write_small(os.path.join(folder, name), path)
    return name
