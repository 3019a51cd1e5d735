"""The report as one HTML file that opens from disk: pictures are inside it."""
import base64
import html
import os

STYLE = """
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 1500px; padding: 0 1em; }
h1, h2 { font-weight: 600; }
table { border-collapse: collapse; font-size: 13px; display: block; overflow-x: auto; margin: 1em 0; }
th, td { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; }
th { text-align: left; font-weight: 600; }
td:first-child, td:nth-child(2) { text-align: left; }
figure { margin: 1.5em 0; }
figure img { max-width: 100%; }
figure img.pixels { image-rendering: pixelated; width: 100%; }
figcaption, .made { color: #666; font-size: 13px; }
"""


def write(path, sections, out):
    parts = ["<!DOCTYPE html>", "<html lang='en'><head><meta charset='utf-8'>",
             "<meta name='viewport' content='width=device-width, initial-scale=1'>",
             "<title>Ninefold: speed against error</title>", f"<style>{STYLE}</style></head><body>",
             "<h1>Speed against error</h1>", "<ul>"]
    parts += [f"<li><a href='#{s.name}'>{html.escape(s.title)}</a></li>" for s in sections]
    parts.append("</ul>")
    for section in sections:
        parts += _section(section, os.path.join(out, section.name))
    parts.append("</body></html>\n")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(parts))


def _section(section, folder):
    parts = [f"<h2 id='{section.name}'>{html.escape(section.title)}</h2>",
             f"<p class='made'>{html.escape(made(section))}</p>"]
    parts += [f"<p>{html.escape(text)}</p>" for text in section.text]
    parts += [table.html() for table in section.tables]
    for picture in section.pictures:
        with open(os.path.join(folder, picture.file), "rb") as file:
            data = base64.b64encode(file.read()).decode()
        shape = "" if picture.plot else " class='pixels'"
        parts.append(f"<figure><img{shape} alt='' src='data:image/png;base64,{data}'>"
                     f"<figcaption>{html.escape(picture.caption)}</figcaption></figure>")
    return parts


def made(section):
    """One line: when, of which commit, where, how."""
    m = section.made
    return f"{m['date']}, commit {m['commit']}, {m['machine']}, {m['options']}"
